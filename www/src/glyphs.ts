/**
 * Critical points as small solids, told apart by shape and colour: minima are blue cubes, maxima red balls, saddles white
 * octahedra. Each has a dark rim (the same solid, a little larger, seen from its inside) so that it stands out from any
 * colour of the surface.
 */
import {
  BackSide,
  BoxGeometry,
  BufferGeometry,
  GreaterDepth,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  MeshLambertMaterial,
  OctahedronGeometry,
  Quaternion,
  Vector3,
} from 'three';

export const MINIMUM = -1;
export const SADDLE = 0;
export const MAXIMUM = 1;

/** Kept equal to the colours of the legend in style.css. */
const COLOURS = { [MINIMUM]: 0x2f6bff, [SADDLE]: 0xffffff, [MAXIMUM]: 0xe5263c } as const;
const RIM = 0x10151f;

type Kind = keyof typeof COLOURS;

const SHAPES: Record<Kind, () => BufferGeometry> = {
  [MINIMUM]: () => new BoxGeometry(1.5, 1.5, 1.5),
  [SADDLE]: () => new OctahedronGeometry(1.15),
  [MAXIMUM]: () => new IcosahedronGeometry(1, 3),
};

/** Balls for a crowd, in which each is a few pixels wide: thousands of round ones would be most of the work of drawing. */
const CROWD = 300;
const COARSE_BALL = new IcosahedronGeometry(1, 1);

/** Radius for which the glyphs cover about an eighth of the surface when they are many, and a set size when they are few. */
export function glyphRadius(area: number, count: number): number {
  return Math.max(0.004, Math.min(0.017, 0.2 * Math.sqrt(area / Math.max(1, count))));
}

export class GlyphLayer {
  readonly group = new Group();
  private readonly solids = new Map<
    Kind,
    { geometry: BufferGeometry; body: MeshLambertMaterial; rim: MeshBasicMaterial }
  >();

  /** `rim`: the colour around the glyphs. `ghost`: only what is hidden is seen, faintly. `late`: drawn after such ghosts. */
  constructor({ rim = RIM, ghost = false, late = false }: { rim?: number; ghost?: boolean; late?: boolean } = {}) {
    const hidden = { transparent: true, opacity: 0.5, depthFunc: GreaterDepth, depthWrite: false };
    const see = ghost ? hidden : { transparent: late };
    for (const kind of [MINIMUM, SADDLE, MAXIMUM] as const) {
      this.solids.set(kind, {
        geometry: SHAPES[kind](),
        body: new MeshLambertMaterial({
          color: COLOURS[kind],
          emissive: COLOURS[kind],
          emissiveIntensity: 0.35,
          ...see,
        }),
        rim: new MeshBasicMaterial({ color: rim, side: BackSide, ...see }),
      });
    }
  }

  clear(): void {
    for (const child of [...this.group.children]) if (child instanceof InstancedMesh) child.dispose();
    this.group.clear();
  }

  /** `normals` stand the glyphs upright on the surface, so that seen from above a cube is a square. */
  set(vertices: Uint32Array, kinds: Int8Array, positions: Float32Array, normals: Float32Array, radius: number): void {
    this.clear();
    for (const [kind, { geometry, body, rim }] of this.solids) {
      const members = vertices.filter((_, k) => kinds[k] === kind);
      if (members.length === 0) continue;
      const shape = kind === MAXIMUM && members.length > CROWD ? COARSE_BALL : geometry;
      const solid = new InstancedMesh(shape, body, members.length);
      const hull = new InstancedMesh(shape, rim, members.length);
      const up = new Vector3(0, 1, 0);
      const normal = new Vector3();
      const place = new Vector3();
      const turn = new Quaternion();
      const matrix = new Matrix4();
      members.forEach((vertex, k) => {
        normal.fromArray(normals, 3 * vertex);
        place.fromArray(positions, 3 * vertex).addScaledVector(normal, 0.45 * radius);
        turn.setFromUnitVectors(up, normal.lengthSq() > 0 ? normal : up);
        solid.setMatrixAt(k, matrix.compose(place, turn, new Vector3().setScalar(radius)));
        hull.setMatrixAt(k, matrix.compose(place, turn, new Vector3().setScalar(1.28 * radius)));
      });
      // Instances are spread over the whole mesh: there is nothing to gain from culling them.
      solid.frustumCulled = hull.frustumCulled = false;
      this.group.add(hull, solid);
    }
  }
}
