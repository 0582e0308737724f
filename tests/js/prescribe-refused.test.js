// What fields with prescribed extrema refuse, how they are stopped, and what is left after it.
import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { kindsOf, noise } from './exact.js';
import { heights, islands, sphere, torus } from './meshes.js';
import { same } from './same.js';
import { neighbours } from './truths.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const shape = torus(16, 9);
const n = 16 * 9;
const f = noise(shape, heights(shape), 0.6);
const { minima, maxima } = kindsOf(shape, f);
const epsilon = 0.05;
const persistence = { from: 'persistence', threshold: 0.1 };

/** Expects that both ways refuse the same. */
function expectRefused(options, code, detail) {
  const mesh = make(shape);
  const smoother = new Smoother(mesh);
  expectError(() => smoother.prescribe(f, options), code, detail);
  expectError(() => smooth(mesh, f, { ...options, method: 'prescribe' }), code, detail);
}

describe('extrema that cannot be', () => {
  it('are told with their vertices', () => {
    const [low] = minima;
    const [high] = maxima;
    const next = neighbours(shape)[low][0];
    const regular = [...Array(n).keys()].find((v) => !minima.includes(v) && !maxima.includes(v));
    const both = { minima: [low, high], maxima: [high] };
    expectRefused({ epsilon, extrema: both }, 'ConflictingExtremum', { vertex: high });
    const [first, second] = [low, next].sort((a, b) => a - b);
    const adjacent = { minima: [low, next], maxima: [high] };
    expectRefused({ epsilon, extrema: adjacent }, 'AdjacentExtrema', { first, second, kind: 'minima' });
    const above = { minima: [high], maxima: [low, next] };
    expectRefused({ epsilon, extrema: above }, 'AdjacentExtrema', { first, second, kind: 'maxima' });
    expectRefused({ epsilon, extrema: [low, regular] }, 'NotAnExtremum', { vertex: regular });
    for (const extrema of [[low, n], { minima: [low, n], maxima: [high] }, { minima: [low], maxima: [n] }])
      expectRefused({ epsilon, extrema }, 'IndexOutOfBounds', { index: n, vertices: n });
    for (const extrema of [[-1], [0.5], { minima: [2 ** 32], maxima: [1] }])
      expectRefused({ epsilon, extrema }, 'IndexOutOfBounds', { vertices: n });
    // A neighbour of the other kind is no contradiction.
    const { values } = new Smoother(make(shape)).prescribe(f, { epsilon, extrema: { minima: [low], maxima: [next] } });
    expect(kindsOf(shape, values)).toEqual({ minima: [low], maxima: [next] });
  });

  it('are those that a component is without', () => {
    for (const extrema of [
      [],
      [minima[0]],
      { minima: [], maxima: [maxima[0]] },
      { from: 'persistence', minima: 1, maxima: 0 },
    ])
      // prettier-ignore
      expectRefused({ epsilon, extrema }, 'Unconstrained', { component: 0, vertex: 0 });
    const two = make(islands());
    const values = [3, 1, 4, 2, 7, 7, 5, 9, 2, 6, 8, 1];
    const call = (extrema) => new Smoother(two).prescribe(values, { epsilon: 1, extrema });
    expectError(() => call([1, 2]), 'Unconstrained', { component: 1, vertex: 6 });
    expectError(() => call([7, 11]), 'Unconstrained', { component: 0, vertex: 0 });
    expectError(() => call({ minima: [4], maxima: [2] }), 'NotAnExtremum', { vertex: 4 });
    expectError(() => call({ from: 'persistence', minima: 1, maxima: 2 }), 'Unconstrained');
  });

  it('are more than there are', () => {
    const count = (kind, wanted) => ({ kind, wanted, found: { minima, maxima }[kind].length });
    const more = (minima, maxima) => ({ from: 'persistence', of: 'input', minima, maxima });
    expectRefused({ epsilon, extrema: more(1000, 1) }, 'TooFewExtrema', count('minima', 1000));
    expectRefused(
      { epsilon, extrema: more(1, maxima.length + 1) },
      'TooFewExtrema',
      count('maxima', maxima.length + 1),
    );
    const all = new Smoother(make(shape)).prescribe(f, { epsilon, extrema: more(minima.length, maxima.length) });
    expect([...all.minima]).toEqual(minima);
  });

  it('are those of values that contradict them', () => {
    const smoother = new Smoother(make(shape));
    // The highest vertex cannot be the only minimum beside a lower maximum, with the values they have.
    const [low, high] = [f.indexOf(Math.min(...f)), f.indexOf(Math.max(...f))];
    const turned = { minima: [high], maxima: [low] };
    let error;
    try {
      smoother.prescribe(f, { epsilon, extrema: turned, values: 'keep' });
    } catch (thrown) {
      error = thrown;
    }
    expect(error).toMatchObject({ code: 'Infeasible', detail: { from: high, to: low } });
    expect(smoother.prescribe(f, { epsilon, extrema: turned }).minima).toEqual(Uint32Array.of(high));
  });

  it('are those of a constant field', () => {
    const mesh = make(sphere(1));
    const flat = new Float64Array(mesh.vertexCount).fill(3);
    for (const extrema of [undefined, { minima: [0], maxima: [9] }])
      expectError(() => new Smoother(mesh).prescribe(flat, { epsilon, extrema }), 'ConstantField');
  });
});

