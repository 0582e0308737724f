import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { takeAnyValues } from './any-values.js';
import { component, dense, dot, heights, islands, random, sum, tetrahedron, torus } from './meshes.js';
import {
  criticalVertices,
  homology,
  interpolated,
  leastSingularValue,
  mergers,
  multiply,
  neighbours,
  solve,
  spectralNorm,
  transpose,
} from './truths.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const noise = ({ positions }, seed) => Float64Array.from({ length: positions.length / 3 }, random(seed));
const ascending = (ids) => [...new Set(ids)].sort((a, b) => a - b);
const withStars = (shape, vertices) => {
  const around = neighbours(shape);
  return ascending(vertices.flatMap((v) => [v, ...around[v]]));
};
const mixed = (channels) =>
  Float64Array.from(
    { length: channels.length * channels[0].length },
    (_, k) => channels[k % channels.length][Math.floor(k / channels.length)],
  );

const coarse = torus(6, 5);
const medium = torus(9, 7);
const fine = torus(40, 20);
/** Heights with noise: so many critical points that there is something to choose. */
const noisy = (() => {
  const next = random(4);
  return heights(fine).map((z) => z + 0.3 * (next() - 0.5));
})();

describe('constrainedVertices', () => {
  const all = (rule, options) => [...make(medium).constrainedVertices(noise(medium, 3), rule, options)];

  it('are those named, in order and once, whatever their array', () => {
    const named = [40, 7, 7, 0, 62];
    for (const vertices of [named, Uint32Array.from(named), Uint16Array.from(named)]) {
      expect(all(vertices)).toEqual([0, 7, 40, 62]);
      expect(all({ from: 'vertices', vertices, stars: false })).toEqual([0, 7, 40, 62]);
      expect(all({ from: 'vertices', vertices })).toEqual(withStars(medium, named));
      expect(all({ from: 'vertices', vertices, stars: undefined })).toEqual(withStars(medium, named));
    }
    expect(all([])).toEqual([]);
    expect(make(medium).constrainedVertices(noise(medium, 3), [1])).toBeInstanceOf(Uint32Array);
  });

  it('are the critical points, with their stars unless these are left out', () => {
    const critical = criticalVertices(medium, noise(medium, 3));
    expect(critical.length).toBeGreaterThan(10);
    expect(all({ from: 'criticalPoints', stars: false })).toEqual(critical);
    expect(all({ from: 'criticalPoints' })).toEqual(withStars(medium, critical));
    expect(all(Object.assign(Object.create(null), { from: 'criticalPoints', delta: null }))).toEqual(
      withStars(medium, critical),
    );
  });

  it.each([
    { delta: 0.2 },
    { delta: 0.2, link: 'skip' },
    { delta: 0.2, link: 'consecutive', deltaIs: 'relative' },
    { delta: 0.1, deltaIs: 'absolute', link: 'skip' },
    { delta: 1 },
  ])('are the critical points that are left at δ: %o', (options) => {
    const { vertices } = make(medium).criticalPoints(noise(medium, 3), options);
    expect(vertices.length).toBeLessThan(criticalVertices(medium, noise(medium, 3)).length);
    expect(all({ from: 'criticalPoints', ...options, stars: false })).toEqual([...vertices]);
    expect(all({ from: 'criticalPoints', ...options })).toEqual(withStars(medium, [...vertices]));
  });

  it('are both ends of persistent pairs, and what has no partner', () => {
    const values = noise(medium, 3);
    const pairs = [true, false].flatMap((down) => mergers(medium, values, down).pairs);
    const essential = homology(medium, values).essential.flat();
    const range = Math.max(...values) - Math.min(...values);
    const sizes = [];
    for (const threshold of [0, 0.1, 0.3, 2]) {
      const lasting = pairs.filter(([a, b]) => Math.abs(values[a] - values[b]) > threshold * range);
      const ends = ascending([...essential, ...lasting.flat()]);
      sizes.push(ends.length);
      expect(all({ from: 'persistence', threshold, stars: false })).toEqual(ends);
      expect(all({ from: 'persistence', threshold, thresholdIs: 'relative' })).toEqual(withStars(medium, ends));
      const absolute = { from: 'persistence', threshold: threshold * range, thresholdIs: 'absolute', stars: false };
      expect(all(absolute)).toEqual(ends);
    }
    expect(sizes).toEqual([...sizes].sort((a, b) => b - a));
    expect(sizes.at(-1)).toBe(4);
  });

  it('are the vertices nearest to the means of clusters', () => {
    // Three heaps, far from each other, whose means are 1, 10 and 20.
    const values = heights(medium).map((_, v) => [1, 10, 20][v % 3]);
    [values[0], values[3], values[7]] = [0.5, 1.5, 10.25];
    const means = [0, 1, 2].map((heap) => sum(values.filter((_, v) => v % 3 === heap)) / 21);
    const nearest = means.map((mean) =>
      values.reduce((best, value, v) => (Math.abs(value - mean) < Math.abs(values[best] - mean) ? v : best), 0),
    );
    const call = (rule) => [...make(medium).constrainedVertices(values, { from: 'kMeans', stars: false, ...rule })];
    for (const seed of [undefined, 0, 1, 4294967295]) expect(call({ clusters: 3, seed })).toEqual(ascending(nearest));
    // More clusters than values: the first vertex of each of them.
    expect(call({ clusters: 100 })).toEqual([0, 1, 2, 3, 6, 7]);
    expect(call({ clusters: 3, stars: true })).toEqual(withStars(medium, nearest));
    const many = all({ from: 'kMeans', clusters: 9, seed: 5 });
    expect(all({ from: 'kMeans', clusters: 9, seed: 5 })).toEqual(many);
    expect(all({ from: 'kMeans', clusters: 9, stars: false })).toHaveLength(9);
  });

  it('are those of all channels together', () => {
    const mesh = make(medium);
    const channels = [11, 12, 13].map((seed) => noise(medium, seed));
    const rule = { from: 'persistence', threshold: 0.5 };
    const together = mesh.constrainedVertices(mixed(channels), rule, { channels: 3 });
    expect([...together]).toEqual(ascending(channels.flatMap((f) => [...mesh.constrainedVertices(f, rule)])));
    expect([...mesh.constrainedVertices(mixed(channels), [5, 2], { channels: 3 })]).toEqual([2, 5]);
  });

  it('are never isolated ones, unless by name', () => {
    const mesh = make(islands());
    const values = noise(islands(), 2);
    for (const rule of [
      { from: 'criticalPoints' },
      { from: 'persistence', threshold: 0 },
      { from: 'kMeans', clusters: 12 },
    ])
      expect([...mesh.constrainedVertices(values, rule)].filter((v) => v === 4 || v === 5)).toEqual([]);
    expect([...mesh.constrainedVertices(values, { from: 'vertices', vertices: [4] })]).toEqual([4]);
  });

  takeAnyValues({
    constrainedVertices: (mesh, values) => ({
      vertices: mesh.constrainedVertices(values, { from: 'kMeans', clusters: 3 }),
    }),
    interpolate: (mesh, values) => ({
      values: smooth(mesh, values, { method: 'interpolate', constraints: [0, 2, 3] }).values,
    }),
    leastSquares: (mesh, values) => ({ values: smooth(mesh, values, { epsilon: 1, constraints: [0, 2, 3] }).values }),
  });
});

