// The entry `morse-smooth/worker` for Node: `require` gets this bundled, `import` gets it through worker-node.mjs.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Worker } from 'node:worker_threads';
import { connectorOf } from '../api/worker/connect.js';

export { MorseSmoothError } from '../runtime/error.js';

const read = (name) => readFileSync(join(__dirname, name));

export const connect = connectorOf({
  // Where a bundler has moved this script away from its files, what is embedded serves.
  makers: [
    () => new Worker(join(__dirname, 'worker-script-node.cjs')),
    async () => new Worker((await import('./worker-embedded-node.cjs')).default, { eval: true }),
  ],
  sources: {
    core: [
      () => read('morse_smooth_bg.wasm'),
      async () => Buffer.from((await import('./wasm-base64.js')).default, 'base64'),
    ],
    files: [() => read('morse_smooth_files_bg.wasm')],
    snapshot: [() => read('morse_smooth_snapshot_bg.wasm')],
  },
  watch(worker, onEnd) {
    const onError = (error) => onEnd(String(error?.message ?? error), true);
    const onExit = (code) => onEnd(`it exited with code ${code}`, true);
    worker.on('error', onError);
    worker.on('exit', onExit);
    return () => {
      worker.off('exit', onExit);
      worker.off('error', onError);
    };
  },
  hold: (worker, isHeld) => (isHeld ? worker.ref() : worker.unref()),
  end(worker) {
    // Whatever still goes wrong while it ends is nobody's.
    worker.on('error', () => {});
    worker.terminate();
  },
});
