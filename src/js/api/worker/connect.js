import { isRecord } from '../../runtime/convert.js';
import { MorseSmoothError, invalidArgument, invalidOption } from '../../runtime/error.js';
import { Codes } from './codes.js';
import { Connection } from './connection.js';
import { isSignal, unknownOption } from './options.js';
import { functions } from './table.js';

const OPTIONS = ['worker', 'workers', 'wasm', 'signal'];
const MODULES = ['core', 'files', 'snapshot'];
const MOST_WORKERS = 64;

/** `connect` for a platform: how workers are made there, watched and ended, and where the code of the modules is. */
export function connectorOf(platform) {
  return async function connect(options = {}) {
    const { worker, workers = 1, wasm = {}, signal } = checked(options);
    if (signal?.aborted) throw signal.reason;
    const connection = new Connection(hostOf(platform, worker), new Codes(platform.sources, wasm), workers);
    const abort = () => connection.close(signal.reason);
    signal?.addEventListener('abort', abort);
    const close = () => {
      signal?.removeEventListener('abort', abort);
      connection.close();
    };
    try {
      await (signal ? Promise.race([connection.open(), untilAborted(signal)]) : connection.open());
    } catch (error) {
      close();
      throw error;
    }
    return remoteOf(connection, close);
  };
}

function checked(options) {
  if (!isRecord(options)) throw invalidArgument('options', 'a plain object');
  const unknown = Object.keys(options).find((name) => !OPTIONS.includes(name));
  if (unknown !== undefined) throw unknownOption(unknown);
  const { worker, workers, wasm, signal } = options;
  if (!isSignal(signal)) throw invalidOption('signal', 'an AbortSignal');
  const isWorker = typeof worker === 'function' || typeof worker?.postMessage === 'function';
  if (worker !== undefined && !isWorker) throw invalidOption('worker', 'a Worker, or a function that makes one');
  const isCount = Number.isInteger(workers) && workers >= 1 && workers <= MOST_WORKERS;
  if (workers !== undefined && !isCount) throw invalidOption('workers', `a whole number from 1 to ${MOST_WORKERS}`);
  if (workers > 1 && worker !== undefined && typeof worker !== 'function') {
    const message = 'option `workers` does not go with one Worker; hand over a function that makes them';
    throw new MorseSmoothError('InapplicableOption', message, { option: 'workers' });
  }
  if (wasm !== undefined && !isRecord(wasm)) throw invalidOption('wasm', 'a plain object');
  const other = Object.keys(wasm ?? {}).find((name) => !MODULES.includes(name));
  if (other !== undefined) throw unknownOption(`wasm.${other}`);
  return options;
}

/** How the workers of one connection are made: by the caller, who then may keep the only one. */
function hostOf({ makers, channel, watch, hold, end }, worker) {
  const shared = { channel, watch, hold, end };
  if (worker === undefined) return { ...shared, makers, isOwner: true, isOurs: true };
  const isOwner = typeof worker === 'function';
  return { ...shared, makers: [isOwner ? worker : () => worker], isOwner, isOurs: false };
}

function remoteOf(connection, close) {
  const remote = { close };
  for (const name of Object.keys(functions)) {
    remote[name] = (...given) => connection.call(null, null, name, given);
  }
  if (Symbol.dispose) remote[Symbol.dispose] = close;
  return remote;
}

const untilAborted = (signal) =>
  new Promise((_, reject) => signal.addEventListener('abort', () => reject(signal.reason), { once: true }));
