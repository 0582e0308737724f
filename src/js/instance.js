import * as glue from '../../pkg/morse_smooth.js';
import { MorseSmoothError } from './error.js';

let started = false;

/** The wasm module's functions, once it runs. */
export function core() {
  if (!started) {
    throw new MorseSmoothError('NotInitialized', 'call `await init()` once before anything else');
  }
  return glue;
}

/** Starts the compiled module. */
export async function start(module) {
  refuseForeign(module);
  await glue.default({ module_or_path: module });
  started = true;
}

/** The same at once, for Node, where it may block. */
export function startSync(module) {
  glue.initSync({ module });
  started = true;
}

/** The glue would keep the first module it is given, right or wrong. */
function refuseForeign(module) {
  const names = WebAssembly.Module.exports(module).map((entry) => entry.name);
  if (!names.includes('rawtrimesh_new')) throw new Error('it is not the module of this package');
}
