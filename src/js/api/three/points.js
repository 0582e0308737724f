// Signs at critical points.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
  SphereGeometry,
} from 'three';
import { kinds as KINDS } from 'looks:';
import { isRecord, toNumbers, toVertices } from '../../runtime/convert.js';
import { invalidArgument, invalidOption } from '../../runtime/error.js';
import { isGiven, optionsOf } from './options.js';

/** Of the diagonal of the mesh's box. */
const RADIUS = 0.012;
const PIXELS = 9;
/** A ball that looks round at the size of a sign. */
const ROUND = [1, 20, 14];

export function criticalPoints(found, positions, options) {
  const { colors, size = PIXELS, material } = optionsOf('criticalPoints', options);
  if (typeof size !== 'number' || !(size > 0)) throw invalidOption('size', 'pixels, more than 0');
  const { vertices, kinds, places } = placed(found, positions);
  const colorOf = paletteOf(colors);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(places), 3));
  const painted = Float32Array.from(Array.from(kinds, colorOf).flatMap((color) => color.toArray()));
  geometry.setAttribute('color', new BufferAttribute(painted, 3));
  const own = { size, sizeAttenuation: false, vertexColors: true };
  const points = new Points(geometry, material ?? new PointsMaterial(own));
  Object.assign(points.userData, { vertices, kinds });
  return points;
}

export function criticalMarkers(found, positions, options) {
  const { colors, radius, geometry, material } = optionsOf('criticalMarkers', options);
  if (isGiven(radius) && !(typeof radius === 'number' && radius > 0)) throw invalidOption('radius', 'a length above 0');
  const { vertices, kinds, places, diagonal } = placed(found, positions);
  const size = radius ?? (RADIUS * diagonal || 1);
  const colorOf = paletteOf(colors);
  const shape = geometry ?? new SphereGeometry(...ROUND);
  const markers = new InstancedMesh(shape, material ?? new MeshBasicMaterial(), vertices.length);
  const matrix = new Matrix4().makeScale(size, size, size);
  vertices.forEach((_, k) => {
    markers.setMatrixAt(k, matrix.setPosition(...places.subarray(3 * k, 3 * k + 3)));
    markers.setColorAt(k, colorOf(kinds[k]));
  });
  Object.assign(markers.userData, { vertices, kinds });
  return markers;
}

/** Critical points with where they are, and the diagonal of the mesh's box. */
function placed(found, positions) {
  if (!isRecord(found))
    throw invalidArgument('found', 'an object with `vertices` and `kinds`, as `criticalPoints` gives it');
  const numbers = toNumbers(positions, 'positions');
  const count = Math.floor(numbers.length / 3);
  const vertices = Uint32Array.from(toVertices(found.vertices, 'found.vertices', count));
  const beyond = vertices.findIndex((vertex) => vertex >= count);
  if (beyond >= 0) {
    throw invalidArgument('positions', `x, y and z of each of the mesh's vertices, but there is none of vertex ${vertices[beyond]}`); // prettier-ignore
  }
  const kinds = Int8Array.from(toNumbers(found.kinds, 'found.kinds'));
  if (kinds.length !== vertices.length || kinds.some((kind) => kind < -1 || kind > 1)) {
    throw invalidArgument('found.kinds', '−1, 0 or 1 for each of the vertices');
  }
  const places = new Float64Array(3 * vertices.length);
  vertices.forEach((vertex, k) => places.set(numbers.subarray(3 * vertex, 3 * vertex + 3), 3 * k));
  return { vertices, kinds, places, diagonal: diagonalOf(numbers) };
}

function diagonalOf(positions) {
  const low = [Infinity, Infinity, Infinity];
  const high = low.map((x) => -x);
  positions.forEach((x, k) => {
    low[k % 3] = Math.min(low[k % 3], x);
    high[k % 3] = Math.max(high[k % 3], x);
  });
  return positions.length > 0 ? Math.hypot(...high.map((x, axis) => x - low[axis])) : 0;
}

/** A function from a kind, −1, 0 or 1, to its color. */
function paletteOf(colors = KINDS) {
  if (!Array.isArray(colors) || colors.length !== 3) {
    throw invalidOption('colors', 'three colors, of minima, saddles and maxima');
  }
  const palette = colors.map((color) => new Color(color));
  return (kind) => palette[kind + 1];
}