/** L, and LᵀL or L M⁻¹ L: what the smoothness is the square of. */
function operators(mesh, { weights, operator }) {
  const L = dense(mesh.laplacian({ weights }));
  if (operator !== 'fem') return { L, square: multiply(transpose(L), L) };
  const areas = dense(mesh.mass({ kind: 'lumped', massScale: 'raw' })).map((row, i) => row[i]);
  const divided = L.map((row, i) => row.map((entry) => entry / areas[i]));
  return { L, square: multiply(transpose(L), divided) };
}

const WEIGHTS = ['cotangent', 'intrinsicDelaunay', 'uniform', 'meanValue', 'normalizedCotangent'];
const SYSTEMS = WEIGHTS.map((weights) => ({ weights })).concat([
  { operator: 'fem' },
  { solver: 'cg' },
  { solver: 'cg', weights: 'meanValue' },
  { precision: 'single' },
]);
const FIXED = [3, 11, 20, 28];

describe('interpolate', () => {
  it.each(SYSTEMS)('%o solves what a dense system does', (options) => {
    const mesh = make(coarse);
    const f = noise(coarse, 1).map((x) => 50 * x - 20);
    const { L, square } = operators(mesh, options);
    const smoother = new Smoother(mesh, options);
    for (const [energy, matrix] of [
      [undefined, L],
      ['harmonic', L],
      ['biharmonic', square],
    ]) {
      const { values, report } = smoother.interpolate(f, { constraints: FIXED, energy });
      interpolated(matrix, f, FIXED).forEach((value, i) => expect(values[i]).toBeCloseTo(value, 6));
      for (const v of FIXED) expect(values[v]).toBe(f[v]);
      expect(report).toMatchObject({ method: 'interpolate', equation: '(6)', epsilon: null, constraintCount: 4 });
      expect(report.solver.unknowns).toBe(26);
    }
  });

  it('keeps critical points with their types, and says so', () => {
    const mesh = make(fine);
    for (const energy of ['harmonic', 'biharmonic']) {
      for (const stars of [true, false]) {
        const constraints = { from: 'persistence', threshold: 0.05, stars };
        const { values, report } = smooth(mesh, noisy, { method: 'interpolate', energy, constraints });
        const features = mesh.constrainedVertices(noisy, { ...constraints, stars: false });
        const fixed = mesh.constrainedVertices(noisy, constraints);
        for (const v of fixed) expect(values[v]).toBe(noisy[v]);
        const [before, after] = [noisy, values].map((field) => mesh.criticalPoints(field));
        const described = ({ vertices, kinds, multiplicities }) =>
          new Map([...vertices].map((v, k) => [v, `${kinds[k]} ${multiplicities[k]}`]));
        const [were, are] = [before, after].map(described);
        const critical = [...features].filter((v) => were.has(v));
        const kept = critical.filter((v) => were.get(v) === are.get(v));
        const free = [...after.vertices].filter((v, k) => after.kinds[k] !== 0 && !fixed.includes(v));
        expect(report).toMatchObject({
          constraintCount: fixed.length,
          constrainedCriticalPoints: critical.length,
          preserved: kept.length,
          freeExtrema: free.length,
          before: before.counts,
          after: after.counts,
        });
        expect(critical.length).toBe(features.length);
        if (stars) expect(kept).toEqual(critical);
        else expect(kept.length).toBeLessThan(critical.length);
      }
    }
  });

  it('certifies what the maximum principle promises', () => {
    const mesh = make(coarse);
    const around = neighbours(coarse);
    for (const weights of WEIGHTS) {
      const L = dense(mesh.laplacian({ weights }));
      const interpolate = (energy) => {
        return new Smoother(mesh, { weights }).interpolate(noise(coarse, 7), { constraints: FIXED, energy });
      };
      const { values, report } = interpolate('harmonic');
      const range = Math.max(...noise(coarse, 7)) - Math.min(...noise(coarse, 7));
      const free = L.map((_, i) => i).filter((i) => !FIXED.includes(i));
      const coupled = (i) => L.map((_, j) => j).filter((j) => j !== i && L[i][j] !== 0);
      const extrema = (others) =>
        free.filter((i) => {
          const differences = others(i).map((j) => (values[j] - values[i]) / range);
          return differences.every((d) => d > 1e-12) || differences.every((d) => d < -1e-12);
        }).length;
      const least = Math.min(...free.flatMap((i) => coupled(i).map((j) => -L[i][j])));
      // Right angles have a cotangent of zero but for rounding.
      const largest = Math.max(...L.flatMap((row, i) => row.map((entry, j) => (i === j ? 0 : Math.abs(entry)))));
      const smallest = Math.abs(least) <= Number.EPSILON * largest ? 0 : least;
      expect(report.maximumPrinciple).toEqual({
        smallestWeight: smallest,
        extrema: extrema(coupled),
        meshExtrema: extrema((i) => around[i]),
      });
      if (smallest >= 0) expect(report.maximumPrinciple.extrema).toBe(0);
      expect(interpolate('biharmonic').report.maximumPrinciple).toBeNull();
    }
  });

  it('smooths positions with some vertices fixed, as three channels', () => {
    const mesh = make(fine);
    const next = random(9);
    const positions = mesh.positions().map((x) => x + 0.05 * (next() - 0.5));
    const smoother = new Smoother(mesh);
    const constraints = Uint16Array.from({ length: 80 }, (_, k) => 10 * k);
    for (const energy of ['harmonic', 'biharmonic']) {
      const { values, reports, report } = smoother.interpolate(positions, { constraints, energy, channels: 3 });
      for (const v of constraints) expect(values.slice(3 * v, 3 * v + 3)).toEqual(positions.slice(3 * v, 3 * v + 3));
      expect([reports.length, reports[0]]).toEqual([3, report]);
      [0, 1, 2].forEach((axis) => {
        const alone = smoother.interpolate(component(positions, axis), { constraints, energy });
        alone.values.forEach((value, v) => expect(values[3 * v + axis]).toBeCloseTo(value, 10));
        expect(reports[axis].after).toEqual(alone.report.after);
      });
    }
  });

  it('leaves all as it is where nothing is free', () => {
    const { values, report } = smooth(make(tetrahedron()), [1, 2, 4, 8], {
      method: 'interpolate',
      constraints: { from: 'criticalPoints' },
      bounds: true,
    });
    expect([...values]).toEqual([1, 2, 4, 8]);
    expect(report).toMatchObject({ lInfinity: 0, freeExtrema: 0, perturbationFactor: 1 });
    expect(report.solver).toMatchObject({ route: 'none', unknowns: 0 });
  });
});

