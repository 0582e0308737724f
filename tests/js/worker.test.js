// The API in a worker: every call gives what it gives without one, to the last bit.
import init, { Smoother, SmoothingFamily, TriMesh, smooth } from 'morse-smooth';
import initFiles, * as files from 'morse-smooth/files';
import initPictures, * as pictures from 'morse-smooth/snapshot';
import { connect } from 'morse-smooth/worker';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { classes, functions } from '../../src/js/api/worker/table.js';
import { expectRejection } from './errors.js';
import { heights, random, square, text, torus } from './meshes.js';
import { same } from './same.js';

const shape = torus(24, 12);
const count = 24 * 12;
const noise = random(3);
const values = Float64Array.from(heights(shape), (height) => height + 0.4 * noise());
const withHole = values.map((value, vertex) => (vertex % 50 === 7 ? NaN : value));
const constraints = { from: 'persistence', threshold: 0.1 };
const loose = { tolerance: 0.01, epsilonRange: [0.01, 1] };
const small = { width: 60, height: 50 };
const file = text('OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n');

let remote;
let local;
let there;
beforeAll(async () => {
  await Promise.all([init(), initFiles(), initPictures()]);
  remote = await connect();
  const mesh = new TriMesh(shape.positions, shape.triangles);
  const smoother = new Smoother(mesh);
  local = { TriMesh: mesh, Smoother: smoother, SmoothingFamily: smoother.family(values, loose) };
  local.Scene = new pictures.Scene(shape.positions, shape.triangles);
  const meshThere = await remote.createMesh(shape.positions, shape.triangles);
  const smootherThere = await remote.createSmoother(meshThere);
  there = { TriMesh: meshThere, Smoother: smootherThere, SmoothingFamily: await smootherThere.family(values, loose) };
  there.Scene = await remote.createScene(shape.positions, shape.triangles);
});
afterAll(() => remote.close());

/** The arguments of every method, of some with several choices. */
const calls = {
  TriMesh: {
    positions: [[]],
    triangles: [[]],
    vertexMap: [[]],
    criticalPoints: [[values], [values, { delta: 0.2, link: 'skip' }], [withHole, { missing: 'omit' }]],
    deltaHierarchy: [[values]],
    levelSets: [
      [values, { count: 5 }],
      [values, [0.5, 1]],
      [values, { saddles: true, offset: 0.01 }],
    ],
    bands: [[values, { count: 5 }]],
    persistence: [[values]],
    persistenceCurve: [[Array.from(values)]],
    simplify: [[values, { threshold: 0.2 }]],
    morseComplex: [[values, { persistence: 0.1, paths: 'merged' }]],
    morseHierarchy: [[values]],
    basins: [[Float32Array.from(values)]],
    constrainedVertices: [
      [values, constraints],
      [values, [1, 2], { channels: 1 }],
    ],
    smoothness: [[values, { weights: 'meanValue' }]],
    laplacian: [[], [{ weights: 'uniform' }]],
    mass: [[{ kind: 'lumped' }]],
  },
  Smoother: {
    tikhonov: [
      [values, { epsilon: 0.1 }],
      [values, { epsilon: 'auto' }],
      [withHole, { epsilon: 0.1, missing: 'fill' }],
    ],
    interpolate: [[values, { constraints, energy: 'biharmonic' }]],
    leastSquares: [[values, { epsilon: 1, constraints: [3, 50, 99], weights: [1, 2, 3], unconstrained: 'mean' }]],
    lowPass: [[values, { iterations: 20, mu: -0.53 }]],
    bilateral: [[values, { iterations: 2, radius: 1, sigmaDistance: 0.5, sigmaValue: 0.5 }]],
    prescribe: [
      [values, { epsilon: 0.1, preview: true }],
      [values, { epsilon: 0.1, extrema: { from: 'persistence', minima: 1, maxima: 1 } }],
    ],
    sweep: [[values, { ...loose, counts: true, epsilons: [0.1, 0.5] }]],
  },
  SmoothingFamily: {
    errorAt: [[0.1]],
    values: [[0.1], [0.77]],
    at: [[0.1]],
    sweep: [[], [{ epsilons: [0.02, 0.5], counts: true }]],
    choose: [[], ['auto'], [{ rule: 'gcv' }], [undefined, {}]],
    lives: [[{ perDecade: 4 }]],
  },
  Scene: {
    snapshot: [[values, { ...small, bands: true, camera: { direction: [1, 2, 3] } }]],
    sheet: [[values, withHole, { ...small, missing: 'omit' }]],
    surface: [[]],
    drawList: [[values, { criticalPoints: true }]],
  },
};

