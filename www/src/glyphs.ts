/**
 * Draws the solids of a draw list, which mark critical points. Each has a rim (the same solid, a little larger, seen from its
 * inside), so that it stands out from any color of the surface.
 */
import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  GreaterDepth,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  Vector3,
} from 'three';
import type { Solids, SolidSize } from 'morse-smooth/snapshot';
import type { Places } from './places';

/** The kinds of critical points, as the package numbers them: −1, 0, 1. */
export const KINDS = ['minima', 'saddles', 'maxima'] as const;
export const SADDLE = 0;

export const radiusOf = ({ cover, least, most }: SolidSize, count: number): number =>
  Math.max(least, Math.min(most, Math.sqrt(cover / Math.max(1, count))));

/** Some of the instances, with the radius that so many have. */
export function chosen(all: readonly Solids[], isChosen: (vertex: number) => boolean, size: SolidSize): Solids[] {
  const some = all.map((solids) => {
    const members = [...solids.vertices.keys()].filter((k) => isChosen(solids.vertices[k]!));
    const of = (points: Float32Array) =>
      Float32Array.from({ length: 3 * members.length }, (_, i) => points[3 * members[Math.floor(i / 3)]! + (i % 3)]!);
    const vertices = Uint32Array.from(members, (k) => solids.vertices[k]!);
    const bothSides = Uint8Array.from(members, (k) => solids.bothSides[k]!);
    return { ...solids, vertices, places: of(solids.places), axes: of(solids.axes), bothSides };
  });
  const radius = radiusOf(
    size,
    some.reduce((count, { vertices }) => count + vertices.length, 0),
  );
  return some.filter(({ vertices }) => vertices.length > 0).map((solids) => ({ ...solids, radius }));
}

/** Entry k of both arrays is about the same point. */
export interface Points {
  vertices: Uint32Array;
  /** −1 minimum, 0 saddle, 1 maximum; for any other vertex 0, too. */
  kinds: Int8Array;
}

/** Solids at those points that are on the surface. `look`: one of each kind. `open`: whether the surface is seen from both sides. */
export function solidsAt(
  { vertices, kinds }: Points,
  look: readonly Solids[],
  places: Places,
  radius: number,
  open: boolean,
): Solids[] {
  const solids = look.map((solid) => {
    const members = vertices.filter((vertex, k) => KINDS[kinds[k]! + 1] === solid.kind && places.has(vertex));
    const axes = new Float32Array(3 * members.length);
    members.forEach((vertex, k) => places.axis(vertex).toArray(axes, 3 * k));
    const bothSides = new Uint8Array(members.length).fill(open ? 1 : 0);
    return { ...solid, vertices: members, places: places.positions(members), axes, bothSides, radius };
  });
  return solids.filter((solid) => solid.vertices.length > 0);
}

interface Materials {
  body: MeshLambertMaterial;
  rim: MeshBasicMaterial;
}

export class GlyphLayer {
  readonly group = new Group();
  /** Kept, since new ones would have to be compiled anew. */
  private readonly materials = new Map<Solids['kind'], Materials>();
  private geometries: BufferGeometry[] = [];
  private pairs: { solids: Solids; rim: InstancedMesh; body: InstancedMesh }[] = [];

  /** `rim`: the color around the glyphs, if it is another. `ghost`: only what is hidden is seen, faintly. `late`: drawn after such ghosts. */
  constructor(private readonly options: { rim?: number; ghost?: boolean; late?: boolean } = {}) {}

  clear(): void {
    for (const child of [...this.group.children]) if (child instanceof InstancedMesh) child.dispose();
    for (const geometry of this.geometries) geometry.dispose();
    this.geometries = [];
    this.pairs = [];
    this.group.clear();
  }

  set(all: readonly Solids[]): void {
    this.clear();
    for (const solids of all) {
      const { body, rim } = this.materialsOf(solids);
      const geometry = geometryOf(solids.shape);
      this.geometries.push(geometry);
      const count = solids.vertices.length;
      const pair = { rim: new InstancedMesh(geometry, rim, count), body: new InstancedMesh(geometry, body, count) };
      this.group.add(pair.rim, pair.body);
      this.pairs.push({ solids, ...pair });
    }
    this.place(null);
  }

  /** Turns the solids of open surfaces to the side that is seen from there, in the model's coordinates. */
  face(eye: Vector3): void {
    if (this.pairs.some(({ solids }) => solids.bothSides.includes(1))) this.place(eye);
  }

  private place(eye: Vector3 | null): void {
    for (const { solids, rim, body } of this.pairs) {
      place(solids, rim, solids.rim.scale, eye);
      place(solids, body, 1, eye);
    }
  }

  private materialsOf({ kind, color, glow, rim }: Solids): Materials {
    const { ghost = false, late = false } = this.options;
    const hidden = { transparent: true, opacity: 0.5, depthFunc: GreaterDepth, depthWrite: false };
    const see = ghost ? hidden : { transparent: late };
    const made = this.materials.get(kind) ?? {
      body: new MeshLambertMaterial(see),
      rim: new MeshBasicMaterial({ side: BackSide, ...see }),
    };
    this.materials.set(kind, made);
    made.body.color.setHex(color);
    made.body.emissive.setHex(color);
    made.body.emissiveIntensity = glow;
    made.rim.color.setHex(this.options.rim ?? rim.color);
    return made;
  }
}

function geometryOf({ positions, normals, triangles }: Solids['shape']): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  return geometry;
}

function place(solids: Solids, mesh: InstancedMesh, scale: number, eye: Vector3 | null): void {
  const { vertices, places, axes, bothSides, radius, lift } = solids;
  const axis = new Vector3();
  const at = new Vector3();
  const towards = new Vector3();
  const turn = new Quaternion();
  const matrix = new Matrix4();
  const size = new Vector3().setScalar(scale * radius);
  for (let k = 0; k < vertices.length; k++) {
    axis.fromArray(axes, 3 * k);
    at.fromArray(places, 3 * k);
    if (eye && bothSides[k] && towards.subVectors(eye, at).dot(axis) < 0) axis.negate();
    at.addScaledVector(axis, lift * radius);
    mesh.setMatrixAt(k, matrix.compose(at, upright(axis, turn), size));
  }
  mesh.instanceMatrix.needsUpdate = true;
  // Instances are spread over the whole mesh: there is nothing to gain from culling them.
  mesh.frustumCulled = false;
}

const UP = new Vector3(0, 1, 0);

/** The shortest way that takes y to `axis`; straight down, where every way is the shortest, half round about x. */
function upright(axis: Vector3, turn: Quaternion): Quaternion {
  return axis.y < -0.999999 ? turn.set(1, 0, 0, 0) : turn.setFromUnitVectors(UP, axis);
}
