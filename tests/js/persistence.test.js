import init, { TriMesh } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { takeAnyValues } from './any-values.js';
import { expectError } from './errors.js';
import {
  heights,
  islands,
  moebius,
  octahedron,
  pinched,
  random,
  sphere,
  square,
  tetrahedron,
  torus,
} from './meshes.js';
import { homology, mergers } from './truths.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const noise = ({ positions }, seed) => Float64Array.from({ length: positions.length / 3 }, random(seed));
/** Few different values, so that most comparisons are between equals. */
const tied = (shape, seed) => noise(shape, seed).map((x) => Math.floor(5 * x));
const bumpy = (shape, seed) => noise(shape, seed).map((x, v) => heights(shape)[v] + x);
const shapes = {
  tetrahedron: tetrahedron(),
  octahedron: octahedron(),
  sphere: sphere(3),
  torus: torus(20, 12),
  square: square(9),
  'Möbius strip': moebius(),
  islands: islands(),
};
const closed = ['tetrahedron', 'octahedron', 'sphere', 'torus', 'islands'];
/** Of the vertices that belong to triangles. */
function rangeOf({ triangles }, values) {
  const used = triangles.map((v) => values[v]);
  return Math.max(...used) - Math.min(...used);
}
const byNumbers = (a, b) => a[0] - b[0] || a[1] - b[1];

/** The pairs of one kind as [extremum, saddle]. */
const pairsOf = ({ extrema, saddles, kinds }, kind) =>
  [...extrema].flatMap((extremum, k) => (kinds[k] === kind ? [[extremum, saddles[k]]] : [])).sort(byNumbers);

/** The extrema that are more persistent than a threshold, by the pairs. */
function above(found, threshold) {
  const kept = [...found.extrema].filter((_, k) => found.persistence[k] > threshold);
  return [...kept, ...found.essentialMinima, ...found.essentialMaxima].sort((a, b) => a - b);
}

/** The extrema of a field. */
function extremaOf(mesh, values) {
  const { vertices, kinds } = mesh.criticalPoints(values);
  return [...vertices].filter((_, k) => kinds[k] !== 0);
}