/** The answer or the error of a call without a worker. */
function outcomeOf(call) {
  try {
    return { value: call() };
  } catch ({ code, message, detail }) {
    return { error: { code, message, detail } };
  }
}

const outcomeOfRemote = (promise) =>
  promise.then(
    (value) => ({ value }),
    ({ code, message, detail }) => ({ error: { code, message, detail } }),
  );

describe('the table', () => {
  const owner = { TriMesh, Smoother, SmoothingFamily, Scene: pictures.Scene };
  it.each(Object.keys(classes))('has all members of %s', (kind) => {
    const members = Object.getOwnPropertyNames(owner[kind].prototype).filter(
      (name) => !['constructor', 'free'].includes(name),
    );
    const { facts, methods } = classes[kind];
    expect([...facts, ...Object.keys(methods)].sort()).toEqual(members.sort());
  });

  it('has all functions', () => {
    const isFunction = ([name, value]) => typeof value === 'function' && /^[a-z]/.test(name) && name !== 'default';
    const all = [...Object.entries(files), ...Object.entries(pictures), ['smooth', smooth]].filter(isFunction);
    const made = ['createMesh', 'createSmoother', 'createScene'];
    expect(Object.keys(functions).sort()).toEqual([...all.map(([name]) => name), ...made].sort());
  });

  it('is tried as a whole below', () => {
    for (const [kind, { methods }] of Object.entries(classes)) {
      const apart = ['topology', 'withoutMissing', 'family', 'grow'];
      const tried = Object.keys(methods).filter((name) => !apart.includes(name));
      expect(Object.keys(calls[kind]).sort()).toEqual(tried.sort());
    }
  });
});

const all = Object.entries(calls).flatMap(([kind, methods]) => Object.keys(methods).map((name) => [kind, name]));

