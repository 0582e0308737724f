// The entry `morse-smooth/snapshot` for browsers.
import { pictures } from '../api/snapshot/module.js';
import { loaderOf } from '../runtime/load.js';

export { MorseSmoothError, Scene, sheet, snapshot } from '../api/snapshot/index.js';

const initFrom = loaderOf(pictures);

/** Loads the wasm file that lies beside this one: bundlers find it by this very expression. */
export default function init(options) {
  return initFrom(() => new URL('./morse_smooth_snapshot_bg.wasm', import.meta.url), options);
}
