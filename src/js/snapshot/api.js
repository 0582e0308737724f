// The public names, the same in both entries.
import { makeDisposable } from '../handle.js';
import { Scene } from './scene.js';

export { MorseSmoothError } from '../error.js';
export { Scene, sheet, snapshot } from './scene.js';

makeDisposable(Scene);