describe('persistence', () => {
  it('of height on an upright torus: nothing to pair', () => {
    const shape = torus();
    const z = heights(shape);
    const found = make(shape).persistence(z);
    for (const name of ['extrema', 'saddles', 'kinds', 'birth', 'death', 'persistence']) {
      expect(found[name].length, name).toBe(0);
    }
    expect([...found.essentialMinima]).toEqual([z.indexOf(Math.min(...z))]);
    expect([...found.essentialMaxima]).toEqual([z.indexOf(Math.max(...z))]);
    // Its inner circle has the radius 1.
    expect([...found.essentialSaddles].map((v) => Math.round(z[v]))).toEqual([-1, 1]);
  });

  it('of hills and valleys on a square, in the types that are documented', () => {
    // Ridges and valleys across the square that rise with y: crossed lowest at y = 0, highest at y = 6.
    const profile = [4, 1, 6, 2, 9, 7, 10];
    const values = Array.from({ length: 49 }, (_, v) => profile[v % 7] * (100 + Math.floor(v / 7)));
    expect(make(square(6)).persistence(values)).toEqual({
      extrema: Uint32Array.of(44, 3, 42, 46, 5),
      saddles: Uint32Array.of(45, 2, 43, 47, 4),
      kinds: Int8Array.of(1, -1, 1, 1, -1),
      birth: Float64Array.of(212, 200, 106, 742, 700),
      death: Float64Array.of(636, 600, 424, 954, 900),
      persistence: Float64Array.of(424, 400, 318, 212, 200),
      essentialMinima: Uint32Array.of(1),
      essentialMaxima: Uint32Array.of(48),
      essentialSaddles: new Uint32Array(0),
    });
  });

  it.each(Object.keys(shapes))('is that of a union–find over the sorted vertices: %s', (name) => {
    const shape = shapes[name];
    const mesh = make(shape);
    for (const values of [noise(shape, 1), noise(shape, 2), bumpy(shape, 3), tied(shape, 4), noise(shape, 5).fill(7)]) {
      const found = mesh.persistence(values);
      const [down, up] = [mergers(shape, values, true), mergers(shape, values, false)];
      expect(pairsOf(found, -1)).toEqual(down.pairs.sort(byNumbers));
      expect(pairsOf(found, 1)).toEqual(up.pairs.sort(byNumbers));
      expect([...found.essentialMinima]).toEqual(down.essential);
      expect([...found.essentialMaxima]).toEqual(up.essential);
      found.extrema.forEach((extremum, k) => {
        const ends = [values[extremum], values[found.saddles[k]]];
        expect([found.birth[k], found.death[k]]).toEqual(found.kinds[k] < 0 ? ends : ends.reverse());
        expect(found.persistence[k]).toBe(found.death[k] - found.birth[k]);
        expect(found.persistence[k]).toBeLessThanOrEqual(found.persistence[Math.max(0, k - 1)]);
      });
    }
  });

  it.each(closed)('is that of the boundary matrix: %s', (name) => {
    const shape = shapes[name];
    const mesh = make(shape);
    for (const values of [noise(shape, 6), tied(shape, 7)]) {
      const found = mesh.persistence(values);
      const { pairs, essential } = homology(shape, values);
      expect(pairsOf(found, -1)).toEqual(pairs[0].sort(byNumbers));
      // A loop begins at the saddle, and is filled in at the maximum.
      expect(pairsOf(found, 1)).toEqual(pairs[1].map(([saddle, maximum]) => [maximum, saddle]).sort(byNumbers));
      const numbers = (list) => [...list].sort((a, b) => a - b);
      expect(numbers(found.essentialSaddles)).toEqual(numbers(essential[1]));
      expect(numbers(found.essentialMaxima)).toEqual(numbers(essential[2]));
    }
  });

  it.each(Object.keys(shapes))('adds up to the Euler characteristic: %s', (name) => {
    const mesh = make(shapes[name]);
    const { eulerCharacteristic, components, isolatedVertices } = mesh.topology;
    const chi = eulerCharacteristic - isolatedVertices;
    for (const values of [noise(shapes[name], 8), tied(shapes[name], 9)]) {
      const found = mesh.persistence(values);
      const { minima, maxima, saddles } = mesh.criticalPoints(values).counts;
      expect(found.essentialMinima.length).toBe(components);
      expect(found.essentialMaxima.length).toBe(components);
      expect(found.extrema.length).toBe(minima + maxima - 2 * components);
      // χ = b₀ − b₁ + b₂
      expect(components - found.essentialSaddles.length + (closed.includes(name) ? components : 0)).toBe(chi);
      if (closed.includes(name)) expect(found.extrema.length + found.essentialSaddles.length).toBe(saddles);
    }
  });

  it('turns over with the field', () => {
    const mesh = make(shapes.sphere);
    const values = noise(shapes.sphere, 10);
    const [found, turned] = [mesh.persistence(values), mesh.persistence(values.map((x) => -x))];
    expect(pairsOf(turned, 1)).toEqual(pairsOf(found, -1));
    expect(pairsOf(turned, -1)).toEqual(pairsOf(found, 1));
    expect(turned.persistence).toEqual(found.persistence);
  });
});

describe('the persistence curve', () => {
  it.each(Object.keys(shapes))('counts the pairs: %s', (name) => {
    const mesh = make(shapes[name]);
    for (const values of [noise(shapes[name], 11), tied(shapes[name], 12)]) {
      const found = mesh.persistence(values);
      const { threshold, minima, maxima } = mesh.persistenceCurve(values);
      expect([...threshold]).toEqual([...new Set([0, ...found.persistence])].sort((a, b) => a - b));
      const count = (kind, t) => [...found.kinds].filter((k, i) => k === kind && found.persistence[i] > t).length;
      expect([...minima]).toEqual([...threshold].map((t) => count(-1, t) + found.essentialMinima.length));
      expect([...maxima]).toEqual([...threshold].map((t) => count(1, t) + found.essentialMaxima.length));
    }
  });

  it('of height on a torus has one row', () => {
    const curve = make(torus()).persistenceCurve(heights(torus()));
    expect(curve).toEqual({ threshold: Float64Array.of(0), minima: Uint32Array.of(1), maxima: Uint32Array.of(1) });
  });
});

