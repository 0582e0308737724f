// The entry `morse-smooth/snapshot` for Node: `require` gets this bundled, `import` gets it through snapshot-node.mjs.
import { pictures } from '../api/snapshot/module.js';
import { startFrom } from '../runtime/load-node.js';

export * from '../api/snapshot/index.js';
export default startFrom('morse_smooth_snapshot_bg.wasm', pictures);
