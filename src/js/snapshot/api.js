// The public names, the same in both entries.
export { MorseSmoothError } from '../error.js';
export { Scene, sheet, snapshot } from './scene.js';
