/** What is pointed at, a critical point or a pair of them: large, with a bright rim, and a line between the two. */
import { Group } from 'three';
import type { Vector3 } from 'three';
import type { Solids } from 'morse-smooth/snapshot';
import { CurveLayer } from './curves';
import { GlyphLayer, KINDS } from './glyphs';
import type { Places } from './places';

const BRIGHT = 0xffd21f;
const RADIUS = 0.03;
const PATH = { color: BRIGHT, width: 4, opacity: 1, casing: { color: 0x10151f, width: 6 } };
const HIDDEN_PATH = { color: BRIGHT, width: 2, opacity: 1, casing: null };

/** Entry k of both arrays is about the same point. */
export interface LitPoints {
  vertices: Uint32Array;
  /** −1 minimum, 0 saddle, 1 maximum; for any other vertex 0, too. */
  kinds: Int8Array;
}

export class Marker {
  readonly group = new Group();
  private readonly glyphs = new GlyphLayer({ rim: BRIGHT, late: true });
  /** What lies behind the surface is still seen, faintly. */
  private readonly ghosts = new GlyphLayer({ rim: BRIGHT, ghost: true });
  private readonly path = new CurveLayer();
  private readonly hiddenPath = new CurveLayer({ ghost: true });

  constructor() {
    // Over all that is drawn on the surface; what is hidden first, lest it shine through the glyphs.
    const layers = [this.hiddenPath, this.ghosts, this.path, this.glyphs];
    layers.forEach(({ group }, k) => (group.renderOrder = 1 + k));
    this.group.add(...layers.map(({ group }) => group));
  }

  clear(): void {
    for (const layer of [this.glyphs, this.ghosts, this.path, this.hiddenPath]) layer.clear();
  }

  /** Turned to the side that is seen from there. */
  face(eye: Vector3): void {
    for (const layer of [this.glyphs, this.ghosts]) layer.face(eye);
  }

  /** `look`: a solid of each kind. `path`: the two vertices of each segment. */
  set({ vertices, kinds }: LitPoints, look: readonly Solids[], places: Places, path: Uint32Array): void {
    const solids = look.map((solid) => {
      const members = vertices.filter((vertex, k) => KINDS[kinds[k]! + 1] === solid.kind && places.has(vertex));
      const axes = new Float32Array(3 * members.length);
      members.forEach((vertex, k) => places.axis(vertex).toArray(axes, 3 * k));
      const bothSides = new Uint8Array(members.length).fill(1);
      return { ...solid, vertices: members, places: places.positions(members), axes, bothSides, radius: RADIUS };
    });
    const present = solids.filter((solid) => solid.vertices.length > 0);
    for (const layer of [this.glyphs, this.ghosts]) layer.set(present);
    const segments = places.positions(path);
    this.path.set(segments, PATH);
    this.hiddenPath.set(segments, HIDDEN_PATH);
  }
}
