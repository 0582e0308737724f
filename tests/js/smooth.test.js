import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { apply, dense, dot, heights, octahedron, random, sum, tetrahedron, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const small = () => make(torus(9, 7));
const noise = (length, seed) => Float64Array.from({ length }, random(seed));

describe('tikhonov', () => {
  it.each([
    ['identity', undefined],
    ['mass', 'meanOne'],
    ['mass', 'raw'],
    ['lumped', 'meanOne'],
    ['lumped', 'raw'],
  ])('with metric %s, scale %s solves (LᵀL + εB) x = εBf', (metric, massScale) => {
    const mesh = small();
    const f = noise(63, 1);
    const L = dense(mesh.laplacian());
    const kind = metric === 'mass' ? 'galerkin' : 'lumped';
    const B = (x) => (metric === 'identity' ? [...x] : apply(dense(mesh.mass({ kind, massScale })), x));
    for (const epsilon of [1e-3, 0.05, 10]) {
      const { values: x, report } = new Smoother(mesh).tikhonov(f, { epsilon, metric, massScale });
      // L is symmetric, so LᵀLx = L(Lx).
      const left = apply(L, apply(L, x)).map((entry, i) => entry + epsilon * B(x)[i]);
      const right = B(f).map((entry) => epsilon * entry);
      const scale = Math.sqrt(dot(right, right));
      const residual = Math.sqrt(sum(left.map((entry, i) => (entry - right[i]) ** 2))) / scale;
      expect(residual).toBeLessThan(1e-10);
      // The means agree: of x and f for the identity, weighted by B otherwise.
      expect(sum(B(x)) / sum(B(f))).toBeCloseTo(1, 9);
      expect(report.epsilon).toBe(epsilon);
      expect(report.equation).toContain(metric === 'identity' ? '3' : '5');
    }
  });

  it('reports what it did, for the field scaled to [0, 1]', () => {
    const mesh = small();
    const f = noise(63, 2).map((x) => 100 * x - 30);
    const { values: x, report, reports } = new Smoother(mesh).tikhonov(f, { epsilon: 0.05, metric: 'identity' });
    const range = Math.max(...f) - Math.min(...f);
    const change = x.map((entry, i) => (entry - f[i]) / range);
    const scaled = (values) => mesh.smoothness(values.map((entry) => entry / range));
    expect(reports).toEqual([report]);
    expect(report.lInfinity).toBeCloseTo(Math.max(...change.map(Math.abs)), 10);
    expect(report.l2).toBeCloseTo(Math.sqrt(dot(change, change)), 10);
    expect(report.metricNorm).toBeCloseTo(report.l2, 10);
    expect(report.sobolevBefore).toBeCloseTo(scaled(f).sobolev, 8);
    expect(report.sobolevAfter).toBeCloseTo(scaled(x).sobolev, 8);
    expect(report.laplacianNorm).toBeCloseTo(scaled(x).laplacianNorm, 8);
    expect(report.before).toEqual(mesh.criticalPoints(f).counts);
    expect(report.after).toEqual(mesh.criticalPoints(x).counts);
    expect(report).toMatchObject({
      method: 'tikhonov',
      constraintCount: 0,
      preserved: null,
      freeExtrema: null,
      perturbationFactor: null,
      solver: { route: 'complexCholesky', precision: 'double', unknowns: 63, iterations: 0 },
    });
    expect(report.solver.relativeResidual).toBeLessThan(1e-10);
    expect(report.solver.factorNonzeros).toBeGreaterThan(63);
  });

  it('removes the noise of a field and keeps what is large', () => {
    const shape = torus(60, 30);
    const mesh = make(shape);
    const random1 = random(4);
    const noisy = heights(shape).map((z) => z + 0.2 * (random1() - 0.5));
    const { report } = smooth(mesh, noisy, { epsilon: 0.002 });
    expect(report.before.minima).toBeGreaterThan(20);
    expect(report.after).toEqual({ minima: 1, maxima: 1, saddles: 2, indexSum: 0 });
    expect(report.lInfinity).toBeLessThan(0.1);
  });

  it('keeps constants, and goes along with a·f + b', () => {
    const mesh = small();
    const f = noise(63, 3);
    for (const metric of ['identity', 'mass', 'lumped']) {
      const smoother = new Smoother(mesh);
      const constant = smoother.tikhonov(new Float64Array(63).fill(-7.5), { epsilon: 0.1, metric });
      for (const value of constant.values) expect(value).toBeCloseTo(-7.5, 10);
      for (const norm of Object.values(constant.report)) expect(norm).not.toBeNaN();
      const { values } = smoother.tikhonov(f, { epsilon: 0.1, metric });
      const moved = smoother.tikhonov(
        f.map((x) => 1000 * x - 20),
        { epsilon: 0.1, metric },
      );
      for (let i = 0; i < 63; i++) expect(moved.values[i]).toBeCloseTo(1000 * values[i] - 20, 8);
    }
  });

  it('comes to the same with every solver, and with every weight it works', () => {
    const mesh = small();
    const f = noise(63, 5);
    const run = (options) => new Smoother(mesh, options).tikhonov(f, { epsilon: 0.05 });
    const expected = run({ solver: 'cholesky' }).values;
    expect(run({ solver: 'auto' }).values).toEqual(expected);
    const iterated = run({ solver: 'cg' });
    expect(iterated.report.solver).toMatchObject({ route: 'cgMultigrid', factorNonzeros: 0 });
    expect(iterated.report.solver.iterations).toBeGreaterThan(0);
    iterated.values.forEach((value, i) => expect(value).toBeCloseTo(expected[i], 7));
    for (const weights of ['uniform', 'meanValue', 'normalizedCotangent']) {
      expect(run({ weights }).report.laplacianNorm).toBeLessThan(mesh.smoothness(f, { weights }).laplacianNorm * 2);
    }
  });

  it('takes several numbers for each vertex, side by side', () => {
    const mesh = small();
    const channels = [6, 7, 8].map((seed) => noise(63, seed));
    const mixed = Float64Array.from({ length: 189 }, (_, k) => channels[k % 3][Math.floor(k / 3)]);
    const smoother = new Smoother(mesh);
    const { values, reports, report } = smoother.tikhonov(mixed, { epsilon: 0.05, channels: 3 });
    expect(reports.length).toBe(3);
    expect(report).toEqual(reports[0]);
    channels.forEach((channel, c) => {
      const alone = smoother.tikhonov(channel, { epsilon: 0.05 });
      alone.values.forEach((value, i) => expect(values[3 * i + c]).toBeCloseTo(value, 12));
      expect(reports[c].lInfinity).toBeCloseTo(alone.report.lInfinity, 12);
    });
  });

  it('smooth is the short way to the same', () => {
    const mesh = small();
    const f = noise(63, 9);
    const options = { epsilon: 0.3, metric: 'lumped', massScale: 'raw' };
    const { values } = new Smoother(mesh, { weights: 'uniform' }).tikhonov(f, options);
    expect(smooth(mesh, f, { ...options, weights: 'uniform', method: 'tikhonov' }).values).toEqual(values);
    expect(smooth(mesh, Array.from(f), { epsilon: 1 }).values).toEqual(
      new Smoother(mesh).tikhonov(f, { epsilon: 1 }).values,
    );
  });

  it('leaves the input alone and returns what is new each time', () => {
    const mesh = small();
    const f = noise(63, 10);
    const before = f.slice();
    const smoother = new Smoother(mesh);
    const first = smoother.tikhonov(f, { epsilon: 0.1 });
    const copy = first.values.slice();
    smoother.tikhonov(f, { epsilon: 5 });
    first.report.before.minima = -1;
    expect(f).toEqual(before);
    expect(first.values).toEqual(copy);
    const again = smoother.tikhonov(f, { epsilon: 0.1 });
    expect(again.values).toEqual(copy);
    expect(again.report.before.minima).toBeGreaterThan(0);
  });

  it('reports the route that it took', () => {
    const mesh = small();
    const f = noise(63, 12);
    const route = (smoother, options) =>
      new Smoother(mesh, smoother).tikhonov(f, { epsilon: 0.05, ...options }).report.solver.route;
    for (const solver of ['auto', 'cholesky']) {
      expect(route({ solver }, { metric: 'identity' })).toBe('complexCholesky');
      expect(route({ solver, operator: 'fem' })).toBe('complexCholesky');
      expect(route({ solver })).toBe('cholesky');
      expect(route({ solver }, { metric: 'lumped' })).toBe('cholesky');
      expect(route({ solver, weights: 'meanValue' }, { metric: 'identity' })).toBe('cholesky');
    }
    for (const [smoother, expected] of [
      [{}, 'cgMultigrid'],
      [{ operator: 'fem' }, 'cgMultigrid'],
      [{ weights: 'uniform' }, 'cgMultigrid'],
      [{ weights: 'normalizedCotangent' }, 'cgJacobi'],
    ]) {
      expect(route({ ...smoother, solver: 'cg' })).toBe(expected);
      expect(route({ ...smoother, solver: 'cg', precision: 'single' })).toBe(expected);
    }
    const flat = new TriMesh([0, 0, 0, 1, 0, 0, 2, 0, 0], [0, 1, 2]);
    const { values, report } = smooth(flat, [1, 2, 3], { epsilon: 1, metric: 'identity' });
    expect([...values]).toEqual([1, 2, 3]);
    expect(report.solver).toEqual({
      route: 'none',
      precision: 'double',
      unknowns: 0,
      factorNonzeros: 0,
      relativeResidual: 0,
      refinementSteps: 0,
      iterations: 0,
    });
  });

  it('copes with several components and isolated vertices', () => {
    const { positions, triangles } = octahedron();
    const mesh = new TriMesh(
      [...positions, ...positions.map((x) => x + 9), 4, 4, 4],
      [...triangles, ...triangles.map((i) => i + 6)],
    );
    const f = noise(13, 11);
    const { values } = smooth(mesh, f, { epsilon: 0.2 });
    expect(values[12]).toBe(f[12]);
    expect([...values].every(Number.isFinite)).toBe(true);
    const alone = smooth(make(octahedron()), f.slice(0, 6), { epsilon: 0.2, massScale: 'raw' }).values;
    const together = smooth(mesh, f, { epsilon: 0.2, massScale: 'raw' }).values;
    alone.forEach((value, i) => expect(together[i]).toBeCloseTo(value, 12));
  });
});

describe('survives', () => {
  it('options that throw or call back', () => {
    const f = noise(63, 1);
    const smoother = new Smoother(small());
    const mine = new RangeError('mine');
    const throwing = {
      get epsilon() {
        throw mine;
      },
    };
    expect(() => smoother.tikhonov(f, throwing)).toThrow(mine);
    const expected = smoother.tikhonov(f, { epsilon: 1 });
    const calling = {
      get epsilon() {
        return smoother.tikhonov(f, { epsilon: 2 }).report.epsilon - 1;
      },
    };
    expect(smoother.tikhonov(f, calling)).toEqual(expected);
  });

  it('a vertex with so many neighbours that LᵀL does not fit into memory', () => {
    const n = 20000;
    const angle = (i) => (2 * Math.PI * i) / n;
    const rim = Array.from({ length: n }, (_, i) => [Math.cos(angle(i)), Math.sin(angle(i)), 0]);
    const fan = Array.from({ length: n }, (_, i) => [0, i + 1, ((i + 1) % n) + 1]);
    const mesh = new TriMesh([0, 0, 1, ...rim.flat()], fan.flat());
    const f = noise(n + 1, 1);
    for (const precision of ['double', 'single']) {
      const smoother = new Smoother(mesh, { solver: 'cholesky', precision });
      expectError(() => smoother.tikhonov(f, { epsilon: 1 }), 'OutOfMemory', { bytes: expect.any(Number) });
      expectError(() => smoother.tikhonov(f, { epsilon: 1 }), 'OutOfMemory');
      expect(smoother.tikhonov(f, { epsilon: 1, metric: 'identity' }).report.solver.route).toBe('complexCholesky');
    }
    const fractions = [];
    const { report } = smooth(mesh, f, { epsilon: 1, onProgress: ({ fraction }) => fractions.push(fraction) });
    expect(report.solver.route).toBe('cgComplexCholesky');
    expect(report.solver.relativeResidual).toBeLessThan(1e-9);
    expect(fractions.at(-1)).toBe(1);
    expect(mesh.criticalPoints(f).counts.indexSum).toBe(1);
    expect(smooth(small(), noise(63, 1), { epsilon: 1 }).report.after.indexSum).toBe(0);
  });
});

describe('after a system that is too badly conditioned', () => {
  it('a smoother goes on working', () => {
    const mesh = make(torus(60, 30));
    const f = noise(1800, 1);
    const smoothers = [{}, { operator: 'fem' }, { solver: 'cg' }, { precision: 'single' }, { weights: 'meanValue' }];
    for (const options of smoothers) {
      const smoother = new Smoother(mesh, options);
      const before = smoother.tikhonov(f, { epsilon: 0.1 });
      expectError(() => smoother.tikhonov(f, { epsilon: 1e-300 }), 'NotPositiveDefinite', { column: 0 });
      expect(smoother.tikhonov(f, { epsilon: 0.1 })).toEqual(before);
    }
  });

  it('the vertex is named, not the unknown', () => {
    const { positions, triangles } = octahedron();
    // The first three vertices are isolated, and no unknowns.
    const mesh = new TriMesh(
      [...new Array(9).fill(5), ...positions],
      triangles.map((i) => i + 3),
    );
    const call = () => smooth(mesh, noise(9, 1), { epsilon: 1e-300 });
    expectError(call, 'NotPositiveDefinite', { column: 3 });
  });
});

/** Each phase once: it is told again and again while it lasts. */
const steps = (phases) => phases.filter((phase, k) => phase !== phases[k - 1]);

describe('progress', () => {
  it.each([
    [{}, {}],
    [{}, { metric: 'identity' }],
    [{ operator: 'fem', precision: 'single' }, {}],
  ])('is told phase by phase: %o, %o', (options, more) => {
    const phases = [];
    const smoother = new Smoother(small(), { ...options, onProgress: ({ phase }) => phases.push(phase) });
    const call = (epsilon) => {
      phases.length = 0;
      smoother.tikhonov(noise(63, 1), { epsilon, ...more });
      return steps(phases);
    };
    expect(call(1)).toEqual(['analysis', 'factorization', 'solve', 'report']);
    expect(call(2)).toEqual(['factorization', 'solve', 'report']);
    expect(call(2)).toEqual(['solve', 'report']);
  });

  it('never goes back, whether there is a factor or not', () => {
    const seen = [];
    const onProgress = (progress) => seen.push(progress);
    const smoother = new Smoother(small(), { onProgress });
    smoother.tikhonov(noise(63, 1), { epsilon: 0.1 });
    expect(seen.length).toBeGreaterThan(2);
    for (const { phase, fraction } of seen) {
      expect(['analysis', 'factorization', 'solve', 'report']).toContain(phase);
      expect(fraction).toBeGreaterThanOrEqual(0);
      expect(fraction).toBeLessThanOrEqual(1);
    }
    const fractions = seen.map(({ fraction }) => fraction);
    expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
    seen.length = 0;
    smooth(small(), noise(63, 1), { epsilon: 0.1, solver: 'cg', onProgress });
    expect(steps(seen.map(({ phase }) => phase))).toEqual(['solve', 'report']);
  });

  it('carries what the callback throws, and the smoother stays usable', () => {
    const mesh = small();
    const f = noise(63, 1);
    let stop = new RangeError('enough');
    const onProgress = () => {
      if (stop) throw stop;
    };
    const smoother = new Smoother(mesh, { onProgress });
    const call = () => smoother.tikhonov(f, { epsilon: 0.1 });
    expect(call).toThrow(stop);
    expect(call).toThrow(stop);
    expect(() => smooth(mesh, f, { epsilon: 0.1, onProgress })).toThrow(stop);
    stop = null;
    expect(call().values).toEqual(smooth(mesh, f, { epsilon: 0.1 }).values);
  });

  it('may look at the mesh, but not use or free the smoother at work', () => {
    const mesh = small();
    const f = noise(63, 1);
    const errors = [];
    const attempt = (call) => {
      try {
        call();
      } catch (error) {
        errors.push(error.code);
      }
    };
    const smoother = new Smoother(mesh, {
      onProgress() {
        expect(mesh.criticalPoints(f).counts.indexSum).toBe(0);
        attempt(() => smoother.tikhonov(f, { epsilon: 1 }));
        attempt(() => smoother.free());
      },
    });
    const { values } = smoother.tikhonov(f, { epsilon: 0.1 });
    expect(new Set(errors)).toEqual(new Set(['Busy']));
    expect(values).toEqual(smooth(mesh, f, { epsilon: 0.1 }).values);
    smoother.free();
  });
});

describe('refused', () => {
  const f = [1, 2, 3, 4];

  it('options of tikhonov, after which the same smoother goes on working', () => {
    const smoother = new Smoother(make(tetrahedron()));
    const call = (options) => () => smoother.tikhonov(f, options);
    const epsilon = 0.1;
    expectError(call(), 'InvalidOption', { option: 'epsilon' });
    expectError(call({}), 'InvalidOption', { option: 'epsilon' });
    for (const bad of [0, -1, NaN, Infinity, '1'])
      expectError(call({ epsilon: bad }), 'InvalidOption', { option: 'epsilon' });
    expectError(call({ epsilon, metric: 'euclid' }), 'InvalidOption', { option: 'metric' });
    expectError(call({ epsilon, massScale: 'area' }), 'InvalidOption', { option: 'massScale' });
    for (const channels of [0, -1, 1.5, '2'])
      expectError(call({ epsilon, channels }), 'InvalidOption', { option: 'channels' });
    expectError(call({ epsilon, metric: 'identity', massScale: 'raw' }), 'InapplicableOption', { option: 'massScale' });
    expectError(call({ epsilon, weights: 'uniform' }), 'UnknownOption', { option: 'weights' });
    expectError(call({ epsilom: 1 }), 'UnknownOption', { option: 'epsilom' });
    expectError(call(0.1), 'InvalidArgument', { argument: 'options' });
    expect(call({ epsilon, metric: undefined })().values.length).toBe(4);
  });

  it('options of a smoother and of smooth', () => {
    const mesh = make(tetrahedron());
    expectError(() => new Smoother(mesh, { weights: 'cotan' }), 'InvalidOption', { option: 'weights' });
    expectError(() => new Smoother(mesh, { solver: 'lu' }), 'InvalidOption', { option: 'solver' });
    expectError(() => new Smoother(mesh, { operator: 'fe' }), 'InvalidOption', { option: 'operator' });
    expectError(() => new Smoother(mesh, { operator: true }), 'InvalidOption', { option: 'operator' });
    expectError(() => new Smoother(mesh, { precision: 'half' }), 'InvalidOption', { option: 'precision' });
    expectError(() => new Smoother(mesh, { precision: 32 }), 'InvalidOption', { option: 'precision' });
    expectError(() => new Smoother(mesh, { cutoffWavelength: 1 }), 'UnknownOption', { option: 'cutoffWavelength' });
    expectError(() => new Smoother(mesh, { onProgress: 'tell me' }), 'InvalidOption', { option: 'onProgress' });
    expectError(() => new Smoother(mesh, { epsilon: 1 }), 'UnknownOption', { option: 'epsilon' });
    expectError(() => new Smoother(mesh, { bounds: 'yes' }), 'InvalidOption', { option: 'bounds' });
    expectError(() => new Smoother(mesh, null), 'InvalidArgument', { argument: 'options' });
    expectError(() => smooth(mesh, f, { epsilon: -1 }), 'InvalidOption', { option: 'epsilon' });
    expectError(() => smooth(mesh, f, { epsilon: 1, delta: 1 }), 'UnknownOption', { option: 'delta' });
    expectError(() => smooth(mesh, f, { epsilon: 1, method: 'blur' }), 'InvalidOption', { option: 'method' });
    expect(smooth(mesh, f, { epsilon: 1 }).values.length).toBe(4);
  });

  it('values', () => {
    const smoother = new Smoother(make(tetrahedron()));
    const call = (values, options) => () => smoother.tikhonov(values, { epsilon: 1, ...options });
    expectError(call([1, 2, 3]), 'LengthMismatch', { expected: 4, actual: 3 });
    expectError(call(f, { channels: 2 }), 'LengthMismatch', { expected: 8, actual: 4 });
    expectError(call([1, 2, NaN, 4]), 'NonFiniteValue', { vertex: 2 });
    expectError(call([1, 2, 3, 4, 5, NaN, 7, 8], { channels: 2 }), 'NonFiniteValue', { vertex: 2 });
    expectError(call([1, 2, undefined, 4]), 'InvalidArgument', { argument: 'values', index: 2 });
    expectError(call(null), 'InvalidArgument', { argument: 'values' });
    expect(call(f)().values.length).toBe(4);
  });

  it('what is no mesh', () => {
    for (const mesh of [undefined, null, {}, 'mesh', tetrahedron(), Object.create(TriMesh.prototype)]) {
      expectError(() => new Smoother(mesh), 'InvalidArgument', { argument: 'mesh' });
      expectError(() => smooth(mesh, f, { epsilon: 1 }), 'InvalidArgument', { argument: 'mesh' });
    }
  });
});

describe('life', () => {
  it('a smoother outlives its mesh, and ends with free, once or twice', () => {
    const mesh = make(tetrahedron());
    const smoother = new Smoother(mesh);
    mesh.free();
    expectError(() => new Smoother(mesh), 'UseAfterFree', { object: 'TriMesh' });
    expectError(() => smooth(mesh, [1, 2, 3, 4], { epsilon: 1 }), 'UseAfterFree', { object: 'TriMesh' });
    expect(smoother.tikhonov([1, 2, 3, 4], { epsilon: 1 }).values.length).toBe(4);
    smoother.free();
    smoother.free();
    smoother[Symbol.dispose]();
    expectError(() => smoother.tikhonov([1, 2, 3, 4], { epsilon: 1 }), 'UseAfterFree', { object: 'Smoother' });
  });
});