describe('leastSquares', () => {
  /** (LᵀL + εΔ) x = εΔf */
  function truth(square, f, epsilon, weights) {
    const matrix = square.map((row, i) => row.map((entry, j) => entry + (i === j ? epsilon * weights[i] : 0)));
    return solve(
      matrix,
      weights.map((weight, i) => epsilon * weight * f[i]),
    );
  }

  it.each(SYSTEMS)('%o solves what a dense system does', (options) => {
    const mesh = make(coarse);
    const f = noise(coarse, 2).map((x) => 8 * x + 3);
    const { square } = operators(mesh, options);
    const smoother = new Smoother(mesh, options);
    const given = [1, 0.5, 2, 3];
    for (const epsilon of [0.02, 5]) {
      for (const weights of [undefined, given, Float32Array.from(given)]) {
        const delta = new Array(30).fill(0);
        FIXED.forEach((v, k) => (delta[v] = weights?.[k] ?? 1));
        const { values, report } = smoother.leastSquares(f, { constraints: FIXED, epsilon, weights });
        truth(square, f, epsilon, delta).forEach((value, i) => expect(values[i]).toBeCloseTo(value, 6));
        const pull = (field) => sum(FIXED.map((v) => delta[v] * field[v]));
        expect(pull(values) / pull(f)).toBeCloseTo(1, 8);
        expect(report).toMatchObject({ method: 'leastSquares', equation: '(7)', epsilon, constraintCount: 4 });
        expect(report.maximumPrinciple).toBeNull();
        const range = Math.max(...f) - Math.min(...f);
        const norm = Math.sqrt(sum(FIXED.map((v) => delta[v] * ((values[v] - f[v]) / range) ** 2)));
        expect(report.metricNorm).toBeCloseTo(norm, 9);
      }
    }
  });

  it('weighs vertices as they are listed, or found', () => {
    const mesh = make(coarse);
    const f = noise(coarse, 5);
    const smoother = new Smoother(mesh);
    const run = (constraints, weights) => smoother.leastSquares(f, { constraints, epsilon: 0.1, weights }).values;
    const expected = run([3, 11, 20], [1, 2, 3]);
    expect(run([20, 3, 11], [3, 1, 2])).toEqual(expected);
    // Of a vertex that is listed twice the larger weight counts.
    expect(run(Uint32Array.of(20, 3, 11, 20), [3, 1, 2, 0.5])).toEqual(expected);
    expect(run({ from: 'vertices', vertices: [20, 3, 11], stars: false }, [3, 1, 2])).toEqual(expected);
    const rule = { from: 'vertices', vertices: [20] };
    const found = [...mesh.constrainedVertices(f, rule)];
    const weights = found.map((v) => 1 + v);
    expect(found.length).toBeGreaterThan(4);
    expect(run(rule, weights)).toEqual(run(found, weights));
  });

  it('reports energies and changes, for the field scaled to [0, 1]', () => {
    const mesh = make(medium);
    const f = noise(medium, 6).map((x) => 100 * x - 30);
    const range = Math.max(...f) - Math.min(...f);
    const { values, report } = smooth(mesh, f, { epsilon: 0.1, constraints: { from: 'kMeans', clusters: 8 } });
    const change = values.map((x, i) => (x - f[i]) / range);
    expect(report.lInfinity).toBeCloseTo(Math.max(...change.map(Math.abs)), 9);
    expect(report.l2).toBeCloseTo(Math.sqrt(dot(change, change)), 9);
    const energies = (field) => mesh.smoothness(field.map((x) => x / range));
    expect(report.sobolevBefore).toBeCloseTo(energies(f).sobolev, 8);
    expect(report.sobolevAfter).toBeCloseTo(energies(values).sobolev, 8);
    expect(report.laplacianNorm).toBeCloseTo(energies(values).laplacianNorm, 8);
    expect(report.perturbationFactor).toBeNull();
  });
});