describe('in a worker', () => {
  it.each(all)('%s.%s is equal', async (kind, name) => {
    for (const given of calls[kind][name]) {
      const expected = outcomeOf(() => local[kind][name](...given));
      expect(expected.error).toBeUndefined();
      expect(same(await outcomeOfRemote(there[kind][name](...given)), expected), JSON.stringify(expected.error)).toBe(
        true,
      );
    }
    // Values stay the caller's.
    expect(values.length).toBe(count);
  });

  it.each(Object.keys(classes))('properties of %s are equal', async (kind) => {
    for (const fact of classes[kind].facts) expect(there[kind][fact], fact).toEqual(local[kind][fact]);
  });

  it('has what takes time of a mesh, and its parts', async () => {
    expect(await there.TriMesh.topology()).toEqual(local.TriMesh.topology);
    const { mesh, vertices } = await there.TriMesh.withoutMissing(withHole);
    const part = local.TriMesh.withoutMissing(withHole);
    expect(same(vertices, part.vertices)).toBe(true);
    expect(mesh.vertexCount).toBe(part.mesh.vertexCount);
    const field = Float64Array.from(vertices, (vertex) => values[vertex]);
    expect(same(await mesh.persistence(field), part.mesh.persistence(field))).toBe(true);
    mesh.free();
  });

  it('grows a family', async () => {
    const options = { tolerance: 1e-9, factorizations: 2 };
    const [here, away] = [local.Smoother.family(values, options), await there.Smoother.family(values, options)];
    for (let time = 0; time < 3; time++) {
      expect(same(await away.values(0.3), here.values(0.3))).toBe(true);
      expect(await away.grow()).toBe(here.grow());
      expect([away.factorizations, away.dimension, away.complete]).toEqual([here.factorizations, here.dimension, here.complete]); // prettier-ignore
      expect(same(away.shifts, here.shifts)).toBe(true);
    }
    away.free();
    here.free();
  });

  it('smooths once', async () => {
    for (const options of [undefined, { epsilon: 0.2 }, { method: 'interpolate', constraints }]) {
      const away = await remote.smooth(there.TriMesh, values, options);
      expect(same(away, smooth(local.TriMesh, values, options))).toBe(true);
    }
  });

  it('reads, writes and draws', async () => {
    expect(await remote.formats()).toEqual(files.formats());
    const mesh = await remote.readMesh(file);
    expect(mesh).toEqual(files.readMesh(file));
    expect(await remote.readField(text('1 2 3'))).toEqual(Float64Array.of(1, 2, 3));
    expect(await remote.readTable(text('a,b\n1,2\n'))).toEqual(files.readTable(text('a,b\n1,2\n')));
    const options = { format: 'ply', fields: { heat: [1, 2, 3] }, binary: true };
    expect(await remote.writeMesh(mesh, options)).toEqual(files.writeMesh(mesh, options));
    const { positions, triangles } = shape;
    const png = await remote.snapshot(positions, triangles, values, small);
    expect(same(png, pictures.snapshot(positions, triangles, values, small))).toBe(true);
    const sheet = await remote.sheet(positions, triangles, values, values, small);
    expect(same(sheet, pictures.sheet(positions, triangles, values, values, small))).toBe(true);
  });

  it('gives arrays that are the caller’s own', async () => {
    const one = await there.SmoothingFamily.values(0.2);
    const { shifts } = there.SmoothingFamily;
    one.fill(0);
    shifts.fill(0);
    expect(same(await there.SmoothingFamily.values(0.2), local.SmoothingFamily.values(0.2))).toBe(true);
    expect(same(there.SmoothingFamily.shifts, local.SmoothingFamily.shifts)).toBe(true);
  });

  it('takes arrays over where it is told to', async () => {
    const positions = Float64Array.from(shape.positions);
    const triangles = Uint32Array.from(shape.triangles);
    const mesh = await remote.createMesh(positions, triangles, { transfer: true });
    expect([positions.length, triangles.length, mesh.vertexCount]).toEqual([0, 0, count]);
    const [whole, padded] = [values.slice(), new Float64Array(count + 1)];
    padded.set(values);
    const part = padded.subarray(0, count);
    const expected = local.TriMesh.persistence(values);
    expect(same(await mesh.persistence(part, { transfer: true }), expected)).toBe(true);
    expect(part.length).toBe(count);
    expect(same(await mesh.persistence(whole, { transfer: true }), expected)).toBe(true);
    expect(whole.length).toBe(0);
    mesh.free();
  });

  it('keeps to what was given when it was called', async () => {
    const mine = values.slice();
    const options = { threshold: 0.2 };
    const promise = there.TriMesh.simplify(mine, options);
    mine.fill(0);
    options.threshold = 0;
    expect(same(await promise, local.TriMesh.simplify(values, { threshold: 0.2 }))).toBe(true);
  });

  it('tells the progress, its own or that of the smoother', async () => {
    const seen = { smoother: [], call: [] };
    const smoother = await remote.createSmoother(there.TriMesh, {
      onProgress: (told) => void seen.smoother.push(told),
    });
    const before = seen.smoother.length;
    await smoother.tikhonov(values, { epsilon: 0.3 });
    expect(seen.smoother.length).toBeGreaterThan(before);
    const now = seen.smoother.length;
    await smoother.tikhonov(values, { epsilon: 0.4, onProgress: (told) => void seen.call.push(told) });
    expect(seen.smoother.length).toBe(now);
    let least = 0;
    for (const { phase, fraction } of seen.call) {
      expect(['analysis', 'factorization', 'solve', 'report', 'field']).toContain(phase);
      expect(fraction).toBeGreaterThanOrEqual(least);
      least = fraction;
    }
    expect(least).toBeGreaterThan(0);
    smoother.free();
  });

  it('makes calls in their order, however many', async () => {
    const order = [];
    const epsilons = Array.from({ length: 30 }, (_, k) => 0.02 + 0.03 * k);
    const all = epsilons.map(async (epsilon, k) => {
      const found = await there.SmoothingFamily.values(epsilon);
      order.push(k);
      return found;
    });
    const found = await Promise.all(all);
    expect(order).toEqual(epsilons.map((_, k) => k));
    epsilons.forEach((epsilon, k) => expect(same(found[k], local.SmoothingFamily.values(epsilon))).toBe(true));
  });
});

