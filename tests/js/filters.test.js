import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { takeAnyValues } from './any-values.js';
import { expectError } from './errors.js';
import { apply, component, dense, dot, islands, random, square, torus } from './meshes.js';
import { spectralNorm, transpose } from './truths.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const noise = ({ positions }, seed) => Float64Array.from({ length: positions.length / 3 }, random(seed));
const shape = torus(9, 7);
const WEIGHTS = ['cotangent', 'intrinsicDelaunay', 'uniform', 'meanValue', 'normalizedCotangent'];

/** x ← x − λD⁻¹Lx and x ← x − μD⁻¹Lx, again and again. */
function lowPassed(L, values, { iterations, lambda = 0.5, mu = 0 }) {
  let x = [...values];
  for (let time = 0; time < iterations; time++) {
    for (const scale of [lambda, mu]) {
      const image = apply(L, x);
      x = x.map((entry, i) => (L[i][i] > 0 ? entry - (scale * image[i]) / L[i][i] : entry));
    }
  }
  return x;
}

/** The mean difference to all vertices within the radius, the vertex itself included, with Gaussian weights. */
function bilateral(mesh, values, { iterations, radius, sigmaDistance, sigmaValue }) {
  const positions = mesh.positions();
  const used = [...new Set(mesh.triangles())];
  const gauss = (t, sigma) => Math.exp(-(t ** 2) / (2 * sigma ** 2));
  const distance = (i, j) => Math.hypot(...[0, 1, 2].map((axis) => positions[3 * i + axis] - positions[3 * j + axis]));
  let x = [...values];
  for (let time = 0; time < iterations; time++) {
    const next = [...x];
    for (const i of used) {
      const near = used.filter((j) => distance(i, j) <= radius);
      const weights = near.map((j) => gauss(distance(i, j), sigmaDistance) * gauss(x[j] - x[i], sigmaValue));
      const total = weights.reduce((a, b) => a + b);
      next[i] += near.reduce((sum, j, k) => sum + weights[k] * (x[j] - x[i]), 0) / total;
    }
    x = next;
  }
  return x;
}

/** What every report of a filter owes. */
function checkReport(mesh, f, { values, report, reports }, method, iterations) {
  const range = Math.max(...f) - Math.min(...f);
  const change = values.map((x, i) => (x - f[i]) / range);
  expect(reports).toEqual([report]);
  expect(report.lInfinity).toBeCloseTo(Math.max(...change.map(Math.abs)), 10);
  expect(report.l2).toBeCloseTo(Math.sqrt(dot(change, change)), 10);
  expect(report.metricNorm).toBe(report.l2);
  const energies = (field) => mesh.smoothness(field.map((x) => x / range));
  expect(report.sobolevBefore).toBeCloseTo(energies(f).sobolev, 8);
  expect(report.sobolevAfter).toBeCloseTo(energies(values).sobolev, 8);
  expect(report.laplacianNorm).toBeCloseTo(energies(values).laplacianNorm, 8);
  expect(report.before).toEqual(mesh.criticalPoints(f).counts);
  expect(report.after).toEqual(mesh.criticalPoints(values).counts);
  expect(report).toMatchObject({
    method,
    equation: method === 'lowPass' ? '[18, 24]' : '[15]',
    epsilon: null,
    constraintCount: 0,
    constrainedCriticalPoints: null,
    preserved: null,
    freeExtrema: null,
    perturbationFactor: null,
    maximumPrinciple: null,
  });
  expect(report.solver).toEqual({
    route: 'none',
    precision: 'double',
    unknowns: 0,
    factorNonzeros: 0,
    relativeResidual: 0,
    refinementSteps: 0,
    iterations,
  });
}

