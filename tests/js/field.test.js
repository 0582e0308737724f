import init, { TriMesh } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { heights, moebius, octahedron, random, square, sum, tetrahedron, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const noise = (mesh, seed) => Float64Array.from({ length: mesh.vertexCount }, random(seed));

describe('critical points', () => {
  it('of height on an octahedron', () => {
    // Vertex 4 is up, 5 is down; the others are level, told apart by their numbers: 0, 1 are opposite, as are 2, 3.
    const shape = octahedron();
    const found = make(shape).criticalPoints(heights(shape));
    expect(found.counts).toEqual({ minima: 1, maxima: 1, saddles: 0, indexSum: 2 });
    expect(found).toEqual({
      vertices: Uint32Array.of(4, 5),
      kinds: Int8Array.of(1, -1),
      multiplicities: Uint32Array.of(1, 1),
      onBoundary: Uint8Array.of(0, 0),
      counts: found.counts,
    });
  });

  it('of height on an upright torus', () => {
    const shape = torus();
    const { vertices, kinds, counts } = make(shape).criticalPoints(heights(shape));
    expect(counts).toEqual({ minima: 1, maxima: 1, saddles: 2, indexSum: 0 });
    const z = heights(shape);
    const at = (kind) => [...vertices].filter((_, k) => kinds[k] === kind).map((vertex) => z[vertex]);
    // The circles of radius 3 and 1 in the plane x = 0 carry them.
    expect(at(-1)[0]).toBeCloseTo(-3, 1);
    expect(at(1)[0]).toBeCloseTo(3, 1);
    expect(at(0).map(Math.round).sort()).toEqual([-1, 1]);
  });

  it('of a monkey saddle on a square', () => {
    // Re (x + iy)³ around the middle vertex, (3, 3).
    const shape = square(6);
    const values = Array.from({ length: 49 }, (_, k) => {
      const [x, y] = [(k % 7) - 3 + 1e-3, Math.floor(k / 7) - 3 + 2e-3];
      return x ** 3 - 3 * x * y ** 2;
    });
    const { vertices, kinds, multiplicities, onBoundary, counts } = make(shape).criticalPoints(values);
    expect(counts.indexSum).toBe(1);
    const inner = [...vertices].map((_, k) => k).filter((k) => !onBoundary[k] && kinds[k] === 0);
    expect(inner.reduce((total, k) => total + multiplicities[k], 0)).toBe(2);
    expect([...vertices]).toEqual([...vertices].sort((a, b) => a - b));
  });

  it('sum up to the Euler characteristic on any surface and any field', () => {
    const bowtie = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0], triangles: [0, 1, 2, 0, 3, 4] };
    for (const shape of [tetrahedron(), octahedron(), torus(20, 10), square(12), moebius(), bowtie]) {
      const mesh = make(shape);
      const chi = mesh.topology.eulerCharacteristic;
      const fields = [1, 2, 3].map((seed) => noise(mesh, seed));
      fields.push(
        heights(shape),
        new Float64Array(mesh.vertexCount),
        fields[0].map((x) => Math.floor(3 * x)),
      );
      for (const values of fields) {
        const { counts } = mesh.criticalPoints(values);
        expect(counts.indexSum).toBe(chi);
        if (mesh.topology.closed) expect(counts.minima + counts.maxima - counts.saddles).toBe(chi);
      }
    }
  });

  it('swap with the sign of the field', () => {
    const mesh = make(torus(20, 10));
    const values = noise(mesh, 5);
    const { counts } = mesh.criticalPoints(values);
    const turned = mesh.criticalPoints(values.map((x) => -x)).counts;
    expect(turned).toMatchObject({ minima: counts.maxima, maxima: counts.minima, saddles: counts.saddles });
  });

  it('become fewer as δ grows, in both readings', () => {
    const mesh = make(torus(40, 20));
    const values = noise(mesh, 6);
    for (const link of ['consecutive', 'skip']) {
      let last = new Set(mesh.criticalPoints(values).vertices);
      for (const delta of [1e-3, 0.02, 0.1, 0.3, 0.6, 1]) {
        const { vertices, counts } = mesh.criticalPoints(values, { delta, link });
        for (const vertex of vertices) expect(last.has(vertex)).toBe(true);
        expect(counts.indexSum).toBeNull();
        last = new Set(vertices);
      }
      expect(last.size).toBe(0);
    }
  });

  it('take δ as a fraction of the greatest edge difference, or in units of the field', () => {
    // On the tetrahedron every vertex sees every other.
    const mesh = make(tetrahedron());
    const values = [0, 1, 2, 10];
    const count = (delta, deltaIs) => {
      const { minima, maxima } = mesh.criticalPoints(values, { delta, deltaIs }).counts;
      return [minima, maxima];
    };
    expect(count(0.09, 'relative')).toEqual([1, 1]);
    expect(count(0.11, 'relative')).toEqual([0, 1]);
    expect(count(0.9, 'absolute')).toEqual([1, 1]);
    expect(count(1.1, 'absolute')).toEqual([0, 1]);
    expect(count(8.1, 'absolute')).toEqual([0, 0]);
  });

  it('of a constant field: none for any δ > 0, and nothing breaks', () => {
    const mesh = make(octahedron());
    const counts = (options) => mesh.criticalPoints(new Float64Array(6), options).counts;
    expect(counts({ delta: 0.1 })).toEqual({ minima: 0, maxima: 0, saddles: 0, indexSum: null });
    expect(counts().indexSum).toBe(2);
  });

  it('by the literal rule: extrema grow with δ', () => {
    const mesh = make(torus(40, 20));
    const values = noise(mesh, 7);
    const extrema = (delta) => mesh.criticalPoints(values, { delta, rule: 'literal' }).counts.minima;
    expect(extrema(0.4)).toBeGreaterThan(extrema(0));
  });
});

