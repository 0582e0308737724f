// Long calls tell how far they are, and can be stopped.
import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { random, square } from './meshes.js';
import { same } from './same.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const shape = square(100);
const values = Float64Array.from({ length: 101 * 101 }, random(5));
const constraints = { from: 'criticalPoints', delta: 0.5 };
/** A family that is soon there. */
const loose = { tolerance: 0.01, epsilonRange: [0.01, 1] };

const analyses = {
  criticalPoints: (mesh, more) => mesh.criticalPoints(values, more),
  deltaHierarchy: (mesh, more) => mesh.deltaHierarchy(values, more),
  persistence: (mesh, more) => mesh.persistence(values, more),
  persistenceCurve: (mesh, more) => mesh.persistenceCurve(values, more),
  simplify: (mesh, more) => mesh.simplify(values, { threshold: 0.2, ...more }),
  morseComplex: (mesh, more) => mesh.morseComplex(values, { persistence: 0.1, ...more }),
  morseHierarchy: (mesh, more) => mesh.morseHierarchy(values, more),
  basins: (mesh, more) => mesh.basins(values, { persistence: 0.1, ...more }),
  levelSets: (mesh, more) => mesh.levelSets(values, { count: 100 }, more),
  bands: (mesh, more) => mesh.bands(values, { count: 100 }, more),
  constrainedVertices: (mesh, more) => mesh.constrainedVertices(values, constraints, more),
  smoothness: (mesh, more) => mesh.smoothness(values, more),
};
const smoothings = {
  tikhonov: (smoother, more) => smoother.tikhonov(values, { epsilon: 0.1, ...more }),
  interpolate: (smoother, more) => smoother.interpolate(values, { constraints, ...more }),
  leastSquares: (smoother, more) => smoother.leastSquares(values, { epsilon: 1, constraints, ...more }),
  'prescribe, preview': (smoother, more) => smoother.prescribe(values, { epsilon: 0.1, preview: true, ...more }),
  sweep: (smoother, more) => smoother.sweep(values, { ...loose, counts: true, ...more }),
  family: (smoother, more) => {
    const family = smoother.family(values, { ...loose, ...more });
    const found = [family.values(0.1), family.shifts, family.errorEstimate];
    family.free();
    return found;
  },
  lowPass: (smoother, more) => smoother.lowPass(values, { iterations: 200, ...more }),
  bilateral: (smoother, more) =>
    smoother.bilateral(values, { iterations: 3, radius: 3, sigmaDistance: 1, sigmaValue: 1, ...more }),
};
const short = {
  'smooth by Tikhonov': (mesh, more) => smooth(mesh, values, { epsilon: 0.1, ...more }),
  'smooth by interpolation': (mesh, more) => smooth(mesh, values, { method: 'interpolate', constraints, ...more }),
  'smooth by least squares': (mesh, more) => smooth(mesh, values, { epsilon: 1, constraints, ...more }),
};
const onMeshes = { ...analyses, ...short };

/** What a call tells. */
function told(call) {
  const seen = [];
  call({ onProgress: (progress) => void seen.push(progress) });
  return seen;
}

function expectProgress(seen, phases) {
  expect(seen.length).toBeGreaterThan(0);
  let before = 0;
  for (const { phase, fraction } of seen) {
    expect(phases).toContain(phase);
    expect(fraction).toBeGreaterThanOrEqual(before);
    expect(fraction).toBeLessThanOrEqual(1);
    before = fraction;
  }
}

