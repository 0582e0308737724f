// The public names of `morse-smooth/three`.
export { MorseSmoothError } from '../../runtime/error.js';
export { arraysOf, geometryOf, meshOf } from './geometry.js';
export { fieldAttribute, fieldValues } from './fields.js';
export { colorAttribute, colorTexture, shadeAttribute } from './colors.js';
export { fillLines, levelLines, segmentsOf } from './lines.js';
export { criticalMarkers, criticalPoints } from './points.js';
export { pick } from './pick.js';
