/**
 * Constrained vertices: a ring around each, dark within white, so that it stands out from any color of the surface and is
 * none of the solids that mark critical points. The vertices next to them are small dark squares, where there are not too many.
 */
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
  Quaternion,
  RingGeometry,
  TorusGeometry,
  Vector3,
} from 'three';
import type { Places } from './places';
import type { Found } from './protocol';

const DARK = 0x10151f;
const LIGHT = 0xffffff;
/** More rings are flat, and more stars are left out. */
const CROWD = 400;
const MOST_STARS = 6000;

export class RingLayer {
  readonly group = new Group();
  private readonly dark = new MeshBasicMaterial({ color: DARK, side: DoubleSide });
  private readonly light = new MeshBasicMaterial({ color: LIGHT, side: DoubleSide });
  private readonly squares = new PointsMaterial({
    color: DARK,
    size: 3.5,
    sizeAttenuation: false,
    transparent: true,
    opacity: 0.55,
  });
  private readonly fine = { inner: torus(0.15, 6, 32), outer: torus(0.25, 6, 32) };
  private readonly flat = { inner: new RingGeometry(0.84, 1.16, 12), outer: new RingGeometry(0.7, 1.3, 12) };

  clear(): void {
    for (const child of [...this.group.children]) {
      if (child instanceof InstancedMesh) child.dispose();
      if (child instanceof Points) (child.geometry as BufferGeometry).dispose();
    }
    this.group.clear();
  }

  /** `radius`: of the rings. */
  set(found: Found, places: Places, radius: number): void {
    this.clear();
    const features = found.features.filter((vertex) => places.has(vertex));
    const all = found.all.filter((vertex) => places.has(vertex));
    if (features.length === 0) return;
    const { inner, outer } = features.length > CROWD ? this.flat : this.fine;
    const rings = [new InstancedMesh(outer, this.light, features.length), new InstancedMesh(inner, this.dark, features.length)]; // prettier-ignore
    const across = new Vector3(0, 0, 1);
    const turn = new Quaternion();
    const matrix = new Matrix4();
    features.forEach((vertex, k) => {
      const axis = places.axis(vertex);
      turn.setFromUnitVectors(across, axis);
      // The dark ring lies a little higher, so that it is not inside the white one.
      rings.forEach((ring, height) => {
        const place = places.position(vertex).addScaledVector(axis, (0.1 + 0.2 * height) * radius);
        ring.setMatrixAt(k, matrix.compose(place, turn, new Vector3().setScalar(radius)));
      });
    });
    for (const ring of rings) ring.frustumCulled = false;
    this.group.add(...rings);
    if (all.length > features.length && all.length <= MOST_STARS) this.group.add(this.starsOf(all, places));
  }

  private starsOf(all: Uint32Array, places: Places): Points {
    const points = new Float32Array(3 * all.length);
    all.forEach((vertex, k) => {
      places
        .position(vertex)
        .addScaledVector(places.axis(vertex), 0.002)
        .toArray(points, 3 * k);
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    const squares = new Points(geometry, this.squares);
    squares.frustumCulled = false;
    return squares;
  }
}

function torus(thickness: number, around: number, along: number): TorusGeometry {
  return new TorusGeometry(1, thickness, around, along);
}
