// The entry `morse-smooth/files` for Node: `require` gets this bundled, `import` gets it through files-node.mjs.
import { files } from '../api/files/module.js';
import { startFrom } from '../runtime/load-node.js';

export * from '../api/files/index.js';
export default startFrom('morse_smooth_files_bg.wasm', files);
