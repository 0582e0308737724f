import init, { TriMesh } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { component, heights, moebius, octahedron, random, square, sum, tetrahedron, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const noise = (mesh, seed) => Float64Array.from({ length: mesh.vertexCount }, random(seed));
const count = (array, value) => array.reduce((total, entry) => total + (entry === value), 0);

describe('the hierarchy over δ', () => {
  it('of four vertices that all see each other', () => {
    expect(make(tetrahedron()).deltaHierarchy([0, 1, 2, 10])).toEqual({
      vertices: Uint32Array.of(0, 3),
      kinds: Int8Array.of(-1, 1),
      vanishesAt: Float64Array.of(0.1, 0.8),
      vanishesAtAbsolute: Float64Array.of(1, 8),
      delta: Float64Array.of(0, 0.1, 0.8),
      minima: Uint32Array.of(1, 0, 0),
      maxima: Uint32Array.of(1, 1, 0),
      saddles: Uint32Array.of(0, 0, 0),
    });
  });

  it('has for every δ what criticalPoints finds', () => {
    for (const shape of [torus(30, 20), square(20), moebius()]) {
      const mesh = make(shape);
      const rough = noise(mesh, 3);
      for (const values of [rough, rough.map((x) => Math.round(4 * x)), new Float64Array(mesh.vertexCount)]) {
        for (const link of ['consecutive', 'skip']) {
          const found = mesh.deltaHierarchy(values, { link });
          const deltas = found.delta.filter((_, k) => k < 3 || k % 17 === 0);
          for (const delta of [...deltas, 0.01, 0.3, 1]) {
            const row = found.delta.findLastIndex((start) => start <= delta);
            const { vertices, kinds, counts } = mesh.criticalPoints(values, { delta, link });
            const { minima, maxima, saddles } = counts;
            expect([found.minima[row], found.maxima[row], found.saddles[row]]).toEqual([minima, maxima, saddles]);
            const there = (_, k) => delta === 0 || found.vanishesAt[k] > delta;
            expect(found.vertices.filter(there)).toEqual(vertices);
            expect(found.kinds.filter(there)).toEqual(kinds);
          }
          const delta = found.vanishesAtAbsolute[0];
          const { vertices } = mesh.criticalPoints(values, { delta, deltaIs: 'absolute', link });
          const there = (_, k) => delta === 0 || found.vanishesAtAbsolute[k] > delta;
          expect(found.vertices.filter(there)).toEqual(vertices);
        }
      }
    }
  });

  it('of a constant field is over at the least positive number', () => {
    const { delta, vanishesAt, minima, maxima } = make(tetrahedron()).deltaHierarchy(new Float64Array(4));
    expect([...delta]).toEqual([0, Number.MIN_VALUE]);
    expect([...vanishesAt]).toEqual([0, 0]);
    expect([...minima, ...maxima]).toEqual([1, 0, 1, 0]);
  });
});

describe('levels at saddles', () => {
  it('of height on a torus: one circle, two, two, one', () => {
    const shape = torus();
    const mesh = make(shape);
    const values = heights(shape);
    for (const offset of [undefined, 0, 0.01]) {
      const { levels } = mesh.levelSets(values, { saddles: true, offset });
      const distinct = [...new Set(levels)];
      expect(distinct.map((level) => count(levels, level))).toEqual([1, 2, 2, 1]);
    }
  });

  it('of the saddles that are named, or of other vertices', () => {
    const shape = torus();
    const mesh = make(shape);
    const values = heights(shape);
    const { vertices, kinds } = mesh.criticalPoints(values);
    const saddles = [...vertices].filter((_, k) => kinds[k] === 0);
    const upper = saddles.reduce((a, b) => (values[a] > values[b] ? a : b));
    for (const ids of [[upper], Uint32Array.of(upper), Uint16Array.of(upper, upper)]) {
      const { levels } = mesh.levelSets(values, { saddles: ids });
      expect([...levels].map((level) => level === values[upper])).toEqual([true, true, false]);
      expect(levels[2]).toBeGreaterThan(values[upper]);
    }
    expect(mesh.levelSets(values, { saddles: [] }).levels.length).toBe(0);
    expect(mesh.levelSets(values, { saddles: [7], offset: 0.1 }).levels.length).toBeGreaterThan(1);
    expect(mesh.levelSets(values, { saddles }).levels).toEqual(mesh.levelSets(values, { saddles: true }).levels);
  });

  it('of a monkey saddle: three lines on either side', () => {
    // A middle vertex and six around it.
    const around = [0, 1, 2, 3, 4, 5].map((k) => [Math.cos((k * Math.PI) / 3), Math.sin((k * Math.PI) / 3), 0]);
    const triangles = [0, 1, 2, 3, 4, 5].flatMap((k) => [0, 1 + k, 1 + ((k + 1) % 6)]);
    const mesh = new TriMesh([0, 0, 0, ...around.flat()], triangles);
    const { levels } = mesh.levelSets([0, 1, -1, 1, -1, 1, -1], { saddles: true });
    expect([...levels]).toEqual([0, 0, 0, ...new Array(3).fill(Number.MIN_VALUE)]);
  });
});

describe('bands', () => {
  const areas = ({ points, triangles, bands, levels }) => {
    const found = new Array(levels.length + 1).fill(0);
    bands.forEach((band, t) => {
      const [p, q, r] = [0, 1, 2].map((k) => points.subarray(3 * triangles[3 * t + k], 3 * triangles[3 * t + k] + 3));
      const [u, v] = [q, r].map((end) => [0, 1, 2].map((axis) => end[axis] - p[axis]));
      const across = [0, 1, 2].map((i) => u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
      found[band] += Math.hypot(...across) / 2;
    });
    return found;
  };

  it('of x on a square are strips', () => {
    const shape = square(8);
    const x = component(shape.positions, 0);
    const found = make(shape).bands(x, [6.5, 2, 2]);
    expect([...found.levels]).toEqual([2, 6.5]);
    areas(found).forEach((area, band) => expect(area).toBeCloseTo([16, 36, 12][band], 12));
    expect(found.parents.length).toBe(found.bands.length);
    expect(found.triangles.length).toBe(3 * found.bands.length);
    expect(found.parameters.length * 3).toBe(found.points.length);
    for (let k = 0; k < found.parameters.length; k++) {
      const [a, b, t] = [found.edges[2 * k], found.edges[2 * k + 1], found.parameters[k]];
      expect((1 - t) * x[a] + t * x[b]).toBeCloseTo(found.points[3 * k], 12);
      if (a !== b) expect(found.points[3 * k]).toBeCloseTo(6.5, 12);
    }
  });

  it('by number, of any surface and field, cover it', () => {
    for (const shape of [torus(20, 10), square(12), moebius()]) {
      const mesh = make(shape);
      for (const levels of [{ count: 7 }, { count: 0 }, [], new Float32Array([0.25, 0.5])]) {
        const found = mesh.bands(noise(mesh, 4), levels);
        expect(sum(areas(found))).toBeCloseTo(mesh.area, 10);
        expect(Math.max(...found.bands)).toBe(found.levels.length);
      }
    }
  });

  it('without levels are the mesh', () => {
    const shape = octahedron();
    const found = make(shape).bands(heights(shape), []);
    expect(found.points).toEqual(Float64Array.from(shape.positions));
    expect([...found.bands]).toEqual(new Array(8).fill(0));
    expect([...found.parents]).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
  });
});

describe('refused', () => {
  const same = () => make(tetrahedron());

  it('values', () => {
    const mesh = same();
    const methods = [
      (values) => mesh.deltaHierarchy(values),
      (values) => mesh.bands(values, [0]),
      (values) => mesh.levelSets(values, { saddles: true }),
    ];
    for (const method of methods) {
      expectError(() => method([1, 2, 3]), 'LengthMismatch', { expected: 4, actual: 3 });
      expectError(() => method([1, 2, NaN, 4]), 'NonFiniteValue', { vertex: 2 });
      expectError(() => method([1e308, -1e308, 0, 0]), 'RangeOverflow');
      expectError(() => method([1, '2', 3, 4]), 'InvalidArgument', { argument: 'values', index: 1 });
      expectError(() => method(), 'InvalidArgument', { argument: 'values' });
    }
    mesh.free();
    for (const method of methods) expectError(() => method([1, 2, 3, 4]), 'UseAfterFree');
  });

  it('options of deltaHierarchy', () => {
    const call = (options) => () => same().deltaHierarchy([1, 2, 3, 4], options);
    expectError(call({ delta: 0.1 }), 'UnknownOption', { option: 'delta' });
    expectError(call({ rule: 'literal' }), 'UnknownOption', { option: 'rule' });
    expectError(call({ link: 'other' }), 'InvalidOption', { option: 'link' });
    expectError(call({ link: 1 }), 'InvalidOption', { option: 'link' });
    expectError(call('skip'), 'InvalidArgument', { argument: 'options' });
  });

  it('saddles', () => {
    const call = (levels) => () => same().levelSets([1, 2, 3, 4], levels);
    for (const saddles of [false, 1, 'all', () => true]) {
      expectError(call({ saddles }), 'InvalidArgument', { argument: 'saddles' });
    }
    for (const saddles of [{}, new Float64Array(1), new BigInt64Array(1), new Map()]) {
      expectError(call({ saddles }), 'InvalidArgument', { argument: 'saddles' });
    }
    expectError(call({ saddles: ['0'] }), 'InvalidArgument', { argument: 'saddles', index: 0 });
    expectError(call({ saddles: [0, 4] }), 'IndexOutOfBounds', { index: 4, vertices: 4 });
    expectError(call({ saddles: Uint32Array.of(9) }), 'IndexOutOfBounds', { index: 9, vertices: 4 });
    for (const id of [-1, 1.5, NaN, 2 ** 32]) {
      expectError(call({ saddles: [id] }), 'IndexOutOfBounds', { index: id, vertices: 4 });
    }
    for (const offset of [-0.1, NaN, Infinity, '1']) {
      expectError(call({ saddles: true, offset }), 'InvalidOption', { option: 'offset' });
    }
    expectError(call({ saddles: true, count: 3 }), 'InapplicableOption', { option: 'saddles' });
    expectError(call({ count: 3, offset: 0.1 }), 'InapplicableOption', { option: 'offset' });
    expectError(call({ offset: 0.1 }), 'InvalidArgument', { argument: 'levels' });
    expectError(call({ saddles: undefined }), 'InvalidArgument', { argument: 'levels' });
    expect(call({ count: 1, saddles: undefined })().levels.length).toBe(1);
  });

  it('more saddles than there can be levels', () => {
    const mesh = make(square(199));
    expectError(() => mesh.levelSets(noise(mesh, 1), { saddles: true }), 'InvalidOption', { option: 'saddles' });
    expect(mesh.levelSets(noise(mesh, 1), { saddles: [777] }).levels.length).toBeGreaterThan(1);
  });

  it('levels of bands', () => {
    const call = (levels) => () => same().bands([1, 2, 3, 4], levels);
    expectError(call([1, NaN]), 'NonFiniteLevel', { index: 1 });
    expectError(call(new Float64Array(10001)), 'InvalidOption', { option: 'levels' });
    expectError(call([1, null]), 'InvalidArgument', { argument: 'levels', index: 1 });
    expectError(call(), 'InvalidArgument', { argument: 'levels' });
    expectError(call({}), 'InvalidArgument', { argument: 'levels' });
    expectError(call({ saddles: true }), 'UnknownOption', { option: 'saddles' });
    for (const count of [-1, 1.5, '3', 1e9]) expectError(call({ count }), 'InvalidOption', { option: 'count' });
  });

  it('more bands than there is memory for, without a trap', () => {
    const mesh = make(square(149));
    expectError(() => mesh.bands(noise(mesh, 1), { count: 10000 }), 'OutOfMemory');
    expect(mesh.bands(noise(mesh, 1), { count: 1 }).bands.length).toBeGreaterThan(2 * 149 ** 2);
  });
});