describe('a component without constraints', () => {
  const shape = islands();
  const f = noise(shape, 8);

  it.each(['interpolate', 'leastSquares'])('is an error, or keeps its values, or gets their mean: %s', (method) => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh);
    const epsilon = method === 'leastSquares' ? 1 : undefined;
    const run = (constraints, unconstrained, more) =>
      smoother[method](f, {
        constraints,
        ...(unconstrained && { unconstrained }),
        ...(epsilon && { epsilon }),
        ...more,
      });
    for (const unconstrained of [undefined, 'error']) {
      expect(() => run([7], unconstrained)).toThrow(expect.objectContaining({ code: 'Unconstrained' }));
      expect(() => run([7], unconstrained)).toThrow(expect.objectContaining({ detail: { component: 0, vertex: 0 } }));
      expect(() => run([0, 4], unconstrained)).toThrow(
        expect.objectContaining({ detail: { component: 1, vertex: 6 } }),
      );
    }
    const whole = run([1, 7, 8]);
    for (const unconstrained of ['keep', 'mean']) {
      const { values, report } = run([7, 8], unconstrained);
      const mean = sum(f.slice(0, 4)) / 4;
      for (const v of [0, 1, 2, 3]) {
        if (unconstrained === 'keep') expect(values[v]).toBe(f[v]);
        else expect(values[v]).toBeCloseTo(mean, 12);
      }
      // Isolated vertices keep theirs in any case.
      expect([values[4], values[5]]).toEqual([f[4], f[5]]);
      for (const v of [6, 7, 8, 9, 10, 11]) expect(values[v]).toBeCloseTo(whole.values[v], 8);
      expect(report.constraintCount).toBe(2);
    }
    const { values } = run([], 'keep');
    expect(values).toEqual(f);
    expect(run([7, 8, 1]).values).toEqual(whole.values);
  });
});