describe('lowPass', () => {
  it.each(WEIGHTS)('with weights %s steps by D⁻¹L', (weights) => {
    const mesh = make(shape);
    const L = dense(mesh.laplacian({ weights }));
    const f = noise(shape, 1).map((x) => 40 * x - 7);
    const smoother = new Smoother(mesh, { weights });
    for (const options of [
      { iterations: 1 },
      { iterations: 10, lambda: undefined, mu: null },
      { iterations: 7, lambda: 1 },
      { iterations: 20, lambda: 0.5, mu: -0.53 },
    ]) {
      const result = smoother.lowPass(f, options);
      const { iterations, lambda } = options;
      const truth = lowPassed(L, f, { iterations, lambda, mu: options.mu ?? 0 });
      truth.forEach((value, i) => expect(result.values[i]).toBeCloseTo(value, 9));
      if (weights === 'cotangent') checkReport(mesh, f, result, 'lowPass', options.iterations);
    }
  });

  it('shrinks less where a second step takes it back', () => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh);
    const positions = mesh.positions();
    const size = (values) => Math.sqrt(dot(values, values));
    const options = { iterations: 20, channels: 3 };
    const plain = smoother.lowPass(positions, options).values;
    const taubin = smoother.lowPass(positions, { ...options, lambda: 0.5, mu: -0.53 }).values;
    expect(size(plain)).toBeLessThan(size(taubin));
    [0, 1, 2].forEach((axis) => {
      const alone = smoother.lowPass(component(positions, axis), { iterations: 20 }).values;
      alone.forEach((value, v) => expect(plain[3 * v + axis]).toBeCloseTo(value, 12));
    });
  });

  it('is bounded, where that is asked for', () => {
    const mesh = make(shape);
    for (const weights of WEIGHTS) {
      const L = dense(mesh.laplacian({ weights }));
      for (const options of [{ iterations: 5 }, { iterations: 5, mu: -0.53 }]) {
        const columns = L.map((_, j) =>
          lowPassed(
            L,
            L.map((_, i) => (i === j ? 1 : 0)),
            options,
          ),
        );
        const { report } = new Smoother(mesh, { weights, bounds: true }).lowPass(noise(shape, 2), options);
        expect(report.perturbationFactor).toBeGreaterThanOrEqual(spectralNorm(transpose(columns)) * (1 - 1e-9));
        expect(report.perturbationFactor).toBeLessThan(1e6);
      }
    }
  });

  it('says where it diverges, and works on', () => {
    const smoother = new Smoother(make(shape));
    const f = noise(shape, 3);
    const expected = smoother.lowPass(f, { iterations: 3 });
    // A backward step that is too long makes noise grow.
    const bad = { iterations: 1000, lambda: 0.1, mu: -1 };
    expectError(() => smoother.lowPass(f, bad), 'Diverged', { iterations: expect.any(Number) });
    expect(smoother.lowPass(f, { iterations: 3 })).toEqual(expected);
  });
});

describe('bilateral', () => {
  it.each([
    { iterations: 1, radius: 1.5, sigmaDistance: 0.7, sigmaValue: 0.5 },
    { iterations: 4, radius: 1, sigmaDistance: 3, sigmaValue: 20 },
    { iterations: 2, radius: 100, sigmaDistance: 0.5, sigmaValue: 5 },
    { iterations: 2, radius: 0.01, sigmaDistance: 1, sigmaValue: 5 },
  ])('moves by mean differences: %o', (options) => {
    const mesh = make(shape);
    const f = noise(shape, 4).map((x) => 30 * x + 5);
    const result = new Smoother(mesh).bilateral(f, options);
    bilateral(mesh, f, options).forEach((value, i) => expect(result.values[i]).toBeCloseTo(value, 10));
    checkReport(mesh, f, result, 'bilateral', options.iterations);
  });

  it('takes vertices just at the radius', () => {
    const mesh = make(square(4));
    const f = noise(square(4), 5);
    for (const radius of [1, Math.nextDown?.(1) ?? 1 - 2 ** -53, 2]) {
      const options = { iterations: 1, radius, sigmaDistance: 1, sigmaValue: 1 };
      const { values } = new Smoother(mesh).bilateral(f, options);
      bilateral(mesh, f, options).forEach((value, i) => expect(values[i]).toBeCloseTo(value, 12));
    }
  });

  it('keeps steps, and smooths on either side of them', () => {
    const mesh = make(square(12));
    const next = random(6);
    const step = component(square(12).positions, 0).map((x) => (x > 5.5 ? 100 : 0));
    const f = step.map((height) => height + next());
    const options = { iterations: 10, radius: 2.5, sigmaDistance: 1, sigmaValue: 3 };
    const { values } = new Smoother(mesh).bilateral(f, options);
    const spread = (field) => Math.max(...field.map((value, v) => Math.abs(value - step[v] - 0.5)));
    expect(spread(f)).toBeGreaterThan(0.45);
    expect(spread(values)).toBeLessThan(0.3);
  });

  it('has no bound, as it is not linear', () => {
    const options = { iterations: 1, radius: 1, sigmaDistance: 1, sigmaValue: 1 };
    const { report } = new Smoother(make(shape), { bounds: true }).bilateral(noise(shape, 7), options);
    expect(report.perturbationFactor).toBeNull();
  });
});

const FILTERS = {
  lowPass: { iterations: 3 },
  bilateral: { iterations: 3, radius: 1.5, sigmaDistance: 1, sigmaValue: 1 },
};

