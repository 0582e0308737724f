// The public names of `morse-smooth/snapshot`, the same in both entries.
export { MorseSmoothError } from '../../runtime/error.js';
export { Scene, sheet, snapshot } from './scene.js';
