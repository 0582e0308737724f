// The fields of all ε at once.
import init, { Smoother, SmoothingFamily } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { apply, dense } from './meshes.js';
import { constraints, distance, f, geometric, make, n, norm, sample } from './noisy-torus.js';
import { same } from './same.js';
import { multiply, solve, transpose } from './truths.js';

beforeAll(() => init());

describe('values', () => {
  /** B, and L, as dense matrices. */
  const algebra = (mesh) => {
    const laplacian = dense(mesh.laplacian());
    return { laplacian, square: multiply(transpose(laplacian), laplacian) };
  };
  const exact = (square, b, epsilon) =>
    solve(
      square.map((row, i) => row.map((entry, j) => entry + epsilon * b[i][j])),
      apply(b, [...f]).map((entry) => epsilon * entry),
    );
  const diagonal = (entries) => entries.map((entry, i) => entries.map((_, j) => (i === j ? entry : 0)));

  it('are those of dense algebra, for every metric and for least squares', () => {
    const mesh = make();
    const { square } = algebra(mesh);
    const smoother = new Smoother(mesh);
    for (const [options, b] of [
      [{}, dense(mesh.mass())],
      [{ metric: 'mass', massScale: 'raw' }, dense(mesh.mass({ massScale: 'raw' }))],
      [{ metric: 'lumped' }, dense(mesh.mass({ kind: 'lumped' }))],
      [{ metric: 'identity' }, diagonal(new Array(n).fill(1))],
      [{ constraints }, diagonal(Array.from(f, (_, i) => (constraints.includes(i) ? 1 : 0)))],
      [
        { constraints, weights: constraints.map((_, k) => 1 + k) },
        diagonal(Array.from(f, (_, i) => (constraints.includes(i) ? 1 + i / 6 : 0))),
      ],
    ]) {
      const family = smoother.family(f, { epsilonRange: [1e-4, 1e4], ...options });
      for (const epsilon of sample.slice(1)) {
        const error = distance(family.values(epsilon), exact(square, b, epsilon));
        expect(error, JSON.stringify({ options, epsilon })).toBeLessThan(1e-6);
      }
    }
  });

  it.each([
    ['mass', {}, {}],
    ['identity', {}, { metric: 'identity' }],
    ['fem', { operator: 'fem' }, {}],
    ['single precision', { precision: 'single' }, {}],
    ['mean value weights', { weights: 'meanValue' }, {}],
    ['without factors', { solver: 'cg' }, {}],
  ])('are those of tikhonov: %s', (_, setup, options) => {
    const smoother = new Smoother(make(), setup);
    const family = smoother.family(f, options);
    expect(family.complete).toBe(true);
    for (const epsilon of sample) {
      const { values } = smoother.tikhonov(f, { epsilon, ...options });
      expect(distance(family.values(epsilon), values), `ε = ${epsilon}`).toBeLessThan(1e-6);
    }
  });

  it('are those of leastSquares, where constraints are a rule, too', () => {
    const smoother = new Smoother(make());
    for (const options of [{ constraints }, { constraints: { from: 'persistence', threshold: 0.1 } }]) {
      const family = smoother.family(f, { ...options, method: 'leastSquares' });
      expect(same(family.values(1), smoother.family(f, options).values(1))).toBe(true);
      for (const epsilon of sample.slice(1)) {
        const expected = smoother.leastSquares(f, { ...options, epsilon });
        expect(distance(family.values(epsilon), expected.values), `ε = ${epsilon}`).toBeLessThan(1e-6);
      }
      expect(family.at(1).report.method).toBe('leastSquares');
    }
  });

  it('are those of each channel alone', () => {
    const smoother = new Smoother(make());
    const channels = [f, f.map((value) => 5 - value * value)];
    const family = smoother.family(
      Float64Array.from({ length: 2 * n }, (_, k) => channels[k % 2][k >> 1]),
      {
        channels: 2,
      },
    );
    for (const epsilon of sample) {
      const values = family.values(epsilon);
      expect(values).toHaveLength(2 * n);
      channels.forEach((channel, c) => {
        const alone = smoother.tikhonov(channel, { epsilon }).values;
        const found = values.filter((_, k) => k % 2 === c);
        const size = norm(alone.map((value) => value - Math.min(...channel)));
        expect(norm(found.map((value, i) => value - alone[i])) / size).toBeLessThan(1e-6);
      });
    }
    const { reports } = family.at(0.1);
    expect(reports.map(({ before }) => before.maxima)).toEqual(
      channels.map((channel) => smoother.tikhonov(channel, { epsilon: 1 }).report.before.maxima),
    );
    const second = family.sweep({ channel: 1, epsilons: [0.1] });
    expect(second.lInfinity[0]).toBeCloseTo(reports[1].lInfinity, 12);
    expect(family.lives({ channel: 1 })).not.toEqual(family.lives());
    expectError(() => family.sweep({ channel: 2 }), 'InvalidOption', { option: 'channel' });
  });

  it('are those of the methods where some are missing', () => {
    const holes = f.slice().fill(NaN, 30, 36);
    const smoother = new Smoother(make());
    for (const missing of ['omit', 'fill']) {
      const family = smoother.family(holes, { missing });
      for (const epsilon of sample.slice(1)) {
        const expected = smoother.tikhonov(holes, { epsilon, missing }).values;
        const found = family.values(epsilon);
        expect([...found].map(Number.isNaN)).toEqual([...expected].map(Number.isNaN));
        expect(found.some(Number.isNaN)).toBe(missing === 'omit');
        const known = (x) => x.filter((_, i) => !Number.isNaN(expected[i]));
        expect(distance(known(found), known(expected)), `${missing}, ε = ${epsilon}`).toBeLessThan(1e-6);
      }
    }
    expectError(() => smoother.family(holes), 'NonFiniteValue', { vertex: 30 });
  });

  it('are the same in every call, and fresh', () => {
    const smoother = new Smoother(make());
    const family = smoother.family(f);
    for (const epsilon of sample) {
      const values = family.values(epsilon);
      const { values: again, report, reports } = family.at(epsilon);
      expect(same(values, again)).toBe(true);
      expect(report).toEqual(reports[0]);
      values.fill(7);
      expect(same(family.values(epsilon), again)).toBe(true);
      const exactly = smoother.tikhonov(f, { epsilon }).report;
      expect(Object.keys(report).sort()).toEqual(Object.keys(exactly).sort());
      expect(report).toMatchObject({ method: 'tikhonov', equation: '(5)', epsilon, choice: null });
      expect(report.solver).toMatchObject({ route: 'family', unknowns: family.dimension, iterations: 0 });
      expect(report.before).toEqual(exactly.before);
      for (const name of ['lInfinity', 'l2', 'metricNorm', 'laplacianNorm', 'sobolevBefore', 'sobolevAfter'])
        expect(Math.abs(report[name] - exactly[name]), name).toBeLessThan(1e-5 * exactly[name] + 1e-6);
    }
    expect(same(smoother.family(Array.from(f)).values(0.1), family.values(0.1))).toBe(true);
  });
});