describe('bounds', () => {
  /** At least so much of the least eigenvalue is taken. */
  const SHARE = 0.7 * 0.98;
  const f = noise(coarse, 3);
  const factorOf = (mesh, method, options, smoother) =>
    new Smoother(mesh, { ...smoother, bounds: true })[method](f, options).report.perturbationFactor;

  it.each([{}, { weights: 'intrinsicDelaunay' }, { weights: 'meanValue' }, { operator: 'fem' }])(
    'hold, and are near that of the paper: interpolate, %o',
    (options) => {
      const mesh = make(coarse);
      const { L, square } = operators(mesh, options);
      const fixed = [...FIXED, 0, 6, 15];
      const free = L.map((_, i) => i).filter((i) => !fixed.includes(i));
      for (const [energy, matrix] of [
        ['harmonic', L],
        ['biharmonic', square],
      ]) {
        const columns = fixed.map((v) =>
          interpolated(
            matrix,
            L.map((_, i) => (i === v ? 1 : 0)),
            fixed,
          ),
        );
        const factor = factorOf(mesh, 'interpolate', { constraints: fixed, energy }, options);
        expect(factor).toBeGreaterThanOrEqual(spectralNorm(transpose(columns)) * (1 - 1e-9));
        if (energy === 'biharmonic' || options.operator) continue;
        // √(1 + (‖L_FI‖/σ)²), the norm from above by the sums of rows and columns.
        const part = free.map((i) => fixed.map((j) => L[i][j]));
        const largest = (matrix) => Math.max(...matrix.map((row) => sum(row.map(Math.abs))));
        const sigma = leastSingularValue(free.map((i) => free.map((j) => L[i][j])));
        const bound = Math.sqrt(1 + (largest(part) * largest(transpose(part))) / sigma ** 2);
        expect(factor / bound).toBeGreaterThan(0.99);
        if (options.weights !== 'meanValue') expect(factor / bound).toBeLessThan(1 / SHARE);
      }
    },
  );

  it.each([{}, { weights: 'meanValue' }, { operator: 'fem' }, { solver: 'cg' }])(
    'hold, and are near the root of that of the paper: leastSquares, %o',
    (options) => {
      const mesh = make(coarse);
      const { square } = operators(mesh, options);
      const weights = [1, 2, 0.5, 3];
      const delta = square.map((_, i) => weights[FIXED.indexOf(i)] ?? 0);
      const epsilon = 0.3;
      const matrix = square.map((row, i) => row.map((entry, j) => entry + (i === j ? epsilon * delta[i] : 0)));
      const columns = FIXED.map((v) =>
        solve(
          matrix,
          delta.map((w, i) => (i === v ? epsilon * w : 0)),
        ),
      );
      const factor = factorOf(mesh, 'leastSquares', { constraints: FIXED, epsilon, weights }, options);
      expect(factor).toBeGreaterThanOrEqual(spectralNorm(transpose(columns)) * (1 - 1e-9));
      const bound = Math.sqrt((epsilon * 3) / leastSingularValue(matrix));
      expect(factor / bound).toBeGreaterThan(1 - 1e-9);
      expect(factor / bound).toBeLessThan(1 / Math.sqrt(SHARE));
    },
  );

  it('hold for tikhonov, and change no values', () => {
    const mesh = make(coarse);
    const { square } = operators(mesh, {});
    const B = dense(mesh.mass());
    for (const epsilon of [0.01, 1]) {
      const matrix = square.map((row, i) => row.map((entry, j) => entry + epsilon * B[i][j]));
      const columns = transpose(B).map((column) =>
        solve(
          matrix,
          column.map((entry) => epsilon * entry),
        ),
      );
      const factor = factorOf(mesh, 'tikhonov', { epsilon });
      expect(factor).toBeGreaterThanOrEqual(spectralNorm(transpose(columns)) * (1 - 1e-9));
      expect(factor).toBeLessThan(10);
      expect(factorOf(mesh, 'tikhonov', { epsilon, metric: 'identity' })).toBe(1);
      const { values, report } = smooth(mesh, f, { epsilon, bounds: true });
      expect(values).toEqual(smooth(mesh, f, { epsilon }).values);
      expect(report.perturbationFactor).toBe(factor);
    }
  });
});

