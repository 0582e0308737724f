import init, { TriMesh } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { heights, moebius, octahedron, square, tetrahedron, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }, options) => new TriMesh(positions, triangles, options);
const manifold = { nonManifoldEdges: 0, nonManifoldVertices: 0, isolatedVertices: 0, degenerateTriangles: 0 };

describe('facts', () => {
  it.each([
    ['tetrahedron', tetrahedron(), [4, 6, 4], 8 * Math.sqrt(3), { eulerCharacteristic: 2, genus: 0 }],
    ['octahedron', octahedron(), [6, 12, 8], 4 * Math.sqrt(3), { eulerCharacteristic: 2, genus: 0 }],
    ['torus', torus(12, 9), [108, 324, 216], undefined, { eulerCharacteristic: 0, genus: 1 }],
  ])('of the closed %s', (_, shape, counts, area, topology) => {
    const mesh = make(shape);
    expect([mesh.vertexCount, mesh.edgeCount, mesh.triangleCount]).toEqual(counts);
    if (area !== undefined) expect(mesh.area).toBeCloseTo(area, 12);
    expect(mesh.topology).toEqual({
      components: 1,
      boundaryLoops: 0,
      closed: true,
      orientable: true,
      ...manifold,
      ...topology,
    });
    expect(mesh.warnings).toEqual([]);
  });

  it('of a square', () => {
    const mesh = make(square(5));
    expect([mesh.vertexCount, mesh.edgeCount, mesh.triangleCount]).toEqual([36, 85, 50]);
    expect(mesh.area).toBeCloseTo(25, 12);
    expect(mesh.topology).toMatchObject({
      eulerCharacteristic: 1,
      boundaryLoops: 1,
      closed: false,
      genus: 0,
      ...manifold,
    });
  });

  it('of a Möbius strip', () => {
    const expected = { eulerCharacteristic: 0, boundaryLoops: 1, orientable: false, genus: null, ...manifold };
    expect(make(moebius()).topology).toMatchObject(expected);
  });

  it('of two components', () => {
    const { positions, triangles } = tetrahedron();
    const both = new TriMesh(
      [...positions, ...positions.map((x) => x + 10)],
      [...triangles, ...triangles.map((i) => i + 4)],
    );
    expect(both.topology).toMatchObject({ eulerCharacteristic: 4, components: 2, genus: 0 });
  });

  it('of three triangles at one edge', () => {
    const mesh = new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0], [0, 1, 2, 0, 1, 3, 0, 1, 4]);
    expect(mesh.topology).toMatchObject({ nonManifoldEdges: 1, genus: null, eulerCharacteristic: 1 });
  });

  it('are worked out once and cannot be changed', () => {
    const mesh = make(tetrahedron());
    expect(mesh.topology).toBe(mesh.topology);
    expect(Object.isFrozen(mesh.topology)).toBe(true);
  });
});

describe('input', () => {
  it('is taken in every form of the types', () => {
    const { positions, triangles } = tetrahedron();
    for (const numbers of [positions, Float64Array.from(positions), Float32Array.from(positions)]) {
      for (const ids of [triangles, Uint32Array.from(triangles), Uint16Array.from(triangles)]) {
        const mesh = new TriMesh(numbers, ids);
        expect([...mesh.positions()]).toEqual(positions);
        expect(mesh.triangleCount).toBe(4);
      }
    }
  });

  it('is copied, and so is output', () => {
    const positions = Float64Array.from(tetrahedron().positions);
    const triangles = Uint32Array.from(tetrahedron().triangles);
    const mesh = new TriMesh(positions, triangles);
    positions.fill(0);
    triangles.fill(0);
    mesh.positions().fill(7);
    mesh.triangles().fill(3);
    expect([...mesh.positions()]).toEqual(tetrahedron().positions);
    expect(new Set(mesh.triangles())).toEqual(new Set([0, 1, 2, 3]));
    // Not views of wasm memory either: those would go stale, or change, as memory grows.
    const early = mesh.positions();
    make(torus(200, 200)).criticalPoints(heights(torus(200, 200)));
    expect([...early]).toEqual(tetrahedron().positions);
    expect(early.buffer.byteLength).toBe(early.byteLength);
  });

  it('welds on request', () => {
    const { positions, triangles } = octahedron();
    const soup = triangles.flatMap((vertex) => positions.slice(3 * vertex, 3 * vertex + 3));
    const ids = Array.from({ length: 24 }, (_, i) => i);
    expect(new TriMesh(soup, ids).topology.components).toBe(8);
    const welded = new TriMesh(soup, ids, { weld: true });
    expect(welded.vertexCount).toBe(6);
    expect(welded.topology).toMatchObject({ eulerCharacteristic: 2, closed: true });
  });

  it('with a degenerate triangle or an isolated vertex is kept, with a warning', () => {
    const { positions, triangles } = tetrahedron();
    const mesh = new TriMesh([...positions, 5, 5, 5], [...triangles, 1, 1, 2]);
    expect(mesh.triangleCount).toBe(4);
    expect(mesh.topology).toMatchObject({ isolatedVertices: 1, degenerateTriangles: 1, eulerCharacteristic: 3 });
    expect(mesh.warnings.length).toBeGreaterThanOrEqual(2);
    for (const warning of mesh.warnings) {
      expect(warning).toEqual({
        code: expect.any(String),
        message: expect.any(String),
        count: 1,
        examples: [expect.any(Number)],
      });
    }
  });
});

