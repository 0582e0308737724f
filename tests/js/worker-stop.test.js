// Calls in a worker are stopped, and take the place of others: where memory is shared, and where a worker must end for it.
import init, { Smoother, TriMesh } from 'morse-smooth';
import { connect } from 'morse-smooth/worker';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { expectRejection } from './errors.js';
import { random, square } from './meshes.js';
import { same } from './same.js';

/** What abort may take until the call fails. */
const AT_ONCE = 100;

const typed = ({ positions, triangles }) => ({
  positions: Float64Array.from(positions),
  triangles: Uint32Array.from(triangles),
});
const shape = typed(square(150));
const values = Float64Array.from({ length: 151 * 151 }, random(5));
/** 100,000 vertices. */
const wide = typed(square(316));
const wideValues = Float64Array.from({ length: 317 * 317 }, random(5));

const Shared = globalThis.SharedArrayBuffer;
const ways = [];
if (Shared) ways.push(['with shared memory', Shared]);
ways.push(['without shared memory', undefined]);

/** How long until a promise is settled, and by what. */
async function settled(promise) {
  const start = performance.now();
  const outcome = await outcomeOf(promise);
  return { ...outcome, time: performance.now() - start };
}

const outcomeOf = (promise) =>
  promise.then(
    (value) => ({ value }),
    (reason) => ({ reason }),
  );

/** Waits until a call has told something. */
function begun(call, phase) {
  let promise;
  const isTold = new Promise((resolve) => {
    const onProgress = (progress) => {
      if (phase === undefined || progress.phase === phase) resolve();
    };
    promise = call(onProgress);
    promise.catch(resolve);
  });
  return { promise, isTold };
}

const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));

let local;
beforeAll(async () => {
  await init();
  const mesh = new TriMesh(shape.positions, shape.triangles);
  local = { mesh, smoother: new Smoother(mesh) };
});