describe('level sets', () => {
  const check = (shape, values, sets) => {
    const lines = sets.levels.length;
    expect(sets.closed.length).toBe(lines);
    expect(sets.offsets.length).toBe(lines + 1);
    expect(sets.offsets[0]).toBe(0);
    expect(sets.offsets[lines] * 3).toBe(sets.points.length);
    expect(sets.parameters.length * 2).toBe(sets.edges.length);
    for (let line = 0; line < lines; line++) {
      for (let k = sets.offsets[line]; k < sets.offsets[line + 1]; k++) {
        const [a, b, t] = [sets.edges[2 * k], sets.edges[2 * k + 1], sets.parameters[k]];
        expect(t).toBeGreaterThanOrEqual(0);
        expect(t).toBeLessThanOrEqual(1);
        expect((1 - t) * values[a] + t * values[b]).toBeCloseTo(sets.levels[line], 12);
        for (let axis = 0; axis < 3; axis++) {
          const along = (1 - t) * shape.positions[3 * a + axis] + t * shape.positions[3 * b + axis];
          expect(sets.points[3 * k + axis]).toBeCloseTo(along, 12);
        }
      }
    }
  };

  it('of height on a torus: one circle, two, one', () => {
    const shape = torus();
    const mesh = make(shape);
    const values = heights(shape);
    const sets = mesh.levelSets(values, [-2, 0, 2.5]);
    check(shape, values, sets);
    expect([...sets.levels]).toEqual([-2, 0, 0, 2.5]);
    expect([...sets.closed]).toEqual([1, 1, 1, 1]);
    // Through the middle, z = 0: circles of radius 1 around (0, ±2, 0), cut out of a polygon of 24 sides.
    const middle = sets.points.subarray(3 * sets.offsets[1], 3 * sets.offsets[3]);
    for (let k = 0; k < middle.length; k += 3) {
      expect(Math.hypot(middle[k], Math.abs(middle[k + 1]) - 2)).toBeCloseTo(1, 1);
      expect(middle[k + 2]).toBeCloseTo(0, 12);
    }
  });

  it('of x on a square: one straight open line from edge to edge', () => {
    const shape = square(8);
    const values = shape.positions.filter((_, k) => k % 3 === 0);
    const sets = make(shape).levelSets(values, [2.25]);
    check(shape, values, sets);
    expect([...sets.closed]).toEqual([0]);
    const y = sets.points.filter((_, k) => k % 3 === 1);
    expect([y[0], y.at(-1)].sort()).toEqual([0, 8]);
    expect(sets.points.filter((_, k) => k % 3 === 0).every((x) => x === 2.25)).toBe(true);
  });

  it('with a count cut the range into equal parts', () => {
    const shape = square(8);
    const values = shape.positions.filter((_, k) => k % 3 === 0);
    expect([...make(shape).levelSets(values, { count: 3 }).levels]).toEqual([2, 4, 6]);
    expect(make(shape).levelSets(new Float64Array(81), { count: 3 }).levels.length).toBe(0);
  });

  it('outside of the range are empty', () => {
    const shape = square(2);
    const sets = make(shape).levelSets(heights(shape), Float64Array.of(-1, 5));
    expect(sets.levels.length).toBe(0);
    expect([...sets.offsets]).toEqual([0]);
  });
});

