import { Triangle, Vector3 } from 'three';
import { isRecord } from '../../runtime/convert.js';
import { MorseSmoothError, invalidArgument } from '../../runtime/error.js';
import { readable } from './attributes.js';
import { fieldOn, isGiven, toMap } from './options.js';

export function pick(intersection, vertexMap, values) {
  const { face, object, point } = isRecord(intersection) ? intersection : {};
  if (!face || !object?.isMesh || !point?.isVector3) {
    throw invalidArgument('intersection', 'what a Raycaster found on a Mesh; signs at critical points have the vertices in their `userData`'); // prettier-ignore
  }
  const corners = [face.a, face.b, face.c];
  const position = readable(object.geometry.getAttribute('position'), 'position');
  const places = corners.map((corner) => new Vector3().fromBufferAttribute(position, corner));
  const weights = weightsOf(intersection, places);
  const at = new Vector3();
  places.forEach((place, k) => at.addScaledVector(place, weights[k]));
  const field = isGiven(values) ? fieldOn(values, vertexMap) : null;
  const map = field ? field.map : toMap(vertexMap);
  const count = field ? field.count : (map?.length ?? Infinity);
  const beyond = corners.find((corner) => corner >= count);
  if (beyond !== undefined) {
    const message = `the triangle has vertex ${beyond}, but the field is on a geometry of ${count} vertices: it is another one`;
    throw new MorseSmoothError('LengthMismatch', message, { expected: beyond + 1, actual: count });
  }
  const vertices = corners.map((corner) => (map ? map[corner] : corner));
  const distances = places.map((place) => place.distanceTo(at));
  const vertex = vertices[distances.indexOf(Math.min(...distances))];
  // Where a weight is 0, a missing value does not count.
  const value = field && weights.reduce((sum, w, k) => (w === 0 ? sum : sum + w * field.numbers[vertices[k]]), 0);
  return { vertex, vertices, weights, value };
}

/** How much each corner counts at the place that was hit. What moves corners (bones, say) is in what three.js says, if it says it. */
function weightsOf({ barycoord, object, point, instanceId }, places) {
  const found = barycoord ?? Triangle.getBarycoord(localPoint(object, point, instanceId), ...places, new Vector3());
  // A triangle without area: all of it is where its corners are.
  return found ? [found.x, found.y, found.z] : [1, 0, 0];
}

function localPoint(object, point, instanceId) {
  const place = object.worldToLocal(point.clone());
  if (!isGiven(instanceId) || !object.isInstancedMesh) return place;
  const matrix = object.matrixWorld.clone();
  object.getMatrixAt(instanceId, matrix);
  return place.applyMatrix4(matrix.invert());
}