describe.each(ways)('%s', (_, buffer) => {
  let remote;
  let mesh;
  let smoother;
  beforeAll(async () => {
    globalThis.SharedArrayBuffer = buffer;
    remote = await connect();
    mesh = await remote.createMesh(shape.positions, shape.triangles);
    smoother = await remote.createSmoother(mesh);
  });
  afterEach(() => {
    globalThis.SharedArrayBuffer = buffer;
  });
  afterAll(() => {
    globalThis.SharedArrayBuffer = Shared;
    remote.close();
  });

  it('abort stops a factorisation at 250,000 vertices, and the next call is right', async () => {
    const { positions, triangles } = typed(square(500));
    const field = Float64Array.from({ length: 501 * 501 }, random(6));
    const large = await remote.createMesh(positions, triangles);
    const tiny = await remote.createMesh(square(1).positions, square(1).triangles);
    const largeSmoother = await remote.createSmoother(large);
    const controller = new AbortController();
    const { signal } = controller;
    const { promise, isTold } = begun(
      (onProgress) => largeSmoother.tikhonov(field, { epsilon: 0.1, signal, onProgress }),
      'factorization',
    );
    await isTold;
    await pause(30);
    const free = settled(tiny.topology());
    const next = large.criticalPoints(field);
    controller.abort();
    const { reason, time } = await settled(promise);
    expect(reason).toBe(signal.reason);
    expect(reason.name).toBe('AbortError');
    expect(time).toBeLessThan(AT_ONCE);
    const points = await settled(next);
    const { value: topology, time: untilFree } = await free;
    expect(topology.eulerCharacteristic).toBe(1);
    // Other tests run meanwhile; on its own it is as quick as the abort.
    expect(untilFree).toBeLessThan(50 * AT_ONCE);
    expect(same(points.value, new TriMesh(positions, triangles).criticalPoints(field))).toBe(true);
    large.free();
    tiny.free();
    largeSmoother.free();
  });

  it('abort stops a call that waits, and one that has not begun', async () => {
    const controller = new AbortController();
    const first = smoother.tikhonov(values, { epsilon: 0.1 });
    const second = mesh.persistence(values, { signal: controller.signal });
    const third = mesh.criticalPoints(values);
    controller.abort(new RangeError('mine'));
    await expect(second).rejects.toBe(controller.signal.reason);
    await expect(mesh.persistence(values, { signal: controller.signal })).rejects.toBe(controller.signal.reason);
    await expect(connect({ signal: controller.signal })).rejects.toBe(controller.signal.reason);
    expect(same(await first, local.smoother.tikhonov(values, { epsilon: 0.1 }))).toBe(true);
    expect(same(await third, local.mesh.criticalPoints(values))).toBe(true);
  });

  it('abort stops what makes objects', async () => {
    const controller = new AbortController();
    const { signal } = controller;
    const one = settled(remote.createMesh(shape.positions, shape.triangles, { signal }));
    const two = settled(remote.createSmoother(mesh, { signal }));
    controller.abort();
    for (const { reason } of await Promise.all([one, two])) expect(reason).toBe(signal.reason);
    expect(same(await mesh.criticalPoints(values), local.mesh.criticalPoints(values))).toBe(true);
  });

  it('stops by what is called back, by its answer or by what it throws', async () => {
    await expectRejection(smoother.tikhonov(values, { epsilon: 0.2, onProgress: () => false }), 'Cancelled');
    const mine = new RangeError('mine');
    const fail = () => {
      throw mine;
    };
    await expect(smoother.tikhonov(values, { epsilon: 0.2, onProgress: fail })).rejects.toBe(mine);
    expect(same(await mesh.persistence(values), local.mesh.persistence(values))).toBe(true);
  });

  it('aborted again and again, works on', async () => {
    const next = random(9);
    for (let time = 0; time < 8; time++) {
      const controller = new AbortController();
      const { signal } = controller;
      const call = time % 2 ? mesh.morseComplex(values, { signal }) : smoother.tikhonov(values, { epsilon: 1 + time, signal }); // prettier-ignore
      await pause(80 * next());
      controller.abort();
      const { reason, time: waited } = await settled(call);
      if (reason) expect(reason).toBe(signal.reason);
      expect(waited).toBeLessThan(AT_ONCE);
    }
    expect(same(await mesh.criticalPoints(values), local.mesh.criticalPoints(values))).toBe(true);
    const epsilon = 0.3;
    expect(same(await smoother.tikhonov(values, { epsilon }), local.smoother.tikhonov(values, { epsilon }))).toBe(true);
  });

  it('a slider shows the last value at once', async () => {
    const mesh = await remote.createMesh(wide.positions, wide.triangles);
    const smoother = await remote.createSmoother(mesh);
    const family = await smoother.family(wideValues, { tolerance: 0.1, epsilonRange: [0.1, 1], factorizations: 1 });
    const shown = [];
    const epsilons = Array.from({ length: 60 }, (_, k) => 0.1 + 0.015 * k);
    const all = [];
    let start;
    for (const epsilon of epsilons) {
      start = performance.now();
      all.push(outcomeOf(family.values(epsilon, { latest: true }).then(() => shown.push(epsilon))));
      await pause(1000 / 60);
    }
    const outcomes = await Promise.all(all);
    const time = performance.now() - start;
    expect(shown.at(-1)).toBe(epsilons.at(-1));
    expect(time).toBeLessThan(250);
    // It does not stand still while it moves, either.
    expect(shown.length).toBeGreaterThan(5);
    for (const { reason } of outcomes) if (reason) expect(reason.name).toBe('AbortError');
    for (const object of [family, smoother, mesh]) object.free();
  });

  it('a slider of slow calls ends with the last value and computes few others', async () => {
    const mesh = await remote.createMesh(wide.positions, wide.triangles);
    const smoother = await remote.createSmoother(mesh);
    const local = new Smoother(new TriMesh(wide.positions, wide.triangles));
    const ended = [];
    const all = [];
    const epsilons = Array.from({ length: 60 }, (_, k) => 0.2 + 0.01 * k);
    for (const epsilon of epsilons) {
      const call = smoother.tikhonov(wideValues, { epsilon, latest: true });
      all.push(outcomeOf(call.then((found) => ended.push([epsilon, found]))));
      await pause(1000 / 60);
    }
    await Promise.all(all);
    const expected = local.tikhonov(wideValues, { epsilon: epsilons.at(-1) });
    expect(ended.length).toBeLessThan(4);
    expect(ended.at(-1)[0]).toBe(epsilons.at(-1));
    expect(same(ended.at(-1)[1], expected)).toBe(true);
    for (const object of [smoother, mesh]) object.free();
  });

  it('`latest` takes the place of its like alone', async () => {
    const other = await remote.createMesh(shape.positions, shape.triangles);
    const all = [
      mesh.persistence(values),
      mesh.persistence(values, { latest: true }),
      other.persistence(values, { latest: true }),
      mesh.basins(values, { latest: true }),
      mesh.persistence(values, { latest: true }),
    ];
    const outcomes = await Promise.all(all.map(outcomeOf));
    expect(outcomes.map(({ reason }) => reason?.name)).toEqual([undefined, 'AbortError', undefined, undefined, undefined]); // prettier-ignore
    expect(same(outcomes[4].value, outcomes[0].value)).toBe(true);
    other.free();
  });

  it('`latest` takes the place of a call that runs and cannot be asked, unless it is over soon', async () => {
    const scene = await remote.createScene(shape.positions, shape.triangles);
    // The module of the pictures is there, and a small picture is drawn soon.
    const small = { width: 40, height: 30, levels: [], criticalPoints: false };
    const first = await scene.snapshot(values, { ...small, latest: true });
    const large = { ...small, width: 3000, height: 2000 };
    const slow = settled(scene.snapshot(values, { ...large, latest: true }));
    await pause(100);
    const start = performance.now();
    const next = scene.snapshot(values, { ...small, latest: true });
    const { reason, time } = await slow;
    expect(reason?.name).toBe('AbortError');
    expect(time).toBeLessThan(AT_ONCE + 400);
    expect(same(await next, first)).toBe(true);
    // It took the place of one that would have gone on for longer.
    const taken = performance.now() - start;
    const whole = await settled(scene.snapshot(values, large));
    expect(whole.value.length).toBeGreaterThan(first.length);
    expect(taken).toBeLessThan(whole.time);
    const quick = [1, 2].map(() => outcomeOf(scene.surface({ latest: true })));
    await pause(10);
    quick.push(outcomeOf(scene.surface({ latest: true })));
    const [, , last] = await Promise.all(quick);
    expect(last.reason).toBe(undefined);
    scene.free();
  });

  it('objects are as they were, also a family that has grown', async () => {
    const options = { tolerance: 1e-9, factorizations: 1, epsilonRange: [0.1, 1] };
    const { positions, triangles } = square(40);
    const field = Float64Array.from({ length: 41 * 41 }, random(8));
    const here = new Smoother(new TriMesh(positions, triangles)).family(field, options);
    const there = await remote.createMesh(positions, triangles);
    const small = await remote.createSmoother(there);
    const family = await small.family(field, options);
    here.grow();
    await family.grow();
    there.free();
    small.free();
    // What cannot be asked while it runs ends the worker.
    const controller = new AbortController();
    const { promise, isTold } = begun((onProgress) => smoother.tikhonov(values, { epsilon: 7, onProgress, signal: controller.signal })); // prettier-ignore
    await isTold;
    controller.abort();
    expect((await settled(promise)).reason.name).toBe('AbortError');
    expect(same(await family.values(0.3), here.values(0.3))).toBe(true);
    expect([family.factorizations, family.complete]).toEqual([here.factorizations, here.complete]);
    family.free();
  });
});