describe('smooth', () => {
  it('takes the method that constraints ask for, or the one named', () => {
    const mesh = make(medium);
    const f = noise(medium, 10);
    const constraints = { from: 'persistence', threshold: 0.2 };
    const smoother = new Smoother(mesh, { weights: 'uniform' });
    const weights = 'uniform';
    const least = smoother.leastSquares(f, { constraints, epsilon: 0.5 });
    expect(smooth(mesh, f, { constraints, epsilon: 0.5, weights })).toEqual(least);
    expect(smooth(mesh, f, { constraints, epsilon: 0.5, weights, method: 'leastSquares' })).toEqual(least);
    const energy = 'biharmonic';
    const whole = smoother.interpolate(f, { constraints, energy });
    expect(smooth(mesh, f, { constraints, energy, weights, method: 'interpolate' })).toEqual(whole);
    const tikhonov = smoother.tikhonov(f, { epsilon: 0.5 });
    expect(smooth(mesh, f, { constraints: undefined, epsilon: 0.5, weights })).toEqual(tikhonov);
    const several = smooth(mesh, mixed([f, noise(medium, 11)]), { constraints: [1, 2], epsilon: 1, channels: 2 });
    expect(several.reports).toHaveLength(2);
    expect(several.values).toHaveLength(126);
  });
});