describe('refused', () => {
  const { positions, triangles } = tetrahedron();
  const ids = (...last) => [...triangles.slice(0, -1), ...last];

  it.each([
    ['a string', 'x', triangles, 'InvalidArgument', { argument: 'positions' }],
    ['nothing', undefined, undefined, 'InvalidArgument', { argument: 'positions' }],
    ['a soup of four vertices', positions, null, 'TrianglesNotTriples', { length: 4 }],
    ['no triangles', positions, undefined, 'InvalidArgument', { argument: 'triangles' }],
    ['bigints', new BigInt64Array(12), triangles, 'InvalidArgument', { argument: 'positions' }],
    ['a DataView', new DataView(new ArrayBuffer(96)), triangles, 'InvalidArgument', { argument: 'positions' }],
    ['an object like an array', { length: 12 }, triangles, 'InvalidArgument', { argument: 'positions' }],
    ['big integers as ids', positions, new BigInt64Array(12), 'InvalidArgument', { argument: 'triangles' }],
    [
      'a string among numbers',
      positions.with(4, '1'),
      triangles,
      'InvalidArgument',
      { argument: 'positions', index: 4 },
    ],
    ['a hole', [0, 0, 0, 1, 0, 0, 0, , 0], [0, 1, 2], 'InvalidArgument', { argument: 'positions', index: 7 }],
    ['null among ids', positions, ids(null), 'InvalidArgument', { argument: 'triangles', index: 11 }],
    ['a negative id', positions, ids(-1), 'IndexOutOfBounds', { triangle: 3, index: -1, vertices: 4 }],
    ['half an id', positions, ids(1.5), 'IndexOutOfBounds', { triangle: 3, index: 1.5 }],
    ['an id of 33 bits', positions, ids(2 ** 32), 'IndexOutOfBounds', { triangle: 3, index: 2 ** 32 }],
    ['an id that names no vertex', positions, ids(4), 'IndexOutOfBounds', { triangle: 3, index: 4, vertices: 4 }],
    ['the same, typed', positions, Uint16Array.from(ids(9)), 'IndexOutOfBounds', { triangle: 3, index: 9 }],
    ['NaN', positions.with(5, NaN), triangles, 'NonFinitePosition', { vertex: 1 }],
    ['infinity', positions.with(9, -Infinity), triangles, 'NonFinitePosition', { vertex: 3 }],
    ['a lost coordinate', positions.slice(1), triangles, 'PositionsNotTriples', { length: 11 }],
    ['a lost corner', positions, triangles.slice(1), 'TrianglesNotTriples', { length: 11 }],
    ['nothing at all', [], [], 'EmptyMesh', {}],
  ])('%s', (_, badPositions, badTriangles, code, detail) => {
    expectError(() => new TriMesh(badPositions, badTriangles), code, detail);
    expect(new TriMesh(positions, triangles).vertexCount).toBe(4);
  });

  it('options', () => {
    const mesh = (options) => () => new TriMesh(positions, triangles, options);
    expectError(mesh({ wield: true }), 'UnknownOption', { option: 'wield' });
    expectError(mesh({ weld: 'yes' }), 'InvalidOption', { option: 'weld' });
    for (const options of [null, 'weld', true, [], new Float64Array(1)]) {
      expectError(mesh(options), 'InvalidArgument', { argument: 'options' });
    }
    expect(mesh({ weld: undefined })().vertexCount).toBe(4);
  });
});

describe('life', () => {
  it('ends with free, once or twice', () => {
    const mesh = make(tetrahedron());
    mesh.free();
    mesh.free();
    const uses = [
      () => mesh.vertexCount,
      () => mesh.area,
      () => mesh.topology,
      () => mesh.warnings,
      () => mesh.positions(),
      () => mesh.criticalPoints([1, 2, 3, 4]),
      () => mesh.laplacian(),
    ];
    for (const use of uses) expectError(use, 'UseAfterFree', { object: 'TriMesh' });
  });

  it('ends with dispose', () => {
    const mesh = make(tetrahedron());
    mesh[Symbol.dispose]();
    expectError(() => mesh.triangles(), 'UseAfterFree', { object: 'TriMesh' });
  });
});
