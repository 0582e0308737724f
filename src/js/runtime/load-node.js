// For Node only.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { sourceOf } from './load.js';

/** Starts a module from the file of that name beside the script, and returns the `init` of its entry. */
export function startFrom(file, module) {
  module.startSync(new WebAssembly.Module(readFileSync(join(__dirname, file))));
  const loaded = Promise.resolve();

  /** The module runs since the import; the options are checked all the same, so that one code serves both worlds. */
  return function init(options) {
    try {
      sourceOf(options);
    } catch (error) {
      return Promise.reject(error);
    }
    return loaded;
  };
}
