import { loaderOf } from '../init.js';
import { instance } from './instance.js';

export { MorseSmoothError, Scene, sheet, snapshot } from './api.js';

const initFrom = loaderOf(instance);

/** Loads the wasm file that lies beside this one: bundlers find it by this very expression. */
export default function init(options) {
  return initFrom(() => new URL('./morse_smooth_snapshot_bg.wasm', import.meta.url), options);
}
