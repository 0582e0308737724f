/** What is pointed at, a critical point or a pair of them: large, with a bright rim, and a line between the two. */
import { Group } from 'three';
import type { Vector3 } from 'three';
import type { Solids } from 'morse-smooth/snapshot';
import { CurveLayer } from './curves';
import { GlyphLayer, solidsAt } from './glyphs';
import type { Points } from './glyphs';
import type { Places } from './places';

const BRIGHT = 0xffd21f;
const RADIUS = 0.03;
const PATH = { color: BRIGHT, width: 4, opacity: 1, casing: { color: 0x10151f, width: 6 } };
const HIDDEN_PATH = { color: BRIGHT, width: 2, opacity: 1, casing: null };

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
  set({ vertices, kinds }: Points, look: readonly Solids[], places: Places, path: Uint32Array): void {
    const present = solidsAt({ vertices, kinds }, look, places, RADIUS, true);
    for (const layer of [this.glyphs, this.ghosts]) layer.set(present);
    const segments = places.positions(path);
    this.path.set(segments, PATH);
    this.hiddenPath.set(segments, HIDDEN_PATH);
  }
}
