// The public names of `morse-smooth/files`, the same in both entries.
export { MorseSmoothError } from '../../runtime/error.js';
export { formats, readField, readMesh, readTable, writeMesh } from './files.js';
