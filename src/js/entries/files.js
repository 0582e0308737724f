// The entry `morse-smooth/files` for browsers.
import { files } from '../api/files/module.js';
import { loaderOf } from '../runtime/load.js';

export { MorseSmoothError, formats, readField, readMesh, readTable, writeMesh } from '../api/files/index.js';

const initFrom = loaderOf(files);

/** Loads the wasm file that lies beside this one: bundlers find it by this very expression. */
export default function init(options) {
  return initFrom(() => new URL('./morse_smooth_files_bg.wasm', import.meta.url), options);
}
