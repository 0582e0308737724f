// What the methods with constraints do not take, and that they lose nothing by it.
import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { random, tetrahedron, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const f = Float64Array.from({ length: 63 }, random(3));
const rule = { from: 'criticalPoints', stars: false };

/** Every call that takes constraints, with good options for the rest. */
const callers = {
  constrainedVertices: () => {
    const mesh = make(torus(9, 7));
    return (constraints) => mesh.constrainedVertices(f, constraints);
  },
  interpolate: () => {
    const smoother = new Smoother(make(torus(9, 7)));
    return (constraints) => smoother.interpolate(f, { constraints });
  },
  leastSquares: () => {
    const smoother = new Smoother(make(torus(9, 7)));
    return (constraints) => smoother.leastSquares(f, { constraints, epsilon: 0.1 });
  },
  smooth: () => {
    const mesh = make(torus(9, 7));
    return (constraints) => smooth(mesh, f, { constraints, epsilon: 0.1, method: 'leastSquares' });
  },
};

/** Calls them all with something bad; each works on as before. */
function refused(bad, code, detail, called = Object.keys(callers)) {
  for (const name of called) {
    const call = callers[name]();
    const expected = call(rule);
    expectError(() => call(bad), code, detail);
    expect(call(rule), name).toEqual(expected);
  }
}

describe('constraints that are refused', () => {
  it('are what is neither vertices nor a rule', () => {
    class Rule {
      from = 'criticalPoints';
    }
    for (const bad of [
      ...[5, 'criticalPoints', true, Symbol('all'), 7n, () => [1], new Map([['from', 'criticalPoints']]), new Set([1])],
      ...[new Rule(), new BigInt64Array(2), new Float64Array(2), new ArrayBuffer(8), new DataView(new ArrayBuffer(8))],
    ])
      refused(bad, 'InvalidArgument', { argument: 'constraints' });
    refused([1, '2'], 'InvalidArgument', { argument: 'constraints', index: 1 });
    refused([1, 2, 3n], 'InvalidArgument', { argument: 'constraints', index: 2 });
    refused([undefined], 'InvalidArgument', { argument: 'constraints', index: 0 });
  });

  it('are missing ones', () => {
    for (const bad of [undefined, null]) {
      refused(bad, 'InvalidOption', { option: 'constraints' }, ['interpolate', 'leastSquares', 'smooth']);
      refused(bad, 'InvalidArgument', { argument: 'constraints' }, ['constrainedVertices']);
    }
    const smoother = new Smoother(make(torus(9, 7)));
    for (const options of [undefined, {}]) {
      expectError(() => smoother.interpolate(f, options), 'InvalidOption', { option: 'constraints' });
      expectError(() => smoother.leastSquares(f, options), 'InvalidOption', { option: 'constraints' });
    }
    expectError(() => smooth(make(torus(9, 7)), f, { method: 'interpolate' }), 'InvalidOption', {
      option: 'constraints',
    });
  });

  it.each([-1, 63, 1.5, NaN, Infinity, 2 ** 32, -0.5])('are vertices that do not exist: %d', (index) => {
    for (const bad of [[0, index], { from: 'vertices', vertices: [index, 1] }])
      refused(bad, 'IndexOutOfBounds', { index, vertices: 63 });
  });

  it('are vertices that do not exist in typed arrays', () => {
    for (const ids of [Uint32Array.of(1, 63), Uint16Array.of(63)]) {
      refused(ids, 'IndexOutOfBounds', { index: 63, vertices: 63 });
      refused({ from: 'vertices', vertices: ids }, 'IndexOutOfBounds', { index: 63 });
    }
  });

  it.each([
    [{}, 'from'],
    [{ from: undefined, vertices: [1] }, 'from'],
    [{ from: 'everywhere' }, 'from'],
    [{ from: 'CriticalPoints' }, 'from'],
    [{ from: 3 }, 'from'],
    [{ from: ['criticalPoints'] }, 'from'],
    [{ ...rule, stars: 'yes' }, 'stars'],
    [{ ...rule, stars: 1 }, 'stars'],
    [{ ...rule, delta: '0.1' }, 'delta'],
    [{ ...rule, delta: 1n }, 'delta'],
    [{ ...rule, delta: -0.1 }, 'delta'],
    [{ ...rule, delta: NaN }, 'delta'],
    [{ ...rule, delta: Infinity }, 'delta'],
    [{ ...rule, deltaIs: 'percent' }, 'deltaIs'],
    [{ ...rule, deltaIs: true }, 'deltaIs'],
    [{ ...rule, link: 'closed' }, 'link'],
    [{ ...rule, link: 0 }, 'link'],
    [{ from: 'vertices' }, 'vertices'],
    [{ from: 'vertices', vertices: null }, 'vertices'],
    [{ from: 'persistence' }, 'threshold'],
    [{ from: 'persistence', threshold: undefined }, 'threshold'],
    [{ from: 'persistence', threshold: '1' }, 'threshold'],
    [{ from: 'persistence', threshold: -1 }, 'threshold'],
    [{ from: 'persistence', threshold: NaN }, 'threshold'],
    [{ from: 'persistence', threshold: 1, thresholdIs: 'percent' }, 'thresholdIs'],
    [{ from: 'persistence', threshold: 1, thresholdIs: 0 }, 'thresholdIs'],
    [{ from: 'kMeans' }, 'clusters'],
    [{ from: 'kMeans', clusters: 0 }, 'clusters'],
    [{ from: 'kMeans', clusters: -1 }, 'clusters'],
    [{ from: 'kMeans', clusters: 1.5 }, 'clusters'],
    [{ from: 'kMeans', clusters: '3' }, 'clusters'],
    [{ from: 'kMeans', clusters: NaN }, 'clusters'],
    [{ from: 'kMeans', clusters: 2 ** 32 }, 'clusters'],
    [{ from: 'kMeans', clusters: 3, seed: -1 }, 'seed'],
    [{ from: 'kMeans', clusters: 3, seed: 0.5 }, 'seed'],
    [{ from: 'kMeans', clusters: 3, seed: 'x' }, 'seed'],
  ])('are rules with a wrong value: %o', (bad, option) => {
    refused(bad, 'InvalidOption', { option: `constraints.${option}`, expected: expect.any(String) });
  });

  it.each([
    [{ ...rule, rule: 'strict' }, 'rule'],
    [{ ...rule, Delta: 1 }, 'Delta'],
    [{ ...rule, threshold: 1 }, 'threshold'],
    [{ ...rule, vertices: [1] }, 'vertices'],
    [{ from: 'vertices', vertices: [1], delta: 0.1 }, 'delta'],
    [{ from: 'persistence', threshold: 1, delta: 1 }, 'delta'],
    [{ from: 'kMeans', clusters: 2, threshold: 1 }, 'threshold'],
    [{ from: 'kMeans', clusters: 2, epsilon: 1 }, 'epsilon'],
    [{ from: 'kMeans', clusters: 2, unconstrained: 'keep' }, 'unconstrained'],
  ])('are rules with an option that is not theirs: %o', (bad, option) => {
    refused(bad, 'UnknownOption', { option: `constraints.${option}` });
    expect(() => callers.smooth()(bad)).toThrow(`\`constraints.${option}\``);
  });

  it('are vertices of a rule that are none', () => {
    for (const vertices of [5, 'all', {}, new BigInt64Array(1), true])
      refused({ from: 'vertices', vertices }, 'InvalidArgument', { argument: 'constraints.vertices' });
    refused({ from: 'vertices', vertices: [0, '1'] }, 'InvalidArgument', {
      argument: 'constraints.vertices',
      index: 1,
    });
  });

  it('are those whose getters throw, or call back', () => {
    const mine = new RangeError('mine');
    const throwing = (name, others) =>
      Object.defineProperty({ ...others }, name, {
        enumerable: true,
        get() {
          throw mine;
        },
      });
    for (const name of Object.keys(callers)) {
      const call = callers[name]();
      const expected = call(rule);
      expect(() => call(throwing('from', {}))).toThrow(mine);
      expect(() => call(throwing('delta', rule))).toThrow(mine);
      expect(() => call(throwing('vertices', { from: 'vertices' }))).toThrow(mine);
      const calling = { ...rule };
      Object.defineProperty(calling, 'delta', { enumerable: true, get: () => call([1, 5]) && 0 });
      expect(call(calling)).toEqual(expected);
    }
  });
});

describe('other options that are refused', () => {
  const good = { interpolate: { constraints: rule }, leastSquares: { constraints: rule, epsilon: 0.1 } };
  const numbers = [0, -1, 1.5, '2', NaN, 1n, 2 ** 32, [2]];

  it.each([
    ...[-0.5, 'none', true, 3].map((bad) => ['interpolate', { energy: bad }, 'energy']),
    ...['ignore', false, 1].map((bad) => ['interpolate', { unconstrained: bad }, 'unconstrained']),
    ...numbers.map((bad) => ['interpolate', { channels: bad }, 'channels']),
    ...[0, -1, NaN, Infinity, '1', true, undefined].map((bad) => ['leastSquares', { epsilon: bad }, 'epsilon']),
    ['leastSquares', { epsilon: {} }, 'epsilon.rule'],
    ...['ignore', 0].map((bad) => ['leastSquares', { unconstrained: bad }, 'unconstrained']),
    ...numbers.map((bad) => ['leastSquares', { channels: bad }, 'channels']),
  ])('%s: %o', (method, bad, option) => {
    const smoother = new Smoother(make(torus(9, 7)));
    const expected = smoother[method](f, good[method]);
    expectError(() => smoother[method](f, { ...good[method], ...bad }), 'InvalidOption', { option });
    expect(smoother[method](f, good[method])).toEqual(expected);
  });

  it('are those of other methods', () => {
    const smoother = new Smoother(make(torus(9, 7)));
    for (const [method, option, value] of [
      ['interpolate', 'epsilon', 1],
      ['interpolate', 'weights', [1]],
      ['interpolate', 'metric', 'mass'],
      ['interpolate', 'cutoffWavelength', 1],
      ['interpolate', 'iterations', 1],
      ['leastSquares', 'energy', 'harmonic'],
      ['leastSquares', 'metric', 'mass'],
      ['leastSquares', 'massScale', 'raw'],
      ['leastSquares', 'cutoffWavelength', 1],
      ['leastSquares', 'method', 'leastSquares'],
      ['tikhonov', 'constraints', [1]],
      ['tikhonov', 'constraints', 'all'],
      ['tikhonov', 'unconstrained', 'keep'],
    ]) {
      const options = { ...(good[method] ?? { epsilon: 1 }), [option]: value };
      expectError(() => smoother[method](f, options), 'UnknownOption', { option });
    }
  });

  it('are weights that do not fit', () => {
    const smoother = new Smoother(make(torus(9, 7)));
    const run = (weights, constraints = [9, 4, 30]) => smoother.leastSquares(f, { constraints, epsilon: 1, weights });
    const expected = run([1, 2, 3]);
    for (const bad of [5, '111', {}, new BigInt64Array(3), new Map()])
      expectError(() => run(bad), 'InvalidArgument', { argument: 'weights' });
    expectError(() => run([1, '2', 3]), 'InvalidArgument', { argument: 'weights', index: 1 });
    expectError(() => run([1, 2]), 'LengthMismatch', { expected: 3, actual: 2 });
    expectError(() => run([]), 'LengthMismatch', { expected: 3, actual: 0 });
    expectError(() => run([1, 2, 3, 4], [9, 4, 4]), 'LengthMismatch', { expected: 3, actual: 4 });
    for (const bad of [0, -1, NaN, Infinity]) {
      expectError(() => run([1, bad, 3]), 'InvalidWeight', { index: 1, vertex: 4 });
      expectError(() => run(Float32Array.of(1, 2, bad)), 'InvalidWeight', { index: 2, vertex: 30 });
    }
    expect(run([1, 2, 3])).toEqual(expected);
    expect(run(null)).toEqual(run(undefined));
  });

  it('are those that mean nothing for the method of smooth', () => {
    const mesh = make(torus(9, 7));
    const constraints = [1, 2];
    for (const [options, option] of [
      [{ method: 'tikhonov', epsilon: 1, constraints }, 'constraints'],
      [{ epsilon: 1, unconstrained: 'keep' }, 'unconstrained'],
      [{ epsilon: 1, energy: 'harmonic' }, 'energy'],
      [{ method: 'interpolate', constraints, epsilon: 1 }, 'epsilon'],
      [{ method: 'interpolate', constraints, metric: 'mass' }, 'metric'],
      [{ method: 'interpolate', constraints, massScale: 'raw' }, 'massScale'],
      [{ method: 'interpolate', operator: 'fem', constraints, cutoffWavelength: 1 }, 'cutoffWavelength'],
      [{ epsilon: 1, constraints, energy: 'harmonic' }, 'energy'],
      [{ epsilon: 1, constraints, metric: 'mass' }, 'metric'],
      [{ epsilon: 1, constraints, massScale: 'raw' }, 'massScale'],
      [{ operator: 'fem', constraints, cutoffWavelength: 1 }, 'cutoffWavelength'],
    ])
      expectError(() => smooth(mesh, f, options), 'InapplicableOption', { option });
    for (const [options, option] of [
      [{ method: 'leastSquares', epsilon: 1 }, 'constraints'],
      [{ method: 'interpolate' }, 'constraints'],
      [{ method: 'blur', constraints, epsilon: 1 }, 'method'],
      [{ method: 3, epsilon: 1 }, 'method'],
      // They are names here: numbers are for `leastSquares`.
      [{ constraints, epsilon: 1, weights: [1, 2] }, 'weights'],
    ])
      expectError(() => smooth(mesh, f, options), 'InvalidOption', { option });
    for (const bad of [5, 'x', [1], new Map(), null])
      expectError(() => smooth(mesh, f, bad), 'InvalidArgument', { argument: 'options' });
    expect(smooth(mesh, f, { constraints, epsilon: 1 }).values).toHaveLength(63);
    // ε is chosen where it is left out.
    for (const options of [{}, { method: 'leastSquares' }, { epsilon: 'auto' }])
      expect(smooth(mesh, f, { constraints, ...options }).report.choice.rule).toBe('gcv');
  });
});

describe('values and objects', () => {
  it('are checked before anything is done', () => {
    const smoother = new Smoother(make(tetrahedron()));
    for (const run of [
      (values, more) => smoother.interpolate(values, { constraints: [0, 3], ...more }),
      (values, more) => smoother.leastSquares(values, { constraints: [0, 3], epsilon: 1, ...more }),
      (values, more) => make(tetrahedron()).constrainedVertices(values, [0, 3], more),
    ]) {
      const expected = run([1, 2, 4, 8]);
      expectError(() => run([1, 2, 4]), 'LengthMismatch', { expected: 4, actual: 3 });
      expectError(() => run([1, 2, 4, 8], { channels: 2 }), 'LengthMismatch', { expected: 8, actual: 4 });
      expectError(() => run([1, NaN, 4, 8]), 'NonFiniteValue', { vertex: 1 });
      expectError(() => run([1, 2, 4, 8, 5, Infinity, 7, 8], { channels: 2 }), 'NonFiniteValue', { vertex: 2 });
      expectError(() => run([1, 2, '4', 8]), 'InvalidArgument', { argument: 'values', index: 2 });
      expectError(() => run([1, 2, 4, 8], { colour: 1 }), 'UnknownOption', { option: 'colour' });
      expect(run([1, 2, 4, 8])).toEqual(expected);
    }
    for (const bad of [5, null, [1], new Map()])
      expectError(() => make(tetrahedron()).constrainedVertices([1, 2, 4, 8], [0], bad), 'InvalidArgument', {
        argument: 'options',
      });
  });

  it('end with free', () => {
    const mesh = make(tetrahedron());
    const smoother = new Smoother(mesh);
    const run = (method) => () => smoother[method]([1, 2, 4, 8], { constraints: [0, 3], ...epsilons[method] });
    const epsilons = { leastSquares: { epsilon: 1 } };
    mesh.free();
    expectError(() => mesh.constrainedVertices([1, 2, 4, 8], [0]), 'UseAfterFree', { object: 'TriMesh' });
    expectError(() => smooth(mesh, [1, 2, 4, 8], { epsilon: 1, constraints: [0] }), 'UseAfterFree', {
      object: 'TriMesh',
    });
    // The smoother lives on without its mesh.
    expect(run('interpolate')().values).toHaveLength(4);
    expectError(() => smoother.interpolate([1, 2, 4, 8], { constraints: [9] }), 'IndexOutOfBounds', { vertices: 4 });
    smoother.free();
    for (const method of ['interpolate', 'leastSquares'])
      expectError(run(method), 'UseAfterFree', { object: 'Smoother' });
  });

  it('are busy while onProgress runs, which may throw', () => {
    const mesh = make(torus(9, 7));
    const codes = new Set();
    let failure = null;
    const attempt = (call) => {
      try {
        call();
      } catch (error) {
        codes.add(error.code);
      }
    };
    const onProgress = ({ fraction }) => {
      expect(fraction).toBeGreaterThanOrEqual(0);
      expect(mesh.constrainedVertices(f, rule).length).toBeGreaterThan(0);
      attempt(() => smoother.interpolate(f, { constraints: [1] }));
      attempt(() => smoother.leastSquares(f, { constraints: [1], epsilon: 1 }));
      attempt(() => smoother.free());
      if (failure) throw failure;
    };
    const smoother = new Smoother(mesh, { onProgress });
    const quiet = new Smoother(mesh);
    for (const [method, options] of [
      ['interpolate', { constraints: rule }],
      ['leastSquares', { constraints: rule, epsilon: 0.1 }],
    ]) {
      const expected = quiet[method](f, options);
      expect(smoother[method](f, options)).toEqual(expected);
      expect([...codes]).toEqual(['Busy']);
      failure = new RangeError('enough');
      expect(() => smoother[method](f, options)).toThrow(failure);
      const throwing = () => {
        attempt(() => mesh.free());
        throw failure;
      };
      expect(() => smooth(mesh, f, { ...options, method, onProgress: throwing })).toThrow(failure);
      failure = null;
      expect(smoother[method](f, options)).toEqual(expected);
      codes.clear();
    }
  });
});
