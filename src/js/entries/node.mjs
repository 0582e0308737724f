// One instance of the module for `import` and `require`.
import api from './node.cjs';

export default api.default;
export const { MorseSmoothError, Smoother, TriMesh, smooth, version } = api;
