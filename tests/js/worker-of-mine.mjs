// A worker as users write one: it serves connections and does things of its own.
import 'morse-smooth/worker-script';

const node = globalThis.process?.versions?.node === undefined ? null : await import('node:worker_threads');
const post = (message) => (node ? node.parentPort.postMessage(message) : globalThis.postMessage(message));

function receive(message) {
  if (message === 'exit') process.exit(3);
  if (message === 'throw') setTimeout(() => JSON.parse('{'), 0);
  if (message === 'exhaust') for (const all = []; ;) all.push(new Array(1000).fill({}));
  if (message === 'ping') post('pong');
}

if (node) node.parentPort.on('message', receive);
else globalThis.addEventListener('message', ({ data }) => receive(data));
