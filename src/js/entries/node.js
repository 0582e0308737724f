// The entry for Node: `require` gets this bundled, `import` gets it through node.mjs.
import { core } from '../api/core/module.js';
import { startFrom } from '../runtime/load-node.js';

export * from '../api/core/index.js';
export default startFrom('morse_smooth_bg.wasm', core);
