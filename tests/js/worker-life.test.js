// How workers begin and end.
import init, { TriMesh } from 'morse-smooth';
import { connect } from 'morse-smooth/worker';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectRejection } from './errors.js';
import { random, square } from './meshes.js';
import { same } from './same.js';

const inNode = typeof process === 'object' && process.versions?.node !== undefined;
const { positions, triangles } = square(40);
const values = Float64Array.from({ length: 41 * 41 }, random(5));

let expected;
let made;
beforeAll(async () => {
  await init();
  expected = new TriMesh(positions, triangles).persistence(values);
  const script = new URL('./worker-of-mine.mjs', import.meta.url);
  const { Worker: OwnWorker } = inNode ? await import('node:worker_threads') : globalThis;
  made = (options) => new OwnWorker(script, { type: 'module', ...options });
});

const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));
const answerOf = (worker) =>
  new Promise((resolve) => {
    if (inNode) worker.once('message', resolve);
    else worker.addEventListener('message', ({ data }) => resolve(data), { once: true });
    worker.postMessage('ping');
  });

async function works(remote) {
  const mesh = await remote.createMesh(positions, triangles);
  expect(same(await mesh.persistence(values), expected)).toBe(true);
  return mesh;
}

describe('a worker of the caller', () => {
  it('serves one connection after the other, several at a time, and stays', async () => {
    const worker = made();
    const [one, two] = [await connect({ worker }), await connect({ worker })];
    const mesh = await works(one);
    await works(two);
    one.close();
    await expectRejection(mesh.persistence(values), 'ConnectionClosed');
    await works(two);
    two.close();
    expect(await answerOf(worker)).toBe('pong');
    const three = await connect({ worker });
    await works(three);
    three.close();
    worker.terminate();
  });

  it('stops calls without ending', async () => {
    const worker = made();
    const remote = await connect({ worker });
    const mesh = await works(remote);
    const smoother = await remote.createSmoother(mesh);
    const controller = new AbortController();
    const call = smoother.prescribe(values, { epsilon: 1e-3, signal: controller.signal });
    await pause(20);
    controller.abort();
    const { reason } = await call.then(
      () => ({}),
      (reason) => ({ reason }),
    );
    if (reason) expect(reason.name).toBe('AbortError');
    expect(same(await mesh.persistence(values), expected)).toBe(true);
    expect(await answerOf(worker)).toBe('pong');
    remote.close();
    worker.terminate();
  });

  it('made by a function is ended', async () => {
    let ended = 0;
    const worker = () => {
      const own = made();
      const terminate = own.terminate.bind(own);
      own.terminate = () => {
        ended++;
        return terminate();
      };
      return own;
    };
    const remote = await connect({ worker, workers: 2 });
    const mesh = await works(remote);
    await Promise.all([mesh.persistence(values), mesh.basins(values), mesh.morseComplex(values)]);
    remote.close();
    expect(ended).toBeGreaterThan(0);
    const before = ended;
    for (let time = 1; time <= 20; time++) {
      const remote = await connect({ worker });
      if (time % 5 === 0) await works(remote);
      remote.close();
      expect(ended).toBe(before + time);
    }
  });

  it('goes on after an error of its own in a browser', async () => {
    if (inNode) return;
    const worker = made();
    const remote = await connect({ worker });
    const mesh = await works(remote);
    worker.addEventListener('error', (event) => event.preventDefault());
    worker.postMessage('throw');
    await pause(50);
    expect(same(await mesh.persistence(values), expected)).toBe(true);
    remote.close();
    worker.terminate();
  });

  it('that is none is told', async () => {
    const missing = () => {
      throw new RangeError('no worker today');
    };
    await expectRejection(connect({ worker: missing }), 'LoadFailed', { reason: 'no worker today' });
    if (!inNode) return;
    const { Worker } = await import('node:worker_threads');
    const nowhere = () => new Worker(new URL('./no-such-worker.mjs', import.meta.url));
    await expectRejection(connect({ worker: nowhere }), 'LoadFailed', { reason: expect.stringContaining('no-such') });
  });
});

describe('the end', () => {
  it('comes with the signal of the connection', async () => {
    const controller = new AbortController();
    const remote = await connect({ signal: controller.signal });
    const mesh = await works(remote);
    const running = mesh.persistence(values);
    controller.abort(new RangeError('enough'));
    await expect(running).rejects.toBe(controller.signal.reason);
    await expect(mesh.persistence(values)).rejects.toBe(controller.signal.reason);
    const early = new AbortController();
    const connecting = connect({ signal: early.signal });
    early.abort();
    await expect(connecting).rejects.toBe(early.signal.reason);
  });
});

