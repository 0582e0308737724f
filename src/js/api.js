// The public names, the same in every entry.
import { makeDisposable } from './handle.js';
import { Smoother } from './smoother.js';
import { TriMesh } from './mesh.js';

export { MorseSmoothError } from './error.js';
export { readField, readMesh, writeMesh } from './files.js';
export { TriMesh } from './mesh.js';
export { Smoother, smooth } from './smoother.js';

/** Of the package; the build puts it in. */
export const version = __VERSION__;

makeDisposable(TriMesh, Smoother);
