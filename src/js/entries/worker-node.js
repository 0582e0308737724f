// The entry `morse-smooth/worker` for Node, bundled once for `import` and once for `require`. It needs no file: the worker's script and
// the modules come out of scripts, whoever bundles this and wherever to.
import { MessageChannel, Worker } from 'node:worker_threads';
import { packed as core } from 'embedded:core';
import { packed as files } from 'embedded:files';
import { packed as snapshot } from 'embedded:snapshot';
import { script } from 'embedded:worker-node';
import { connectorOf } from '../api/worker/connect.js';
import { unpacked } from '../runtime/load-node.js';

export { MorseSmoothError } from '../runtime/error.js';

export const connect = connectorOf({
  // Without the flags of the program, one of which may say that scripts are modules.
  makers: [() => new Worker(script, { eval: true, execArgv: [] })],
  // Not the global: what plays a browser in a test, such as jsdom, has none.
  channel: () => new MessageChannel(),
  sources: {
    core: (target) => target.start(unpacked(core)),
    files: (target) => target.start(unpacked(files)),
    snapshot: (target) => target.start(unpacked(snapshot)),
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
