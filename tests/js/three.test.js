// Geometries of three.js as meshes, and fields on them. What is right follows from shapes that are known, or from three.js itself.
import init, { MorseSmoothError as Shared, TriMesh } from 'morse-smooth';
import * as api from 'morse-smooth/three';
import { connect } from 'morse-smooth/worker';
import * as three from 'three';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { square } from './meshes.js';

const { BoxGeometry, BufferAttribute, BufferGeometry, Mesh, SphereGeometry, TorusGeometry } = three;
const { arraysOf, fieldAttribute, fieldValues, geometryOf, meshOf } = api;

beforeAll(() => init());

const heightsOf = (mesh, axis = 2) => mesh.positions().filter((_, k) => k % 3 === axis);

describe('the mesh of a geometry', () => {
  it.each([
    // A grid of n × n cells on each side of a box has 6n² + 2 vertices.
    ['a box', new BoxGeometry(1, 2, 3, 4, 4, 4), 98, 2, 22],
    ['a sphere', new SphereGeometry(1, 32, 16), 32 * 15 + 2, 2, null],
    ['a torus', new TorusGeometry(2, 0.5, 12, 40), 480, 0, null],
  ])('is closed, with an index and without: %s', (_, indexed, vertices, euler, area) => {
    for (const geometry of [indexed, indexed.toNonIndexed()]) {
      const { mesh, vertexMap } = meshOf(geometry);
      expect([mesh.vertexCount, mesh.topology.eulerCharacteristic, mesh.topology.closed]).toEqual([vertices, euler, true]); // prettier-ignore
      if (area) expect(mesh.area).toBeCloseTo(area, 5);
      const { position } = geometry.attributes;
      const places = mesh.positions();
      expect(vertexMap).toHaveLength(position.count);
      const far = [...vertexMap].findIndex(
        (vertex, k) =>
          Math.hypot(places[3 * vertex] - position.getX(k), places[3 * vertex + 1] - position.getY(k)) > 1e-5,
      );
      expect(far).toBe(-1);
      mesh.free();
    }
  });

  it('is open at seams if one asks for that, and where they are wider than the tolerance', () => {
    const sphere = new SphereGeometry(1, 32, 16);
    const { mesh, vertexMap } = meshOf(sphere, { weld: false });
    expect(mesh.vertexCount).toBe(sphere.attributes.position.count);
    expect([...vertexMap].every((vertex, k) => vertex === k)).toBe(true);
    expect(mesh.topology.closed).toBe(false);
    const apart = sphere.toNonIndexed();
    const { array } = apart.attributes.position;
    array.forEach((x, k) => (array[k] = x + 1e-4 * Math.sin(k)));
    expect(meshOf(apart).mesh.vertexCount).toBeGreaterThan(482);
    expect(meshOf(apart, { weld: { tolerance: 1e-3 } }).mesh.vertexCount).toBe(482);
  });

  it('is that of a mesh in a scene, where it stands by itself', () => {
    const object = new Mesh(new BoxGeometry());
    object.position.set(5, 5, 5);
    object.updateMatrixWorld();
    expect(meshOf(object).mesh.positions()).toEqual(meshOf(object.geometry).mesh.positions());
  });

  it('reads every kind of attribute as three.js does', () => {
    const expected = arraysOf(new BoxGeometry(2, 2, 2));
    const box = new BoxGeometry(2, 2, 2);
    const { array, count } = box.attributes.position;
    const interleaved = new three.InterleavedBuffer(new Float32Array(8 * count), 8);
    const normalized = new three.InterleavedBuffer(new Int16Array(4 * count), 4);
    const [loose, tight] = [
      new three.InterleavedBufferAttribute(interleaved, 3, 2),
      new three.InterleavedBufferAttribute(normalized, 3, 0, true),
    ];
    const half = new three.Float16BufferAttribute(new Uint16Array(3 * count), 3);
    for (let k = 0; k < count; k++) {
      const place = array.subarray(3 * k, 3 * k + 3);
      for (const attribute of [loose, tight, half]) attribute.setXYZ(k, ...place);
    }
    const bytes = new BufferAttribute(
      Int8Array.from(array, (x) => 127 * x),
      3,
      true,
    );
    for (const attribute of [loose, tight, half, bytes, new BufferAttribute(Float64Array.from(array), 3)]) {
      box.setAttribute('position', attribute);
      expect(arraysOf(box)).toEqual(expected);
    }
    box.setIndex([...box.index.array]);
    expect(arraysOf(box)).toEqual(expected);
    box.setIndex(new BufferAttribute(Uint32Array.from(box.index.array), 1));
    expect(arraysOf(box)).toEqual(expected);
  });

  it('has the triangles that are drawn, whatever their groups', () => {
    for (const geometry of [new BoxGeometry(), new BoxGeometry().toNonIndexed()]) {
      geometry.groups = [geometry.groups[0] ?? { start: 0, count: 3, materialIndex: 0 }];
      const all = arraysOf(geometry).triangles;
      expect(all).toHaveLength(36);
      geometry.setDrawRange(6, 12);
      expect(arraysOf(geometry).triangles).toEqual(all.subarray(6, 18));
      geometry.setDrawRange(30, Infinity);
      expect(arraysOf(geometry).triangles).toEqual(all.subarray(30));
      geometry.setDrawRange(40, Infinity);
      expectError(() => meshOf(geometry), 'EmptyMesh');
    }
  });

  it('gives arrays of their own, which can be sent away', () => {
    const box = new BoxGeometry();
    const { positions, triangles } = arraysOf(box);
    structuredClone([positions, triangles], { transfer: [positions.buffer, triangles.buffer] });
    expect(positions).toHaveLength(0);
    expect(arraysOf(box).positions).toHaveLength(72);
  });

  it('is the same in a worker', async () => {
    const sphere = new SphereGeometry(1, 32, 16);
    const local = meshOf(sphere);
    const remote = await connect();
    const { positions, triangles } = arraysOf(sphere);
    const weld = { tolerance: 1e-6 };
    const mesh = await remote.createMesh(positions, triangles, { weld, transfer: true });
    expect(positions).toHaveLength(0);
    expect(await mesh.vertexMap()).toEqual(local.vertexMap);
    expect(await mesh.positions()).toEqual(local.mesh.positions());
    const heights = heightsOf(local.mesh);
    const lines = api.levelLines(await mesh.levelSets(heights, [0.1]));
    expect(lines.geometry).toMatchObject({ userData: api.levelLines(local.mesh.levelSets(heights, [0.1])).geometry.userData }); // prettier-ignore
    expect(api.criticalMarkers(await mesh.criticalPoints(heights), await mesh.positions()).count).toBe(2);
    remote.close();
  });

  const bare = () => new BufferGeometry();
  const lost = () => {
    const geometry = new BoxGeometry();
    geometry.attributes.position.array = null;
    return geometry;
  };
  const remote = () => bare().setAttribute('position', new three.GLBufferAttribute({}, 5126, 3, 4, 12));
  it.each([
    ['lines', new three.LineSegments(new BoxGeometry())],
    ['lines', new three.Line(new BoxGeometry())],
    ['lines', new three.EdgesGeometry(new BoxGeometry())],
    ['lines', new three.WireframeGeometry(new BoxGeometry())],
    ['points', new three.Points(new BoxGeometry())],
    ['points', new three.Sprite()],
    ['several', new three.BatchedMesh(1, 3, 3)],
    ['instances', new three.InstancedBufferGeometry().copy(new BoxGeometry())],
    ['noPositions', bare()],
    ['itemSize', bare().setAttribute('position', new BufferAttribute(new Float32Array(6), 2))],
    ['noData', lost()],
    ['onlyOnGraphicsCard', remote()],
  ])('is refused: %s', (reason, source) => {
    expectError(() => arraysOf(source), 'UnsupportedGeometry', { reason });
    expectError(() => meshOf(source), 'UnsupportedGeometry', { reason });
  });

  it('is refused where the numbers are not those of triangles', () => {
    const points = bare().setAttribute('position', new BufferAttribute(new Float32Array(12), 3));
    expectError(() => arraysOf(points), 'TrianglesNotTriples', { length: 4 });
    points.setIndex([0, 1, 1, 2]);
    expectError(() => arraysOf(points), 'TrianglesNotTriples', { length: 4 });
    points.setIndex([0, 1, 4]);
    expectError(() => meshOf(points), 'IndexOutOfBounds', { index: 4 });
    for (const source of [undefined, null, {}, new three.Group(), [1, 2, 3]])
      expectError(() => arraysOf(source), 'InvalidArgument', { argument: 'geometry' });
    expectError(() => meshOf(new BoxGeometry(), { welt: true }), 'UnknownOption', { option: 'welt', meant: 'weld' });
    expectError(() => meshOf(new BoxGeometry(), { colormap: 'magma' }), 'UnknownOption', { belongsTo: expect.any(Array) }); // prettier-ignore
    expectError(() => meshOf(new BoxGeometry(), 5), 'InvalidArgument');
    expectError(() => meshOf(new BoxGeometry(), { weld: 5 }), 'InvalidOption', { option: 'weld' });
    expect(api.MorseSmoothError).toBe(Shared);
  });
});