describe('simplify', () => {
  it.each(Object.keys(shapes))('leaves what is more persistent than the threshold, and changes no more: %s', (name) => {
    const mesh = make(shapes[name]);
    for (const values of [noise(shapes[name], 13), bumpy(shapes[name], 14), tied(shapes[name], 15)]) {
      const found = mesh.persistence(values);
      const range = rangeOf(shapes[name], values);
      for (const relative of [0, 0.03, 0.13, 0.37, 0.71, 1.5]) {
        const { values: simple, unavoidable } = mesh.simplify(values, { threshold: relative });
        expect(unavoidable).toEqual(new Uint32Array(0));
        expect(extremaOf(mesh, simple)).toEqual(above(found, relative * range));
        const change = Math.max(...simple.map((x, v) => Math.abs(x - values[v])));
        // Ties are told apart by a few of the smallest steps.
        expect(change).toBeLessThanOrEqual(relative === 0 ? 1e-12 : relative * range);
        expect(mesh.simplify(values, { threshold: relative * range, thresholdIs: 'absolute' }).values).toEqual(simple);
        expect(mesh.simplify(values, { threshold: relative, thresholdIs: 'relative' }).values).toEqual(simple);
        if (!closed.includes(name)) continue;
        const { eulerCharacteristic, isolatedVertices } = mesh.topology;
        const { minima, maxima, saddles } = mesh.criticalPoints(simple).counts;
        expect(minima + maxima - saddles).toBe(eulerCharacteristic - isolatedVertices);
      }
    }
  });

  it('leaves a smooth field as it is', () => {
    const shape = torus();
    expect(make(shape).simplify(heights(shape), { threshold: 0.2 }).values).toEqual(heights(shape));
  });

  it('fills the shallow valley up to its ridge and cuts the low hill, and no more', () => {
    const profile = [4, 1, 6, 2, 9, 7, 10];
    const values = Array.from({ length: 49 }, (_, v) => profile[v % 7] * (100 + Math.floor(v / 7)));
    // 250 is between the persistences 212 and 318. The valley at x = 5 fills up to 900, where it is crossed lowest; then the hill
    // beside it, at x = 4, sinks to that height.
    const { values: simple } = make(square(6)).simplify(values, { threshold: 250, thresholdIs: 'absolute' });
    values.forEach((value, v) => {
      if (v % 7 < 4) expect(simple[v]).toBe(value);
    });
    for (let y = 0; y < 7; y++)
      expect([simple[4 + 7 * y], simple[5 + 7 * y]]).toEqual([expect.closeTo(900, 8), expect.closeTo(900, 8)]);
  });

  it('leaves exactly what is to be kept', () => {
    for (const shape of [shapes.sphere, shapes.torus, shapes.square]) {
      const mesh = make(shape);
      const values = noise(shape, 16);
      const { vertices, kinds } = mesh.criticalPoints(values);
      const ofKind = (kind) => [...vertices].filter((_, k) => kinds[k] === kind);
      // Not the most persistent ones, but any.
      for (const [from, every] of [
        [0, 3],
        [1, 5],
        [2, 1000],
      ]) {
        const keep = [-1, 1].flatMap((kind) => ofKind(kind).filter((_, k) => k % every === from));
        const { values: simple } = mesh.simplify(values, { keep });
        const wanted = keep.toSorted((a, b) => a - b);
        expect(extremaOf(mesh, simple)).toEqual(wanted);
        for (const ids of [Uint32Array.from(keep), Uint16Array.from(keep), [...keep, ...keep].reverse()]) {
          expect(mesh.simplify(values, { keep: ids }).values).toEqual(simple);
        }
      }
      const { values: everything } = mesh.simplify(values, { keep: [...ofKind(-1), ...ofKind(1)] });
      expect(everything).toEqual(values);
    }
  });
});

describe('simplify where a mesh hangs together in one vertex', () => {
  it('does what it can, and lists the extrema that no field can do without', () => {
    // Vertices 4 to 6 are as good as level, but the lowest or highest of them has no way out except through 0.
    const values = [0, -9, 9, 5, 0.1, 0.1, 0.2];
    for (const [shape, field, threshold] of [
      [pinched(), values, 1],
      [
        { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0], triangles: [0, 1, 2, 0, 3, 4] },
        [0, 2, 3, 5, 4],
        0.7,
      ],
    ]) {
      const mesh = make(shape);
      const found = mesh.simplify(field, { threshold, thresholdIs: threshold === 1 ? 'absolute' : 'relative' });
      expect(found.unavoidable.length).toBeGreaterThan(0);
      const left = extremaOf(mesh, found.values);
      for (const vertex of found.unavoidable) expect(left).toContain(vertex);
    }
  });
});

