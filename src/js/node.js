import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { sourceOf } from './init.js';
import { startSync } from './instance.js';

export * from './api.js';

startSync(new WebAssembly.Module(readFileSync(join(__dirname, 'morse_smooth_bg.wasm'))));

const loaded = Promise.resolve();

/** The module runs since the import; the options are checked all the same, so that one code serves both worlds. */
export default function init(options) {
  try {
    sourceOf(options);
  } catch (error) {
    return Promise.reject(error);
  }
  return loaded;
}