describe('the geometry of a mesh', () => {
  it('is that mesh again', () => {
    const { positions, triangles } = square(3);
    const geometry = geometryOf({ positions, triangles });
    expect(arraysOf(geometry)).toEqual({
      positions: Float64Array.from(positions),
      triangles: Uint32Array.from(triangles),
    });
    expect([...geometry.attributes.normal.array.slice(0, 3)]).toEqual([0, 0, 1]);
    const soup = geometryOf({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: null });
    expect(soup.index).toBe(null);
    expect([...arraysOf(soup).triangles]).toEqual([0, 1, 2]);
  });

  it('needs arrays', () => {
    expectError(() => geometryOf(), 'InvalidArgument', { argument: 'arrays' });
    expectError(() => geometryOf(new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2])), 'InvalidArgument');
    expectError(() => geometryOf({ positions: [0, 0, 0] }), 'InvalidArgument', { argument: 'triangles' });
    expectError(() => geometryOf({ positions: [0, 0, 0], triangles: [0, 0, -1] }), 'IndexOutOfBounds');
  });
});

describe('a field', () => {
  const sphere = new SphereGeometry(1, 32, 16);
  let mesh, vertexMap, heights;
  beforeAll(() => {
    ({ mesh, vertexMap } = meshOf(sphere));
    heights = heightsOf(mesh);
  });

  it('is an attribute, and a field again', () => {
    const attribute = fieldAttribute(heights, vertexMap);
    expect([attribute.count, attribute.itemSize]).toEqual([sphere.attributes.position.count, 1]);
    for (let k = 0; k < attribute.count; k++)
      expect(attribute.getX(k)).toBeCloseTo(sphere.attributes.position.getZ(k), 6);
    const { values, seams } = fieldValues(attribute, vertexMap);
    expect([...values]).toEqual([...Float32Array.from(heights)]);
    expect(seams).toHaveLength(0);
    // Where the vertices are the same.
    expect([...fieldAttribute([1, 2, NaN], null).array]).toEqual([1, 2, NaN]);
    expect([...fieldValues(new BufferAttribute(Float32Array.of(1, 2, NaN), 1), null).values]).toEqual([1, 2, NaN]);
  });

  it('fills an attribute anew', () => {
    const target = fieldAttribute(heights, vertexMap);
    const { version } = target;
    expect(
      fieldAttribute(
        heights.map((z) => -z),
        vertexMap,
        { target },
      ),
    ).toBe(target);
    expect(target.version).toBe(version + 1);
    expect(target.getX(40)).toBeCloseTo(-sphere.attributes.position.getZ(40), 6);
    const buffer = new three.InterleavedBuffer(new Float32Array(2 * target.count), 2);
    const other = new three.InterleavedBufferAttribute(buffer, 1, 1);
    fieldAttribute(heights, vertexMap, { target: other });
    expect(buffer.array[81]).toBeCloseTo(sphere.attributes.position.getZ(40), 6);
    const wrong = new BufferAttribute(new Float32Array(5), 1);
    expectError(() => fieldAttribute(heights, vertexMap, { target: wrong }), 'InvalidOption', { option: 'target' });
    expectError(() => fieldAttribute(heights, vertexMap, { target: 5 }), 'InvalidArgument');
  });

  it('is told where corners of one vertex disagree', () => {
    const attribute = fieldAttribute(heights, vertexMap);
    const [a, b] = [0, 1].map((nth) => [...vertexMap.keys()].filter((k) => vertexMap[k] === vertexMap[33])[nth]);
    attribute.setX(b, attribute.getX(a) + 0.5);
    const detail = { vertex: vertexMap[33], corners: [a, b], count: 1 };
    expectError(() => fieldValues(attribute, vertexMap), 'SeamDisagreement', detail);
    expectError(() => fieldValues(attribute, vertexMap, { tolerance: 0.49 }), 'SeamDisagreement', detail);
    const mean = attribute.getX(a) + 0.25;
    const passed = fieldValues(attribute, vertexMap, { tolerance: 0.51 });
    expect([passed.values[vertexMap[33]], passed.seams.length]).toEqual([mean, 0]);
    const taken = fieldValues(attribute, vertexMap, { seams: 'mean' });
    expect([taken.values[vertexMap[33]], [...taken.seams]]).toEqual([mean, [vertexMap[33]]]);
    // A missing value beside one that is there, whatever the tolerance; but not beside another one.
    attribute.setX(b, NaN);
    expectError(() => fieldValues(attribute, vertexMap, { tolerance: 9 }), 'SeamDisagreement', detail);
    expect(fieldValues(attribute, vertexMap, { seams: 'mean' }).values[vertexMap[33]]).toBe(attribute.getX(a));
    attribute.setX(a, NaN);
    expect(fieldValues(attribute, vertexMap).values[vertexMap[33]]).toBe(NaN);
  });

  it('is one component of an attribute with several', () => {
    const { position } = sphere.attributes;
    const { values } = fieldValues(position, vertexMap, { component: 2, tolerance: 1e-6 });
    values.forEach((value, vertex) => expect(value).toBeCloseTo(heights[vertex], 6));
    expectError(() => fieldValues(position, vertexMap), 'InvalidOption', { option: 'component' });
    expectError(() => fieldValues(position, vertexMap, { component: 3 }), 'InvalidOption', { option: 'component' });
  });

  it('must be one of that mesh', () => {
    const [expected, actual] = [mesh.vertexCount, mesh.vertexCount - 1];
    const short = heights.subarray(1);
    for (const call of [fieldAttribute, api.colorAttribute, api.shadeAttribute]) {
      expectError(() => call(short, vertexMap), 'LengthMismatch', { expected, actual });
      expectError(() => call('heights', vertexMap), 'InvalidArgument', { argument: 'values' });
      expectError(() => call(heights, 'map'), 'InvalidArgument', { argument: 'vertexMap' });
      expectError(() => call(heights, [0.5]), 'InvalidArgument', { argument: 'vertexMap', index: 0 });
      expectError(() => call(heights, vertexMap, { into: 5 }), 'UnknownOption', { option: 'into' });
    }
    const attribute = new BufferAttribute(new Float32Array(5), 1);
    expectError(() => fieldValues(attribute, vertexMap), 'LengthMismatch', { expected: 561, actual: 5 });
    expectError(() => fieldValues(new Float32Array(5), vertexMap), 'InvalidArgument', { argument: 'attribute' });
    expectError(() => fieldValues(attribute, null, { seams: 'first' }), 'InvalidOption', { option: 'seams' });
    expectError(() => fieldValues(attribute, null, { tolerance: -1 }), 'InvalidOption', { option: 'tolerance' });
  });
});