describe('a sweep', () => {
  it('refuses what it cannot be asked for before anything is computed', () => {
    const smoother = new Smoother(make());
    let told = 0;
    const onProgress = () => void told++;
    for (const [options, option] of [
      [{ channel: 1 }, 'channel'],
      [{ channel: -1 }, 'channel'],
      [{ channel: 2 ** 32 }, 'channel'],
      [{ counts: 1 }, 'counts'],
      [{ epsilons: [1, NaN] }, 'epsilon'],
      [{ epsilons: [1e5] }, 'epsilon'],
      [{ epsilons: [1], epsilonRange: [2, 3] }, 'epsilon'],
      [{ epsilons: [1], epsilonRange: [3, 2] }, 'epsilonRange'],
    ]) {
      expectError(() => smoother.sweep(f, { ...options, onProgress }), 'InvalidOption', { option });
    }
    expect(told).toBe(0);
    expect(smoother.sweep(f, { epsilons: [], factorizations: 1 }).lInfinity).toHaveLength(0);
    expect(smoother.sweep(f, { epsilons: [1], factorizations: 1, onProgress }).lInfinity).toHaveLength(1);
    expect(told).toBeGreaterThan(0);
  });
});

describe('a family', () => {
  it('says what it is', () => {
    const smoother = new Smoother(make());
    const family = smoother.family(f, { epsilonRange: [1e-3, 100], tolerance: 1e-5, epsilon: 0.5 });
    expect(family).toBeInstanceOf(SmoothingFamily);
    expect(family.epsilonRange).toEqual([1e-3, 100]);
    expect(family.factorizations).toBe(family.shifts.length);
    expect(family.shifts[0]).toBe(0.5);
    expect(family.dimension).toBeGreaterThanOrEqual(family.factorizations);
    expect(family.complete).toBe(true);
    expect(family.errorEstimate).toBeLessThanOrEqual(1e-5);
    family.shifts.fill(0);
    family.epsilonRange.fill(0);
    expect(family.shifts[0]).toBe(0.5);
    expect(family.epsilonRange).toEqual([1e-3, 100]);
    for (const epsilon of geometric(1e-3, 100, 9)) {
      const wrong = distance(family.values(epsilon), smoother.tikhonov(f, { epsilon }).values);
      expect(wrong).toBeLessThanOrEqual(1e-5);
      expect(family.errorAt(epsilon)).toBeLessThanOrEqual(family.errorEstimate * (1 + 1e-12));
    }
    expect(smoother.family(f).epsilonRange).toEqual([1e-6, 1e4]);
  });

  it('grows one factorisation at a time to the one that is made at once', () => {
    const smoother = new Smoother(make());
    const whole = smoother.family(f);
    const family = smoother.family(f, { factorizations: 1 });
    expect([family.factorizations, family.complete]).toEqual([1, false]);
    expect(family.errorEstimate).toBeGreaterThan(1e-6);
    // It answers from the first.
    expect(distance(family.values(1), smoother.tikhonov(f, { epsilon: 1 }).values)).toBeLessThan(1e-6);
    for (let count = 2; !family.complete; count++) {
      expect(family.grow()).toBe(family.complete);
      expect(family.factorizations).toBe(count);
    }
    expect([...family.shifts]).toEqual([...whole.shifts]);
    for (const epsilon of sample) expect(same(family.values(epsilon), whole.values(epsilon))).toBe(true);
    expect(family.grow()).toBe(true);
    expect(family.factorizations).toBe(whole.factorizations);
    expectError(() => family.grow({ to: 3 }), 'UnknownOption', { option: 'to' });
  });

  it('is freed by itself: it outlives its smoother, but then grows no more', () => {
    const mesh = make();
    const smoother = new Smoother(mesh);
    const family = smoother.family(f, { factorizations: 2 });
    const expected = family.values(0.1);
    smoother.free();
    mesh.free();
    expect(same(family.values(0.1), expected)).toBe(true);
    expect(family.choose().rule).toBe('gcv');
    expect(family.sweep().epsilons).toHaveLength(41);
    expectError(() => family.grow(), 'UseAfterFree', { object: 'Smoother' });
    expect(same(family.at(0.1).values, expected)).toBe(true);
    family.free();
    family.free();
    for (const call of [
      () => family.values(1),
      () => family.at(1),
      () => family.errorAt(1),
      () => family.sweep(),
      () => family.choose(),
      () => family.lives(),
      () => family.dimension,
      () => family.factorizations,
      () => family.shifts,
      () => family.errorEstimate,
      () => family.complete,
      () => family.epsilonRange,
    ])
      expectError(call, 'UseAfterFree', { object: 'SmoothingFamily' });
    if (Symbol.dispose) expect(SmoothingFamily.prototype[Symbol.dispose]).toBe(SmoothingFamily.prototype.free);
  });

  it('is Busy for what would change it while it works', () => {
    const smoother = new Smoother(make());
    const family = smoother.family(f, { factorizations: 2 });
    const expected = family.values(0.1);
    const codes = {};
    const attempt = (name, call) => {
      codes[name] = 'done';
      try {
        call();
      } catch (error) {
        codes[name] = `${error.code} ${error.detail.object}`;
      }
    };
    const onProgress = () => {
      attempt('values', () => expect(same(family.values(0.1), expected)).toBe(true));
      attempt('dimension', () => family.dimension);
      attempt('grow', () => family.grow());
      attempt('free', () => family.free());
      attempt('tikhonov', () => smoother.tikhonov(f, { epsilon: 1 }));
      attempt('family', () => smoother.family(f).free());
    };
    const busy = { grow: 'Busy SmoothingFamily', free: 'Busy SmoothingFamily' };
    family.sweep({ counts: true, onProgress });
    expect(codes).toMatchObject({ values: 'done', dimension: 'done', ...busy, tikhonov: 'done', family: 'done' });
  });

  it('is Busy for everything while it grows', () => {
    const smoother = new Smoother(make());
    const family = smoother.family(f, { factorizations: 1 });
    const found = new Set();
    const calls = [
      () => family.values(0.1),
      () => family.at(0.1),
      () => family.sweep(),
      () => family.choose(),
      () => family.lives(),
      () => family.errorAt(1),
      () => family.dimension,
      () => family.grow(),
      () => family.free(),
      () => smoother.tikhonov(f, { epsilon: 1 }),
      () => smoother.family(f),
      () => smoother.sweep(f),
      () => smoother.free(),
    ];
    family.grow({
      onProgress: () => {
        for (const call of calls) {
          try {
            call();
            found.add('done');
          } catch (error) {
            found.add(error.code);
          }
        }
      },
    });
    expect([...found]).toEqual(['Busy']);
    expect([...family.shifts]).toEqual([...smoother.family(f, { factorizations: 2 }).shifts]);
  });
});