describe('options', () => {
  const invalid = (options, option) => expectRefused({ epsilon, ...options }, 'InvalidOption', { option });
  const inapplicable = (options, option) => expectRefused({ epsilon, ...options }, 'InapplicableOption', { option });
  const unknown = (options, option) => expectRefused({ epsilon, ...options }, 'UnknownOption', { option });

  it('out of their range are told by name', () => {
    for (const margin of [0, -1, 0.01, 2, NaN]) invalid({ margin }, 'margin');
    for (const prominence of [0, -0.1, Infinity, NaN]) invalid({ prominence }, 'prominence');
    for (const representatives of [0, 2, 4, 1.5]) invalid({ representatives }, 'representatives');
    for (const name of ['complete', 'again', 'preview']) invalid({ [name]: 'yes' }, name);
    invalid({ values: 'kept' }, 'values');
    invalid({ range: [0, 1] }, 'range');
    invalid({ extrema: { ...persistence, of: 'output' } }, 'extrema.of');
    invalid({ extrema: { ...persistence, thresholdIs: 'range' } }, 'extrema.thresholdIs');
    for (const threshold of [-1, NaN, Infinity])
      invalid({ extrema: { ...persistence, threshold } }, 'extrema.threshold');
    invalid({ extrema: { from: 'persistence' } }, 'extrema.threshold');
    invalid({ extrema: { from: 'persistence', minima: 1 } }, 'extrema.maxima');
    invalid({ extrema: { from: 'persistence', minima: -1, maxima: 1 } }, 'extrema.minima');
    invalid({ extrema: { from: 'persistence', minima: [1], maxima: 1 } }, 'extrema.minima');
    invalid({ extrema: { from: 'kMeans', clusters: 3 } }, 'extrema.from');
    invalid({ extrema: { minima: [1] } }, 'extrema.maxima');
    invalid({ extrema: {} }, 'extrema.minima');
    for (const epsilon of [0, -1, NaN, 'best', [1]]) invalid({ epsilon }, 'epsilon');
    invalid({ missing: 'drop' }, 'missing');
  });

  it('that nothing has are told, and so is what is no array', () => {
    unknown({ extremes: [1] }, 'extremes');
    unknown({ threshold: 0.1 }, 'threshold');
    const smoother = new Smoother(make(shape));
    expectError(() => smoother.prescribe(f, { epsilon, energy: 'harmonic' }), 'UnknownOption', { option: 'energy' });
    unknown({ extrema: { ...persistence, stars: true } }, 'extrema.stars');
    unknown({ extrema: { minima: [1], maxima: [2], of: 'input' } }, 'extrema.of');
    for (const extrema of ['all', 3, true, new Map()])
      expectRefused({ epsilon, extrema }, 'InvalidArgument', { argument: 'extrema' });
    expectRefused({ epsilon, extrema: { minima: 1, maxima: 1 } }, 'InvalidArgument', { argument: 'extrema.minima' });
    expectRefused({ epsilon, extrema: ['1'] }, 'InvalidArgument', { argument: 'extrema', index: 0 });
  });

  it('that mean nothing here are told', () => {
    inapplicable({ channels: 3 }, 'channels');
    inapplicable({ missing: 'fill' }, 'missing');
    inapplicable({ extrema: { ...persistence, minima: 1, maxima: 1 } }, 'extrema.threshold');
    inapplicable({ unconstrained: 'mean' }, 'unconstrained');
    inapplicable({ constraints: [1, 2], metric: 'mass' }, 'metric');
    inapplicable({ metric: 'identity', massScale: 'raw' }, 'massScale');
    for (const [name, value] of Object.entries({
      margin: 1e-5,
      prominence: 0.1,
      range: 'input',
      values: 'keep',
      representatives: 3,
      again: true,
    }))
      inapplicable({ preview: true, [name]: value }, name);
    const smoother = new Smoother(make(shape));
    expectError(() => smoother.prescribe(f, { epsilon, weights: [1] }), 'InapplicableOption', { option: 'weights' });
    const fem = new Smoother(make(shape), { operator: 'fem' });
    expectError(() => fem.prescribe(f, { epsilon, metric: 'mass' }), 'InapplicableOption', { option: 'metric' });
    const length = { cutoffWavelength: 3 };
    expectError(() => smoother.prescribe(f, length), 'InapplicableOption', { option: 'cutoffWavelength' });
    // Nor do they belong to other methods.
    for (const [name, value] of [
      ['extrema', persistence],
      ['preview', true],
      ['margin', 1e-5],
    ]) {
      expectError(() => smoother.tikhonov(f, { epsilon, [name]: value }), 'UnknownOption', { option: name });
      const call = () => smooth(make(shape), f, { epsilon, [name]: value });
      expectError(call, 'InapplicableOption', { option: name });
    }
    expectError(() => smooth(make(shape), f, { epsilon, method: 'prescribed' }), 'InvalidOption', { option: 'method' });
  });

  it('that are wrong are told before ε is chosen', () => {
    for (const [more, code, option] of [
      [{ margin: 1 }, 'InvalidOption', 'margin'],
      [{ channels: 2 }, 'InapplicableOption', 'channels'],
    ]) {
      let told = 0;
      const onProgress = () => void told++;
      expectRefused({ epsilon: 'auto', onProgress, ...more }, code, { option });
      expect(told).toBe(0);
    }
  });

  it('without ε there is none', () => {
    const smoother = new Smoother(make(shape));
    for (const options of [undefined, {}, { extrema: persistence }])
      expectError(() => smoother.prescribe(f, options), 'InvalidOption', { option: 'epsilon' });
  });

  it('of the caller stay as they are', () => {
    const extrema = Object.freeze({ minima: Object.freeze([minima[0]]), maxima: Object.freeze([maxima[0]]) });
    const options = Object.freeze({ epsilon, extrema });
    new Smoother(make(shape)).prescribe(f, options);
    smooth(make(shape), f, Object.freeze({ ...options, method: 'prescribe' }));
    expect(options.extrema.minima).toEqual([minima[0]]);
  });
});

