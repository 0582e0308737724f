// The entry with the WebAssembly module in a script.
import { initFrom } from './core.js';
import base64 from './wasm-base64.js';

export { MorseSmoothError, Smoother, SmoothingFamily, TriMesh, smooth, version } from './core.js';

/** Takes the wasm module from the script itself: nothing is fetched. */
export default function init(options) {
  return initFrom(() => Uint8Array.from(atob(base64), (character) => character.charCodeAt(0)), options);
}