describe('refused', () => {
  const mesh = () => make(tetrahedron());

  it('values', () => {
    const methods = [
      (values) => mesh().criticalPoints(values),
      (values) => mesh().levelSets(values, [0]),
      (values) => mesh().smoothness(values),
    ];
    for (const method of methods) {
      expectError(() => method([1, 2, 3]), 'LengthMismatch', { expected: 4, actual: 3 });
      expectError(() => method(new Float32Array(5)), 'LengthMismatch', { expected: 4, actual: 5 });
      expectError(() => method([1, 2, NaN, 4]), 'NonFiniteValue', { vertex: 2 });
      expectError(() => method([1, 2, 3, Infinity]), 'NonFiniteValue', { vertex: 3 });
      expectError(() => method([1, '2', 3, 4]), 'InvalidArgument', { argument: 'values', index: 1 });
      expectError(() => method([1, 2, 3, 4n]), 'InvalidArgument', { argument: 'values', index: 3 });
      expectError(() => method('1234'), 'InvalidArgument', { argument: 'values' });
      expectError(() => method(), 'InvalidArgument', { argument: 'values' });
      expectError(() => method(new BigInt64Array(4)), 'InvalidArgument', { argument: 'values' });
      expectError(() => method([1e308, -1e308, 0, 0]), 'RangeOverflow');
      const transferred = new Float64Array(4);
      structuredClone(transferred.buffer, { transfer: [transferred.buffer] });
      expectError(() => method(transferred), 'InvalidArgument', { argument: 'values', detached: true });
    }
  });

  it('options of criticalPoints, after which the same mesh goes on working', () => {
    const same = mesh();
    const call = (options) => () => same.criticalPoints([1, 2, 3, 4], options);
    expectError(call({ detla: 0.1 }), 'UnknownOption', { option: 'detla' });
    expectError(call({ delta: -0.1 }), 'InvalidOption', { option: 'delta' });
    expectError(call({ delta: NaN }), 'InvalidOption', { option: 'delta' });
    expectError(call({ delta: '0.1' }), 'InvalidOption', { option: 'delta' });
    expectError(call({ deltaIs: 'percent' }), 'InvalidOption', { option: 'deltaIs' });
    expectError(call({ link: 'other' }), 'InvalidOption', { option: 'link' });
    expectError(call({ rule: 1 }), 'InvalidOption', { option: 'rule' });
    for (const options of ['relative', new Map([['delta', 0.1]]), Object.create({ delta: 0.1 })]) {
      expectError(call(options), 'InvalidArgument', { argument: 'options' });
    }
    expect(call({ delta: undefined, link: undefined })().counts.minima).toBe(1);
  });

  it('levels', () => {
    const call = (levels) => () => mesh().levelSets([1, 2, 3, 4], levels);
    expectError(call([1, NaN]), 'NonFiniteLevel', { index: 1 });
    expectError(call([1, null]), 'InvalidArgument', { argument: 'levels', index: 1 });
    expectError(call('1'), 'InvalidArgument', { argument: 'levels' });
    expectError(call(), 'InvalidArgument', { argument: 'levels' });
    expectError(call({}), 'InvalidArgument', { argument: 'levels' });
    expectError(call({ cuont: 3 }), 'UnknownOption', { option: 'cuont' });
    for (const count of [-1, 1.5, NaN, '3', 1e9]) expectError(call({ count }), 'InvalidOption', { option: 'count' });
    expect(sum(call([2.5])().levels)).toBe(2.5);
  });

  it('more points than there is memory for, without a trap', () => {
    const grid = make(square(149));
    expectError(() => grid.levelSets(noise(grid, 1), { count: 10000 }), 'OutOfMemory');
    expect(grid.levelSets(noise(grid, 1), { count: 1 }).levels.length).toBeGreaterThan(1);
  });
});