describe('curves', () => {
  it('are the norms and counts of the fields', () => {
    const mesh = make();
    const smoother = new Smoother(mesh);
    const family = smoother.family(f);
    const curves = family.sweep({ counts: true });
    expect(curves.epsilons).toHaveLength(41);
    geometric(1e-6, 1e4, 41).forEach((epsilon, k) =>
      expect(Math.abs(curves.epsilons[k] / epsilon - 1)).toBeLessThan(1e-12),
    );
    curves.epsilons.forEach((epsilon, k) => {
      const { report, values } = family.at(epsilon);
      for (const [name, other] of [
        ['lInfinity', report.lInfinity],
        ['metricNorm', report.metricNorm],
        ['laplacianNorm', report.laplacianNorm],
        ['sobolev', report.sobolevAfter],
      ])
        expect(Math.abs(curves[name][k] - other), `${name}, ε = ${epsilon}`).toBeLessThan(1e-6 * (1 + other));
      const { counts } = mesh.criticalPoints(values);
      expect([curves.minima[k], curves.maxima[k], curves.saddles[k]]).toEqual([
        counts.minima,
        counts.maxima,
        counts.saddles,
      ]);
      if (k === 0) return;
      expect(curves.metricNorm[k]).toBeLessThanOrEqual(curves.metricNorm[k - 1] * (1 + 1e-9));
      expect(curves.laplacianNorm[k]).toBeGreaterThanOrEqual(curves.laplacianNorm[k - 1] * (1 - 1e-9));
    });
    const corner = family.choose({ rule: 'lCurve' }).epsilon;
    const nearest = (epsilon) => Math.abs(Math.log(epsilon / corner));
    expect(nearest(curves.epsilons[curves.lCurveCorner])).toBeCloseTo(Math.min(...curves.epsilons.map(nearest)), 9);
    const plain = family.sweep();
    for (const name of ['minima', 'maxima', 'saddles']) expect(plain[name]).toEqual(new Uint32Array());
    expect(same({ ...curves, minima: 0, maxima: 0, saddles: 0 }, { ...plain, minima: 0, maxima: 0, saddles: 0 })).toBe(true); // prettier-ignore
    expect(same(smoother.sweep(f, { counts: true }), curves)).toBe(true);
    plain.metricNorm.fill(0);
    expect(same(family.sweep().metricNorm, curves.metricNorm)).toBe(true);
  });

  it('are at the ε that are asked for', () => {
    const smoother = new Smoother(make());
    const family = smoother.family(f, { epsilonRange: [0.01, 10] });
    expect(family.sweep().epsilons).toHaveLength(13);
    for (const epsilons of [[1, 0.1, 5], Float32Array.of(1, 0.5), Float64Array.of(0.3), []]) {
      expect([...family.sweep({ epsilons }).epsilons]).toEqual([...epsilons]);
      const direct = smoother.sweep(f, { epsilonRange: [0.01, 10], epsilons });
      expect(same(direct, family.sweep({ epsilons }))).toBe(true);
    }
    expect(smoother.sweep(f, { constraints }).epsilons).toHaveLength(41);
  });

  it('tell the lives of extrema, the longest first', () => {
    const mesh = make();
    const family = new Smoother(mesh).family(f);
    const lives = family.lives({ perDecade: 4 });
    const spans = [...lives.largestEpsilons].map((epsilon, k) => epsilon / lives.leastEpsilons[k]);
    expect(Math.min(...spans)).toBeGreaterThanOrEqual(1 - 1e-12);
    expect(spans.every((span, k) => k === 0 || span <= spans[k - 1] * (1 + 1e-9))).toBe(true);
    // Whoever lives at the largest ε is an extremum there.
    for (const [epsilon, vertices, bound] of [
      [1e4, lives.firstVertices, lives.largestEpsilons],
      [1e-6, lives.lastVertices, lives.leastEpsilons],
    ]) {
      const points = mesh.criticalPoints(family.values(epsilon));
      const kinds = new Map([...points.vertices].map((vertex, k) => [vertex, points.kinds[k]]));
      const there = [...bound].flatMap((value, k) => (Math.abs(value / epsilon - 1) < 1e-9 ? [k] : []));
      for (const k of there) expect(kinds.get(vertices[k])).toBe(lives.kinds[k]);
      const extrema = [...kinds.values()].filter((kind) => Math.abs(kind) === 1);
      expect(there).toHaveLength(points.counts.minima + points.counts.maxima);
      expect(extrema.length).toBeGreaterThanOrEqual(2);
    }
    expect(family.lives().kinds.length).toBeGreaterThanOrEqual(2);
  });
});