describe.runIf(inNode)('in Node', () => {
  /** The threads that the operating system knows of; null where it cannot be asked so. */
  const threads = async () => {
    const { existsSync, readdirSync } = await import('node:fs');
    return existsSync('/proc/self/task') ? readdirSync('/proc/self/task').length : null;
  };

  it('1,000 connections leave no worker', async () => {
    const before = await threads();
    for (let round = 0; round < 250; round++) {
      const all = Array.from({ length: 4 }, async (_, k) => {
        const remote = await connect();
        if (k === 0 && round % 5 === 0) await works(remote);
        remote.close();
      });
      await Promise.all(all);
    }
    for (let time = 0; time < 100 && (await threads()) > before; time++) await pause(50);
    expect(await threads()).toBeLessThanOrEqual(before ?? 0);
  }, 300_000);

  it('a worker that dies fails its call, and the next one has another', async () => {
    const workers = [];
    const worker = () => {
      workers.push(made());
      return workers.at(-1);
    };
    const remote = await connect({ worker });
    const mesh = await works(remote);
    const smoother = await remote.createSmoother(mesh);
    const first = await smoother.tikhonov(values, { epsilon: 0.1 });
    // Between two calls.
    workers[0].postMessage('exit');
    await new Promise((resolve) => workers[0].once('exit', resolve));
    expect(same(await smoother.tikhonov(values, { epsilon: 0.1 }), first)).toBe(true);
    expect(workers.length).toBe(2);
    // During a call, and with others behind it.
    const call = smoother.prescribe(values, { epsilon: 1e-4, onProgress: () => void workers[1].terminate() });
    const next = mesh.persistence(values);
    await expectRejection(call, 'WorkerLost', { reason: expect.stringContaining('exited') });
    expect(same(await next, expected)).toBe(true);
    expect(workers.length).toBe(3);
    remote.close();
  });

  it('a worker that was handed over takes the connection with it', async () => {
    const worker = made();
    const remote = await connect({ worker });
    const mesh = await works(remote);
    const smoother = await remote.createSmoother(mesh);
    const call = smoother.prescribe(values, { epsilon: 1e-4, onProgress: () => void worker.terminate() });
    const next = mesh.basins(values);
    await Promise.all([call, next].map((promise) => expectRejection(promise, 'WorkerLost')));
    await expectRejection(mesh.persistence(values), 'WorkerLost');
    remote.close();
  });

  it('a worker that is out of memory is one that dies', async () => {
    const workers = [];
    const worker = () => {
      workers.push(made({ resourceLimits: { maxOldGenerationSizeMb: 24 } }));
      return workers.at(-1);
    };
    const remote = await connect({ worker });
    const mesh = await works(remote);
    workers[0].postMessage('exhaust');
    await pause(5);
    await expectRejection(mesh.persistence(values), 'WorkerLost', { reason: expect.stringContaining('memory') });
    expect(same(await mesh.persistence(values), expected)).toBe(true);
    remote.close();
  });

  it('a program ends although a connection is open', async () => {
    const { execFileSync } = await import('node:child_process');
    const script = `
      import { connect } from 'morse-smooth/worker';
      const remote = await connect();
      const mesh = await remote.createMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
      console.log((await mesh.criticalPoints([1, 2, 3])).counts.maxima);`;
    const root = new URL('../..', import.meta.url);
    const options = { cwd: root, encoding: 'utf8', timeout: 30_000 };
    expect(execFileSync(process.execPath, ['--input-type=module', '-e', script], options)).toBe('1\n');
    const required = `require('morse-smooth/worker').connect().then((remote) => remote.formats()).then(({ length }) => console.log(length));`;
    const { formats } = await import('morse-smooth/files');
    const printed = execFileSync(process.execPath, ['--input-type=commonjs', '-e', required], options);
    expect(printed).toBe(`${formats().length}\n`);
  });

  it('forgotten objects are freed', async () => {
    const { execFileSync } = await import('node:child_process');
    // Each mesh takes some megabytes of the worker's 64, so that few fit at once.
    const script = `
      import { readFileSync } from 'node:fs';
      import { connect } from 'morse-smooth/worker';
      import { square, random } from './tests/js/meshes.js';
      import { withPages } from './tests/js/wasm-bytes.js';
      const core = withPages(new Uint8Array(readFileSync('dist/morse_smooth_bg.wasm')), 1024);
      const remote = await connect({ wasm: { core } });
      const { positions, triangles } = square(60);
      const values = Float64Array.from({ length: 61 * 61 }, random(2));
      const collect = () => new Promise((resolve) => setTimeout(() => (gc(), setTimeout(resolve, 5)), 5));
      for (let time = 0; time < 120; time++) {
        const mesh = await remote.createMesh(positions, triangles);
        await (await remote.createSmoother(mesh)).lowPass(values, { iterations: 1 });
        if (time % 4 === 0) await collect();
      }
      console.log('120 meshes');`;
    const options = { cwd: new URL('../..', import.meta.url), encoding: 'utf8', timeout: 50_000 };
    const given = ['--expose-gc', '--input-type=module', '-e', script];
    expect(execFileSync(process.execPath, given, options)).toBe('120 meshes\n');
  });

  it('needs no file beside its scripts', async () => {
    const { copyFileSync, mkdtempSync, rmSync } = await import('node:fs');
    const { tmpdir } = await import('node:os');
    const { join } = await import('node:path');
    const { pathToFileURL } = await import('node:url');
    const folder = mkdtempSync(join(tmpdir(), 'morse-smooth-worker-'));
    try {
      const embedded = ['core', 'files', 'snapshot', 'worker-node'].map((name) => `${name}-embedded.cjs`);
      const names = ['worker-node.cjs', 'error.cjs', ...embedded];
      for (const name of names) copyFileSync(new URL(`../../dist/${name}`, import.meta.url), join(folder, name));
      const script = pathToFileURL(join(folder, 'worker-node.cjs')).href;
      const { default: moved } = await import(/* @vite-ignore */ script);
      const remote = await moved.connect();
      const mesh = await works(remote);
      expect(mesh.vertexCount).toBe(41 * 41);
      remote.close();
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  });
});