/** Stops a call each time it tells something, and lets a callback throw; then the call is as it was. */
function expectStops(call) {
  const expected = call();
  const times = told(call).length;
  for (const time of new Set([0, 1, Math.floor(times / 2), times - 1].filter((time) => time < times))) {
    let count = 0;
    const stop = () => count++ < time;
    expectError(() => call({ onProgress: stop }), 'Cancelled');
    expect(count, 'nothing is told after it').toBe(time + 1);
    expect(same(call(), expected)).toBe(true);
    const mine = new RangeError('mine');
    count = 0;
    const fail = () => {
      if (count++ >= time) throw mine;
    };
    let thrown;
    try {
      call({ onProgress: fail });
    } catch (error) {
      thrown = error;
    }
    expect(thrown).toBe(mine);
    expect(count).toBe(time + 1);
    expect(same(call(), expected)).toBe(true);
  }
  // Anything but `false` goes on, and what is asynchronous is not waited for.
  for (const answer of [undefined, null, 0, '', true, Promise.resolve(false)])
    expect(same(call({ onProgress: () => answer }), expected)).toBe(true);
}

describe('progress', () => {
  it.each(Object.keys(analyses))('of %s is monotone', (name) => {
    expectProgress(
      told((more) => analyses[name](make(shape), more)),
      ['field'],
    );
  });

  const phases = ['analysis', 'factorization', 'solve', 'report', 'field'];
  it.each(Object.keys(smoothings))('of %s is monotone', (name) => {
    const smoother = new Smoother(make(shape));
    const call = (more) => smoothings[name](smoother, more);
    expectProgress(told(call), phases);
    expectProgress(told(call), phases);
  });

  it.each(Object.keys(short))('of %s is monotone', (name) => {
    expectProgress(
      told((more) => short[name](make(shape), more)),
      phases,
    );
  });

  it('goes to the call’s own callback, else to that of the smoother', () => {
    const seen = { smoother: 0, call: 0 };
    const smoother = new Smoother(make(shape), { onProgress: () => void seen.smoother++ });
    smoother.tikhonov(values, { epsilon: 0.1 });
    expect(seen.smoother).toBeGreaterThan(0);
    const before = seen.smoother;
    smoother.tikhonov(values, { epsilon: 0.2, onProgress: () => void seen.call++ });
    expect(seen.smoother).toBe(before);
    expect(seen.call).toBeGreaterThan(0);
    smoother.tikhonov(values, { epsilon: 0.2, onProgress: undefined });
    expect(seen.smoother).toBeGreaterThan(before);
  });

  it.each(Object.keys(analyses))('of %s wants a function', (name) => {
    const mesh = make(shape);
    for (const bad of ['tell me', 1, {}, true])
      expectError(() => analyses[name](mesh, { onProgress: bad }), 'InvalidOption', { option: 'onProgress' });
    expectError(() => analyses[name](mesh, { onprogress: () => {} }), 'UnknownOption', { option: 'onprogress' });
  });
});

describe('stopping', () => {
  it.each(Object.keys(onMeshes))('%s leaves the mesh as it was', (name) => {
    const mesh = make(shape);
    expectStops((more) => onMeshes[name](mesh, more));
  });

  it.each(Object.keys(smoothings))('%s leaves the smoother as it was', (name) => {
    const smoother = new Smoother(make(shape));
    expectStops((more) => smoothings[name](smoother, more));
  });

  it.each(Object.keys(smoothings))('the first call of %s leaves the next one right', (name) => {
    const mesh = make(shape);
    const expected = smoothings[name](new Smoother(mesh));
    const times = told((more) => smoothings[name](new Smoother(mesh), more)).length;
    for (let time = 0; time < times; time += Math.ceil(times / 8)) {
      const smoother = new Smoother(mesh);
      let count = 0;
      expectError(() => smoothings[name](smoother, { onProgress: () => count++ < time }), 'Cancelled');
      expect(same(smoothings[name](smoother), expected)).toBe(true);
    }
  });

  it('is for the call alone: others go on from within a callback', () => {
    const mesh = make(shape);
    const expected = mesh.persistence(values);
    let found;
    const onProgress = () => {
      found ??= mesh.persistence(values);
      expectError(() => mesh.free(), 'Busy', { object: 'TriMesh' });
      return false;
    };
    expectError(() => mesh.criticalPoints(values, { onProgress }), 'Cancelled');
    expect(found).toEqual(expected);
    mesh.free();
  });
});
