// For Node only.
import { Buffer } from 'node:buffer';
import { TextDecoder, TextEncoder } from 'node:util';
import { inflateSync } from 'node:zlib';
import { sourceOf } from './load.js';

/**
 * Lets a module start when it is first needed, and returns the `init` of its entry.
 *
 * The code comes out of the script: no file has to be found, whoever bundles the script and wherever to, or may be read. The classes
 * for text are Node's own: a test environment that plays a browser may have none.
 */
export function onDemand(module, packed) {
  module.onDemand(() => unpacked(packed), { TextDecoder, TextEncoder });
  let loaded = null;

  /** `options.wasm` is for browsers; the options are checked all the same, so that one code serves both worlds. */
  return function init(options) {
    try {
      sourceOf(options);
      void module.instance;
    } catch (error) {
      return Promise.reject(error);
    }
    return (loaded ??= Promise.resolve());
  };
}

/** The code from its text in a script. */
export function unpacked(packed) {
  return new WebAssembly.Module(inflateSync(Buffer.from(packed, 'base64')));
}
