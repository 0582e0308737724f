// One instance of the module for `import` and `require`.
import api from './snapshot-node.cjs';

export default api.default;
export const { MorseSmoothError, Scene, sheet, snapshot } = api;