describe.each(Object.entries(FILTERS))('%s', (method, good) => {
  const f = noise(shape, 8);

  it('leaves the field as it is in no iterations, and constants in any number', () => {
    const smoother = new Smoother(make(shape));
    expect(smoother[method](f, { ...good, iterations: 0 }).values).toEqual(f);
    const constant = new Float64Array(63).fill(-7.3);
    const { values, report } = smoother[method](constant, good);
    expect(values).toEqual(constant);
    for (const entry of Object.values(report)) expect(entry).not.toBeNaN();
  });

  it('leaves isolated vertices as they are', () => {
    const values = noise(islands(), 9);
    // Far enough to reach them through space.
    const options = method === 'bilateral' ? { ...good, radius: 40, sigmaDistance: 40 } : good;
    const filtered = new Smoother(make(islands()))[method](values, options);
    expect([filtered.values[4], filtered.values[5]]).toEqual([values[4], values[5]]);
    expect(filtered.values[0]).not.toBe(values[0]);
  });

  it('takes several channels, side by side', () => {
    const smoother = new Smoother(make(shape));
    const channels = [10, 11, 12, 13, 14].map((seed) => noise(shape, seed));
    const together = Float64Array.from({ length: 315 }, (_, k) => channels[k % 5][Math.floor(k / 5)]);
    const { values, report, reports } = smoother[method](together, { ...good, channels: 5 });
    expect([reports.length, reports[0]]).toEqual([5, report]);
    channels.forEach((channel, c) => {
      const alone = smoother[method](channel, good);
      expect(values.filter((_, k) => k % 5 === c)).toEqual(alone.values);
      expect(reports[c]).toEqual(alone.report);
    });
  });

  it('tells how far it is, and can be interrupted', () => {
    const seen = [];
    let failure = null;
    const codes = new Set();
    const onProgress = (progress) => {
      seen.push(progress);
      try {
        smoother[method](f, good);
      } catch (error) {
        codes.add(error.code);
      }
      if (failure) throw failure;
    };
    const smoother = new Smoother(make(shape), { onProgress });
    const expected = new Smoother(make(shape))[method](f, good);
    expect(smoother[method](f, good)).toEqual(expected);
    expect([...codes]).toEqual(['Busy']);
    expect(new Set(seen.map(({ phase }) => phase))).toEqual(new Set(['solve', 'report']));
    const fractions = seen.map(({ fraction }) => fraction);
    expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
    expect(fractions.at(-1)).toBe(1);
    failure = new RangeError('enough');
    expect(() => smoother[method](f, good)).toThrow(failure);
    failure = null;
    expect(smoother[method](f, good)).toEqual(expected);
  });

  it('is refused other options, after which the smoother works on', () => {
    const smoother = new Smoother(make(shape));
    const expected = smoother[method](f, good);
    const lengths = [0, -1, NaN, Infinity, '1', true, undefined, null];
    const wrong = {
      iterations: [-1, 1.5, '2', NaN, 2 ** 32, 1n, undefined, null],
      channels: [0, -1, 1.5, '2'],
      ...(method === 'lowPass'
        ? { lambda: [0, -0.5, 1.01, NaN, '0.5'], mu: [0.1, -1.01, NaN, '0'] }
        : { radius: lengths, sigmaDistance: lengths, sigmaValue: lengths }),
    };
    for (const [option, values] of Object.entries(wrong)) {
      for (const bad of values)
        expectError(() => smoother[method](f, { ...good, [option]: bad }), 'InvalidOption', { option });
    }
    for (const option of ['epsilon', 'constraints', 'unconstrained', 'metric', 'steps', 'weights']) {
      expectError(() => smoother[method](f, { ...good, [option]: 1 }), 'UnknownOption', { option });
    }
    expectError(() => smoother[method](f), 'InvalidOption', { option: 'iterations' });
    for (const bad of [5, null, [1], new Map()])
      expectError(() => smoother[method](f, bad), 'InvalidArgument', { argument: 'options' });
    const mine = new RangeError('mine');
    const throwing = {
      get iterations() {
        throw mine;
      },
    };
    expect(() => smoother[method](f, throwing)).toThrow(mine);
    expectError(() => smooth(make(shape), f, { ...good, method }), 'UnknownOption', { option: 'iterations' });
    expectError(() => smooth(make(shape), f, { method }), 'InvalidOption', { option: 'method' });
    expect(smoother[method](f, good)).toEqual(expected);
    smoother.free();
    expectError(() => smoother[method](f, good), 'UseAfterFree', { object: 'Smoother' });
  });

  takeAnyValues({ [method]: (mesh, values) => ({ values: new Smoother(mesh)[method](values, good).values }) });
});
