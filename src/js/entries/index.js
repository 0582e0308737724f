// The entry for browsers and bundlers.
import { initFrom } from './core.js';

export { MorseSmoothError, Smoother, SmoothingFamily, TriMesh, smooth, version } from './core.js';

/** Loads the wasm file that lies beside this one: bundlers find it by this very expression. */
export default function init(options) {
  return initFrom(() => new URL('./morse_smooth_bg.wasm', import.meta.url), options);
}
