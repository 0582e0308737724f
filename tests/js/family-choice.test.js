// ε by rules; what families tell while they work, and what they refuse.
import init, { Smoother, SmoothingFamily, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { dense, heights, sum } from './meshes.js';
import { constraints, distance, f, make, n, norm, rules, shape } from './noisy-torus.js';
import { same } from './same.js';
import { multiply, solve, transpose } from './truths.js';

beforeAll(() => init());

describe('ε', () => {
  /** The mean of (I + B⁻¹LᵀL/ε)⁻¹'s diagonal and the residual give the criterion, by dense algebra. */
  it('by cross-validation is where the criterion is least', () => {
    const mesh = make();
    const laplacian = dense(mesh.laplacian());
    const square = multiply(transpose(laplacian), laplacian);
    const family = new Smoother(mesh).family(f, { metric: 'identity' });
    const criterion = (epsilon) => {
      const matrix = square.map((row, i) => row.map((entry, j) => entry + (i === j ? epsilon : 0)));
      let trace = 0;
      for (let i = 0; i < n; i++) {
        const unit = new Array(n).fill(0);
        unit[i] = epsilon;
        trace += solve(matrix, unit)[i];
      }
      const x = solve(
        matrix,
        Array.from(f, (value) => epsilon * value),
      );
      return sum(x.map((value, i) => (value - f[i]) ** 2)) / (n - trace) ** 2;
    };
    const { epsilon } = family.choose({ rule: 'gcv' });
    const best = criterion(epsilon);
    for (const factor of [0.05, 0.3, 3, 20]) expect(criterion(factor * epsilon)).toBeGreaterThan(0.98 * best);
  });

  it.each(rules)('by the rule %o is that of the family, in every call', (rule) => {
    const mesh = make();
    const smoother = new Smoother(mesh);
    const chosen = smoother.family(f).choose(rule);
    expect(Object.keys(chosen).sort()).toEqual(['epsilon', 'noise', 'reason', 'rule', 'runnersUp']);
    expect(chosen.rule).toBe(rule === 'auto' ? 'gcv' : rule.rule);
    expect(chosen.reason.length).toBeGreaterThan(20);
    expect(Array.isArray(chosen.runnersUp)).toBe(true);
    expect(chosen.epsilon).toBeGreaterThanOrEqual(1e-6);
    expect(chosen.epsilon).toBeLessThanOrEqual(1e4);
    if (rule.rule === 'discrepancy' && rule.noise === undefined) {
      expect(chosen.noise.standardDeviation).toBeGreaterThan(0);
      expect(chosen.noise.byDifferences).toBeGreaterThan(0);
      expect(['high', 'medium', 'low']).toContain(chosen.noise.confidence);
    } else expect(chosen.noise).toBeNull();

    const { values, report } = smoother.tikhonov(f, { epsilon: rule });
    expect(report.epsilon).toBe(report.choice.epsilon);
    expect(report.choice.rule).toBe(chosen.rule);
    // What a smoother chooses by itself may rest on a coarser family.
    expect(Math.abs(Math.log(report.epsilon / chosen.epsilon))).toBeLessThan(0.3);
    // The field is the exact one.
    const exact = smoother.tikhonov(f, { epsilon: report.epsilon });
    expect(distance(values, exact.values)).toBeLessThan(1e-12);
    expect(exact.report.choice).toBeNull();
    expect(report.solver.route).toBe(exact.report.solver.route);
    const short = smooth(mesh, f, { epsilon: rule });
    expect(short.report.choice).toEqual(report.choice);
    expect(same(short.values, values)).toBe(true);

    const fitted = smoother.leastSquares(f, { epsilon: rule, constraints });
    expect(fitted.report.choice.rule).toBe(chosen.rule);
    expect(fitted.report.epsilon).toBe(fitted.report.choice.epsilon);
    expect(smooth(mesh, f, { epsilon: rule, constraints }).report.choice).toEqual(fitted.report.choice);
  });

  it('is chosen where smooth has none', () => {
    const mesh = make();
    const expected = smooth(mesh, f, { epsilon: 'auto' });
    expect(expected.report.choice.rule).toBe('gcv');
    for (const options of [undefined, {}, { epsilon: undefined }, { method: 'tikhonov' }])
      expect(same(smooth(mesh, f, options), expected)).toBe(true);
    // It takes the noise away.
    const truth = heights(shape);
    const wrong = (x) => norm(truth.map((value, i) => value - x[i]));
    expect(wrong(expected.values)).toBeLessThan(0.7 * wrong(f));
    const fem = smooth(mesh, f, { operator: 'fem' });
    expect(fem.report.choice.epsilon).toBe(fem.report.epsilon);
    expect(smooth(mesh, f.slice().fill(NaN, 3, 6), { missing: 'omit' }).values.slice(3, 6).every(Number.isNaN)).toBe(true); // prettier-ignore
    expect(smooth(mesh, f.slice().fill(NaN, 3, 6), { missing: 'fill' }).values.some(Number.isNaN)).toBe(false);
  });

  it('leaves no more critical points than were wished', () => {
    const smoother = new Smoother(make());
    const counts = ({ minima, maxima, saddles }) => minima + maxima + saddles;
    for (const count of [4, 6, 12, 1000]) {
      const { report } = smoother.tikhonov(f, { epsilon: { rule: 'atMostCriticalPoints', count } });
      expect(counts(report.after)).toBeLessThanOrEqual(count);
    }
    const impossible = { rule: 'atMostCriticalPoints', count: 3 };
    const detail = { wanted: 3, least: 4 };
    expectError(() => smoother.tikhonov(f, { epsilon: impossible }), 'TooManyCriticalPoints', detail);
    expectError(() => smoother.family(f).choose(impossible), 'TooManyCriticalPoints', detail);
  });

  it('by discrepancy takes as much away as there is noise', () => {
    const smoother = new Smoother(make());
    for (const noise of [0.1, 0.2]) {
      const { values } = smoother.tikhonov(f, { epsilon: { rule: 'discrepancy', noise } });
      const rms = norm(values.map((value, i) => value - f[i])) / Math.sqrt(n);
      expect(rms).toBeGreaterThan(0.3 * noise);
      expect(rms).toBeLessThan(1.2 * noise);
    }
  });
});

describe('progress', () => {
  const calls = {
    family: (smoother, _, more) => smoother.family(f, more).values(0.1),
    sweep: (smoother, _, more) => smoother.sweep(f, { counts: true, ...more }),
    'tikhonov, auto': (smoother, _, more) => smoother.tikhonov(f, { epsilon: 'auto', ...more }),
    'leastSquares, auto': (smoother, _, more) => smoother.leastSquares(f, { epsilon: 'auto', constraints, ...more }),
    at: (_, family, more) => family.at(0.1, more),
    'family.sweep': (_, family, more) => family.sweep({ counts: true, ...more }),
    choose: (_, family, more) => family.choose('auto', more),
    'choose, counts': (_, family, more) => family.choose({ rule: 'atMostCriticalPoints', count: 6 }, more),
    lives: (_, family, more) => family.lives(more),
  };

  it.each(Object.keys(calls))('of %s is monotone, and it can be stopped', (name) => {
    const smoother = new Smoother(make());
    const family = smoother.family(f);
    const call = (more) => calls[name](smoother, family, more);
    const expected = call();
    const seen = [];
    call({ onProgress: ({ phase, fraction }) => void seen.push([phase, fraction]) });
    expect(seen.length).toBeGreaterThan(0);
    seen.reduce((before, [phase, fraction]) => {
      expect(['analysis', 'factorization', 'solve', 'report', 'field']).toContain(phase);
      expect(fraction).toBeGreaterThanOrEqual(before);
      expect(fraction).toBeLessThanOrEqual(1);
      return fraction;
    }, 0);
    for (const time of new Set([0, seen.length >> 1, seen.length - 1])) {
      let count = 0;
      expectError(() => call({ onProgress: () => count++ < time }), 'Cancelled');
      expect(count).toBe(time + 1);
      expect(same(call(), expected)).toBe(true);
      const mine = new RangeError('mine');
      count = 0;
      const throwing = () => {
        if (count++ >= time) throw mine;
      };
      expect(() => call({ onProgress: throwing })).toThrow(mine);
      expect(same(call(), expected)).toBe(true);
    }
    expectError(() => call({ onProgress: 'tell me' }), 'InvalidOption', { option: 'onProgress' });
  });

  it('of grow leaves the family as it was where it is stopped', () => {
    const smoother = new Smoother(make());
    const grown = smoother.family(f, { factorizations: 3 });
    const family = smoother.family(f, { factorizations: 2 });
    const before = family.values(0.1);
    const [first, second] = [1, 2].map(() => smoother.family(f, { factorizations: 2 }));
    first.grow();
    // With the factor at hand that the first one left: the fewest there can be.
    let times = 0;
    second.grow({ onProgress: () => void times++ });
    for (let time = 0; time < times; time += Math.ceil(times / 6)) {
      let count = 0;
      expectError(() => family.grow({ onProgress: () => count++ < time }), 'Cancelled');
      expect(family.factorizations).toBe(2);
      expect(same(family.values(0.1), before)).toBe(true);
    }
    family.grow();
    expect(same(family.values(0.1), grown.values(0.1))).toBe(true);
    expect([...family.shifts]).toEqual([...grown.shifts]);
  });

  it('goes to the callback of the smoother where a call has none', () => {
    let [theirs, own] = [0, 0];
    const smoother = new Smoother(make(), { onProgress: () => void theirs++ });
    const family = smoother.family(f);
    expect(theirs).toBeGreaterThan(0);
    for (const call of [
      (more) => family.sweep(more),
      (more) => family.at(1, more),
      (more) => family.choose('auto', more),
      (more) => smoother.sweep(f, more),
    ]) {
      theirs = own = 0;
      call({ onProgress: () => void own++ });
      expect(theirs).toBe(0);
      expect(own).toBeGreaterThan(0);
      call();
      expect(theirs).toBe(own);
    }
  });
});

describe('refused', () => {
  it('are options of families', () => {
    const smoother = new Smoother(make());
    const expected = smoother.family(f).values(0.1);
    for (const [options, code, option] of [
      ...[0, 1, -1, NaN, '1'].map((tolerance) => [{ tolerance }, 'InvalidOption', 'tolerance']),
      ...[[1, 0.1], [0, 1], [-1, 1], [NaN, 1], [1, Infinity], [1], [1, 2, 3], 1, '1', ['1', '2'], {}].map((range) => [{ epsilonRange: range }, 'InvalidOption', 'epsilonRange']), // prettier-ignore
      ...[0, -1, NaN, 'auto', '1', { rule: 'gcv' }].map((epsilon) => [{ epsilon }, 'InvalidOption', 'epsilon']),
      ...[0, -1, 1.5, '2'].map((factorizations) => [{ factorizations }, 'InvalidOption', 'factorizations']),
      ...['interpolate', 'lowPass', 3].map((method) => [{ method }, 'InvalidOption', 'method']),
      [{ metric: 'euclid' }, 'InvalidOption', 'metric'],
      [{ method: 'leastSquares' }, 'InvalidOption', 'constraints'],
      [{ channels: 0 }, 'InvalidOption', 'channels'],
      [{ range: [1, 2] }, 'UnknownOption', 'range'],
      [{ counts: true }, 'UnknownOption', 'counts'],
      [{ weights: [1] }, 'InapplicableOption', 'weights'],
      [{ unconstrained: 'keep' }, 'InapplicableOption', 'unconstrained'],
      [{ constraints, metric: 'mass' }, 'InapplicableOption', 'metric'],
      [{ constraints, massScale: 'raw' }, 'InapplicableOption', 'massScale'],
      [{ method: 'tikhonov', constraints }, 'InapplicableOption', 'constraints'],
      [{ metric: 'identity', massScale: 'raw' }, 'InapplicableOption', 'massScale'],
      [{ cutoffWavelength: 1 }, 'InapplicableOption', 'cutoffWavelength'],
    ]) {
      expectError(() => smoother.family(f, options), code, { option });
      if (option !== 'counts') expectError(() => smoother.sweep(f, options), code, { option });
    }
    for (const options of [null, 3, 'x', [], new Map()])
      expectError(() => smoother.family(f, options), 'InvalidArgument', { argument: 'options' });
    for (const values of [null, undefined, 'x', 3, {}])
      expectError(() => smoother.family(values), 'InvalidArgument', { argument: 'values' });
    expectError(() => smoother.family(f.slice(1)), 'LengthMismatch', { expected: n, actual: n - 1 });
    expectError(() => smoother.family(f, { channels: 2 }), 'LengthMismatch', { expected: 2 * n, actual: n });
    expectError(() => smoother.family(f.with(4, NaN)), 'NonFiniteValue', { vertex: 4 });
    expectError(() => smoother.family(f, { constraints: [n] }), 'IndexOutOfBounds', { index: n });
    expectError(() => smoother.family(f, { constraints: [1], weights: '1' }), 'InvalidArgument', { argument: 'weights' }); // prettier-ignore
    expectError(() => smoother.family(f, { constraints: [1, 2], weights: [1, 0] }), 'InvalidWeight', { index: 1, vertex: 2 }); // prettier-ignore
    expect(same(smoother.family(f).values(0.1), expected)).toBe(true);
  });

  it('are ranges whose entries run code, with what they throw', () => {
    const smoother = new Smoother(make());
    const mine = new RangeError('mine');
    const epsilonRange = [1, 2];
    Object.defineProperty(epsilonRange, 1, {
      get() {
        throw mine;
      },
    });
    expect(() => smoother.family(f, { epsilonRange })).toThrow(mine);
    const calling = [0.5, 2];
    Object.defineProperty(calling, 1, { get: () => smoother.family(f).epsilonRange[1] });
    expect(smoother.family(f, { epsilonRange: calling }).epsilonRange).toEqual([0.5, 1e4]);
  });

  it('are calls of a family', () => {
    const family = new Smoother(make()).family(f, { epsilonRange: [0.01, 10] });
    const expected = family.at(0.1);
    for (const bad of [0, -1, 0.009, 10.1, NaN, Infinity]) {
      for (const call of [
        () => family.values(bad),
        () => family.at(bad),
        () => family.errorAt(bad),
        () => family.sweep({ epsilons: [1, bad] }),
      ])
        expectError(call, 'InvalidOption', { option: 'epsilon' });
    }
    for (const bad of ['1', null, undefined, {}, [1], 1n]) {
      for (const call of [() => family.values(bad), () => family.at(bad), () => family.errorAt(bad)])
        expectError(call, 'InvalidArgument', { argument: 'epsilon' });
    }
    expectError(() => family.sweep({ epsilons: 'all' }), 'InvalidArgument', { argument: 'epsilons' });
    expectError(() => family.sweep({ epsilons: [1, '1'] }), 'InvalidArgument', { argument: 'epsilons', index: 1 });
    for (const [call, code, option] of [
      [() => family.sweep({ counts: 1 }), 'InvalidOption', 'counts'],
      [() => family.sweep({ channel: 1 }), 'InvalidOption', 'channel'],
      [() => family.sweep({ channel: -1 }), 'InvalidOption', 'channel'],
      [() => family.sweep({ count: true }), 'UnknownOption', 'count'],
      [() => family.lives({ channel: '0' }), 'InvalidOption', 'channel'],
      ...[0, 101, 1.5, '8'].map((perDecade) => [() => family.lives({ perDecade }), 'InvalidOption', 'perDecade']),
      [() => family.lives({ epsilons: [1] }), 'UnknownOption', 'epsilons'],
      [() => family.at(1, { channel: 0 }), 'UnknownOption', 'channel'],
      [() => family.grow({ factorizations: 2 }), 'UnknownOption', 'factorizations'],
      [() => family.choose('auto', { channel: 0 }), 'UnknownOption', 'channel'],
      ...['gcv', 3, [], true].map((rule) => [() => family.choose(rule), 'InvalidOption', 'rule']),
    ])
      expectError(call, code, { option });
    for (const options of [3, 'x', [], null])
      expectError(() => family.at(1, options), 'InvalidArgument', { argument: 'options' });
    expect(same(family.at(0.1), expected)).toBe(true);
  });

  it('are rules', () => {
    const smoother = new Smoother(make());
    const family = smoother.family(f);
    for (const [rule, code, option] of [
      [{}, 'InvalidOption', 'rule'],
      [{ rule: 'best' }, 'InvalidOption', 'rule'],
      [{ rule: 3 }, 'InvalidOption', 'rule'],
      [{ rule: 'gcv', noise: 1 }, 'UnknownOption', 'noise'],
      [{ rule: 'lCurve', count: 1 }, 'UnknownOption', 'count'],
      [{ rule: 'discrepancy', noise: '1' }, 'InvalidOption', 'noise'],
      [{ rule: 'atMostCriticalPoints' }, 'InvalidOption', 'count'],
      [{ rule: 'atMostCriticalPoints', count: 1.5 }, 'InvalidOption', 'count'],
      [{ rule: 'atMostCriticalPoints', count: -1 }, 'InvalidOption', 'count'],
    ]) {
      expectError(() => family.choose(rule), code, { option: `rule.${option}` });
      for (const call of [
        () => smoother.tikhonov(f, { epsilon: rule }),
        () => smoother.leastSquares(f, { epsilon: rule, constraints }),
        () => smooth(make(), f, { epsilon: rule }),
      ])
        expectError(call, code, { option: `epsilon.${option}` });
    }
    for (const noise of [0, -1, NaN, Infinity])
      expectError(() => family.choose({ rule: 'discrepancy', noise }), 'InvalidOption');
    for (const epsilon of ['gcv', 'Auto', [], true])
      expectError(() => smoother.tikhonov(f, { epsilon }), 'InvalidOption', { option: 'epsilon' });
  });

  it('are families that no smoother made', () => {
    for (const call of [
      () => new SmoothingFamily(),
      () => SmoothingFamily.prototype.values(1),
      () => SmoothingFamily.prototype.free(),
      () => Object.create(SmoothingFamily.prototype).dimension,
    ])
      expectError(call, 'InvalidArgument', { argument: 'family' });
    expect(() => SmoothingFamily()).toThrow(TypeError);
  });
});