describe('several workers', () => {
  it('share the calls on one mesh', async () => {
    const pool = await connect({ workers: 3 });
    const mesh = await pool.createMesh(shape.positions, shape.triangles);
    const smoother = await pool.createSmoother(mesh);
    mesh.free();
    const epsilons = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5];
    const found = await Promise.all(epsilons.map((epsilon) => smoother.tikhonov(values, { epsilon })));
    epsilons.forEach((epsilon, k) => expect(same(found[k], local.Smoother.tikhonov(values, { epsilon }))).toBe(true));
    // A family stays where it was made; so what grows it is one.
    const family = await smoother.family(values, { tolerance: 1e-9, factorizations: 2 });
    const grown = await Promise.all([family.grow(), family.grow(), smoother.tikhonov(values, { epsilon: 1 })]);
    expect(grown.slice(0, 2)).toEqual([false, false]);
    expect(family.factorizations).toBe(4);
    pool.close();
  });
});

describe('life of objects', () => {
  it('ends with free, after the calls that were made before', async () => {
    const mesh = await remote.createMesh(shape.positions, shape.triangles);
    const smoother = await remote.createSmoother(mesh);
    const last = mesh.persistence(values);
    mesh.free();
    mesh.free();
    expect(same(await last, local.TriMesh.persistence(values))).toBe(true);
    await expectRejection(mesh.persistence(values), 'UseAfterFree', { object: 'TriMesh' });
    await expectRejection(remote.createSmoother(mesh), 'UseAfterFree', { object: 'TriMesh' });
    expect(() => mesh.vertexCount).toThrow('freed');
    const epsilon = 0.1;
    expect(same(await smoother.tikhonov(values, { epsilon }), local.Smoother.tikhonov(values, { epsilon }))).toBe(true);
    const family = await smoother.family(values, loose);
    smoother.free();
    expect(same(await family.values(0.1), local.SmoothingFamily.values(0.1))).toBe(true);
    await expectRejection(family.grow(), 'UseAfterFree');
    family.free();
    await expectRejection(family.values(0.1), 'UseAfterFree', { object: 'SmoothingFamily' });
  });

  it('is that of its connection', async () => {
    const other = await connect();
    const mesh = await other.createMesh(square(2).positions, square(2).triangles);
    await expectRejection(remote.smooth(mesh, values), 'InvalidArgument', { object: 'TriMesh' });
    const running = other.createMesh(shape.positions, shape.triangles);
    other.close();
    other.close();
    await expectRejection(running, 'ConnectionClosed');
    await expectRejection(mesh.topology(), 'ConnectionClosed');
    await expectRejection(other.formats(), 'ConnectionClosed');
    mesh.free();
    expect(await remote.formats()).toEqual(files.formats());
  });
});
