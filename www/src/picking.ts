/** What lies under a click. */
import { Raycaster, Vector2, Vector3 } from 'three';
import type { Camera, Mesh, Object3D } from 'three';
import type { Places } from './places';

/** A pointer that moves more pixels between down and up turns the view and picks nothing. */
const STILL = 4;

export function listenToClicks(canvas: HTMLCanvasElement, use: (clientX: number, clientY: number) => void): void {
  let from: [number, number] | null = null;
  canvas.addEventListener('pointerdown', ({ button, isPrimary, clientX, clientY }) => {
    from = button === 0 && isPrimary ? [clientX, clientY] : null;
  });
  canvas.addEventListener('pointercancel', () => {
    from = null;
  });
  canvas.addEventListener('pointerup', ({ isPrimary, clientX, clientY }) => {
    if (isPrimary && from && Math.hypot(clientX - from[0], clientY - from[1]) <= STILL) use(clientX, clientY);
    from = null;
  });
}

/** Where the surface is hit, in coordinates of `model`, and the corners of the triangle there; null beside it. */
export function hitOf(
  surface: Mesh,
  model: Object3D,
  camera: Camera,
  canvas: HTMLCanvasElement,
  clientX: number,
  clientY: number,
): { place: Vector3; corners: number[] } | null {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height), camera);
  const hit = ray.intersectObject(surface, false)[0];
  if (!hit?.face) return null;
  const { a, b, c } = hit.face;
  return { place: model.worldToLocal(hit.point.clone()), corners: [a, b, c] };
}

/** Null where none is nearer than `reach`. */
export function nearestOf(vertices: Iterable<number>, places: Places, place: Vector3, reach: number): number | null {
  let best: number | null = null;
  let least = reach;
  for (const vertex of vertices) {
    if (!places.has(vertex)) continue;
    const distance = places.position(vertex).distanceTo(place);
    if (distance >= least) continue;
    least = distance;
    best = vertex;
  }
  return best;
}
