// The public names of `morse-smooth`, the same in every entry.
import { makeDisposable } from '../../runtime/handles.js';
import { Smoother } from './smoother.js';
import { SmoothingFamily } from './family.js';
import { TriMesh } from './mesh.js';

export { MorseSmoothError } from '../../runtime/error.js';
export { TriMesh } from './mesh.js';
export { Smoother, smooth } from './smoother.js';
export { SmoothingFamily } from './family.js';

/** The package's version, which the build puts in. */
export const version = __VERSION__;

makeDisposable(TriMesh, Smoother, SmoothingFamily);
