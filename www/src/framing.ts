/** How near the camera goes. The pictures of `morse-smooth/snapshot` (src/render/camera.rs) frame a mesh in the same way. */
import { Vector3 } from 'three';
import type { Matrix4, PerspectiveCamera } from 'three';

/** Tangent of half the angle that is seen of the shorter side: 15°. */
const TANGENT = Math.tan(Math.PI / 12);
/** Room around every point for solids on the rim, and around all of it for the eye. */
const PAD = 0.05;
const MARGIN = 1.03;

/** Of half the angles that are seen, sideways and upwards. */
const tangents = (aspect: number): [number, number] => [TANGENT * Math.max(1, aspect), TANGENT / Math.min(1, aspect)];

/** Degrees that are seen from bottom to top. */
export const fieldOfView = (aspect: number): number => (360 / Math.PI) * Math.atan(tangents(aspect)[1]);

/**
 * Moves a camera that looks along its own z axis at the points: all of them are in sight, as near as they fit, with their picture in
 * the middle. Returns the place to turn about. `model` takes the points to where they are.
 */
export function frame(camera: PerspectiveCamera, positions: Float32Array, model: Matrix4): Vector3 {
  if (positions.length === 0) return new Vector3();
  camera.updateMatrixWorld();
  const turn = camera.matrixWorldInverse.clone().setPosition(0, 0, 0).multiply(model);
  const [tangentX, tangentY] = tangents(camera.aspect);
  // A ball of radius r around (x, y, z) is inside the right edge of a camera at (a, b, d) if x + z·tan + r·√(1 + tan²) ≤ a + d·tan;
  // likewise the other edges.
  let [right, left, top, bottom] = [-Infinity, -Infinity, -Infinity, -Infinity];
  const point = new Vector3();
  for (let i = 0; i < positions.length; i += 3) {
    const { x, y, z } = point.fromArray(positions, i).applyMatrix4(turn);
    right = Math.max(right, z * tangentX + x);
    left = Math.max(left, z * tangentX - x);
    top = Math.max(top, z * tangentY + y);
    bottom = Math.max(bottom, z * tangentY - y);
  }
  const distances = [
    (right + left) / (2 * tangentX) + PAD * Math.hypot(1, 1 / tangentX),
    (top + bottom) / (2 * tangentY) + PAD * Math.hypot(1, 1 / tangentY),
  ];
  const distance = MARGIN * Math.max(...distances, 0.1);
  const middle = new Vector3((right - left) / 2, (top - bottom) / 2, 0).applyQuaternion(camera.quaternion);
  camera.position.set(0, 0, distance).applyQuaternion(camera.quaternion).add(middle);
  return middle;
}