describe('values and results', () => {
  const methods = {
    persistence: (mesh, values) => mesh.persistence(values),
    persistenceCurve: (mesh, values) => mesh.persistenceCurve(values),
    simplify: (mesh, values) => ({ values: mesh.simplify(values, { threshold: 0.3 }).values }),
  };

  takeAnyValues(methods);
});

describe('simplify refuses', () => {
  // On the octahedron 4 is the maximum of height, 5 the minimum.
  const shape = octahedron();
  const mesh = () => make(shape);
  const call = (options) => () => mesh().simplify(heights(shape), options);

  it('options', () => {
    for (const options of [undefined, {}, { thresholdIs: 'absolute' }, { threshold: undefined }, { threshold: null }]) {
      expectError(call(options), 'InvalidOption', { option: 'threshold' });
    }
    for (const threshold of [-0.1, NaN, Infinity, '0.1', [0.1], 1n, true]) {
      expectError(call({ threshold }), 'InvalidOption', { option: 'threshold' });
      expectError(call({ threshold, thresholdIs: 'absolute' }), 'InvalidOption', { option: 'threshold' });
    }
    for (const thresholdIs of ['percent', '', 1, true]) {
      expectError(call({ threshold: 0.1, thresholdIs }), 'InvalidOption', { option: 'thresholdIs' });
    }
    expectError(call({ treshold: 0.1 }), 'UnknownOption', { option: 'treshold' });
    expectError(call({ keep: [4, 5], persistence: 0.1 }), 'UnknownOption', { option: 'persistence' });
    expectError(call({ keep: [4, 5], threshold: 0.1 }), 'InapplicableOption', { option: 'threshold' });
    expectError(call({ keep: [4, 5], thresholdIs: 'absolute' }), 'InapplicableOption', { option: 'thresholdIs' });
    class Options {
      threshold = 0.1;
    }
    const wrong = [
      new Map([['threshold', 0.1]]),
      new Options(),
      Object.create({ threshold: 0.1 }),
      [0.1],
      0.1,
      'x',
      null,
    ];
    for (const options of wrong) expectError(call(options), 'InvalidArgument', { argument: 'options' });
    expect(call({ threshold: 0.1, keep: undefined })().values).toEqual(heights(shape));
    expect(call({ threshold: undefined, keep: [4, 5] })().values).toEqual(heights(shape));
  });

  it('vertices that cannot be kept', () => {
    for (const id of [-1, 1.5, 6, 2 ** 32 - 1, 2 ** 32, NaN, Infinity]) {
      expectError(call({ keep: [4, 5, id] }), 'IndexOutOfBounds', { index: id, vertices: 6 });
    }
    expectError(call({ keep: Uint16Array.of(4, 5, 6) }), 'IndexOutOfBounds', { index: 6, vertices: 6 });
    expectError(call({ keep: [4, 0, 5] }), 'NotAnExtremum', { vertex: 0 });
    for (const keep of [[4], [5], [], new Uint32Array(0)]) {
      expectError(call({ keep }), 'Unconstrained', { component: 0 });
    }
    for (const keep of [['4', '5'], [4, null], [4n], new BigInt64Array(2), new Float64Array(2), {}, new Set([4, 5])]) {
      expectError(call({ keep }), 'InvalidArgument', { argument: 'keep' });
    }
    for (const keep of [4, '45', true]) expectError(call({ keep }), 'InvalidArgument', { argument: 'keep' });
  });

  it('to keep nothing in one of several parts', () => {
    const parts = make(islands());
    const values = heights(islands());
    const { essentialMinima, essentialMaxima } = parts.persistence(values);
    expect(essentialMinima.length).toBe(2);
    const first = [essentialMinima[0], essentialMaxima[0]];
    expectError(() => parts.simplify(values, { keep: first }), 'Unconstrained', { component: 1, vertex: 6 });
    const { values: simple } = parts.simplify(values, { keep: [...first, essentialMinima[1], essentialMaxima[1]] });
    // Vertices of no triangle keep their values.
    expect([simple[4], simple[5]]).toEqual([values[4], values[5]]);
  });

  it('and works on after that', () => {
    const same = mesh();
    expectError(() => same.simplify(heights(shape), { keep: [0] }), 'NotAnExtremum');
    expectError(() => same.simplify(heights(shape), { threshold: -1 }), 'InvalidOption');
    expect(same.simplify(heights(shape), { keep: [4, 5] }).values).toEqual(heights(shape));
  });
});
