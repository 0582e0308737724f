// One instance of the module for `import` and `require`.
import api from './node.cjs';

export default api.default;
export const { MorseSmoothError, Smoother, SmoothingFamily, TriMesh, readField, readMesh, smooth, version, writeMesh } = api;