it('values are checked as everywhere', () => {
  const smoother = new Smoother(make(shape));
  const call = (values, more) => smoother.prescribe(values, { epsilon, ...more });
  expectError(() => call(f.slice(1)), 'LengthMismatch', { expected: n, actual: n - 1 });
  expectError(() => call(f.with(5, NaN)), 'NonFiniteValue', { vertex: 5 });
  expectError(() => call(f.with(5, Infinity), { missing: 'omit' }), 'NonFiniteValue', { vertex: 5 });
  const missing = f.with(minima[0], NaN);
  const extrema = { minima, maxima };
  expectError(() => call(missing, { missing: 'omit', extrema }), 'MissingValue', { vertex: minima[0] });
  // Numbers of any kind.
  const single = Float32Array.from(f);
  const expected = call(Float64Array.from(single));
  for (const values of [single, [...single]]) expect(same(call(values), expected)).toBe(true);
});

describe('progress', () => {
  const calls = {
    whole: (smoother, more) => smoother.prescribe(f, { epsilon, extrema: persistence, ...more }),
    preview: (smoother, more) => smoother.prescribe(f, { epsilon, preview: true, ...more }),
    keep: (smoother, more) =>
      smoother.prescribe(f, { epsilon, values: 'keep', extrema: { ...persistence, of: 'input' }, ...more }),
    'of three, again': (smoother, more) => smoother.prescribe(f, { epsilon, representatives: 3, again: true, ...more }),
    auto: (smoother, more) => smoother.prescribe(f, { epsilon: 'auto', ...more }),
  };

  it.each(Object.keys(calls))('of the call "%s" is monotone, and it can be stopped', (name) => {
    const smoother = new Smoother(make(shape));
    const call = (more) => calls[name](smoother, more);
    const expected = call();
    const fractions = [];
    call({ onProgress: ({ fraction }) => void fractions.push(fraction) });
    expect(fractions.length).toBeGreaterThan(0);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    expect(fractions.at(-1)).toBeLessThanOrEqual(1);
    for (const time of new Set([0, 1, fractions.length >> 1, fractions.length - 1])) {
      if (time >= fractions.length) continue;
      let count = 0;
      expectError(() => call({ onProgress: () => count++ < time }), 'Cancelled');
      expect(count).toBe(time + 1);
      expect(same(call(), expected)).toBe(true);
    }
    const mine = new RangeError('mine');
    const throwing = () => {
      throw mine;
    };
    expect(() => call({ onProgress: throwing })).toThrow(mine);
    // Other calls of the smoother are not disturbed by what was stopped.
    const smoothed = new Smoother(make(shape)).tikhonov(f, { epsilon });
    expect(same(smoother.tikhonov(f, { epsilon }).values, smoothed.values)).toBe(true);
  });

  it.each(Object.keys(calls))('the first call "%s", stopped, leaves the next one right', (name) => {
    const mesh = make(shape);
    const expected = calls[name](new Smoother(mesh));
    let times = 0;
    calls[name](new Smoother(mesh), { onProgress: () => void times++ });
    for (let time = 0; time < times; time += Math.ceil(times / 8)) {
      const smoother = new Smoother(mesh);
      let count = 0;
      expectError(() => calls[name](smoother, { onProgress: () => count++ < time }), 'Cancelled');
      expect(same(calls[name](smoother), expected)).toBe(true);
    }
  });

  it('is that of the smoother where the call names none', () => {
    let told = 0;
    const smoother = new Smoother(make(shape), { onProgress: () => void told++ });
    smoother.prescribe(f, { epsilon });
    expect(told).toBeGreaterThan(0);
  });
});

it('works after the mesh is freed, and fails after the smoother is', () => {
  const mesh = make(shape);
  const smoother = new Smoother(mesh);
  const expected = smoother.prescribe(f, { epsilon });
  mesh.free();
  expect(same(smoother.prescribe(f, { epsilon }), expected)).toBe(true);
  expectError(() => smooth(mesh, f, { method: 'prescribe', epsilon }), 'UseAfterFree', { object: 'TriMesh' });
  smoother.free();
  expectError(() => smoother.prescribe(f, { epsilon }), 'UseAfterFree', { object: 'Smoother' });
});
