// One instance of the module for `import` and `require`.
import api from './files-node.cjs';

export default api.default;
export const { MorseSmoothError, formats, readField, readMesh, readTable, writeMesh } = api;
