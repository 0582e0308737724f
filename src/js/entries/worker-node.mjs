// One module for `import` and `require`.
import api from './worker-node.cjs';

export const { MorseSmoothError, connect } = api;
