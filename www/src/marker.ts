/** What is pointed at, a critical point or a pair of them: large, with a bright rim, and a line between the two. */
import { Group } from 'three';
import { CurveLayer } from './curves';
import { GlyphLayer } from './glyphs';
import type { DisplayMesh } from './protocol';

const BRIGHT = 0xffd21f;
const RADIUS = 0.03;

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
  private readonly path = new CurveLayer({ colour: BRIGHT, width: 4, casing: 0x10151f });
  private readonly ghostPath = new CurveLayer({ colour: BRIGHT, width: 2, ghost: true });

  constructor() {
    this.group.add(this.ghosts.group, this.glyphs.group, this.path.group, this.ghostPath.group);
    this.ghosts.group.renderOrder = 1;
    this.glyphs.group.renderOrder = 2;
  }

  clear(): void {
    this.glyphs.clear();
    this.ghosts.clear();
    for (const line of [this.path, this.ghostPath]) line.set(new Float32Array(0));
  }

  set({ vertices, kinds }: LitPoints, mesh: DisplayMesh, normals: Float32Array, path: Float32Array): void {
    for (const layer of [this.glyphs, this.ghosts]) layer.set(vertices, kinds, mesh.positions, normals, RADIUS);
    for (const line of [this.path, this.ghostPath]) line.set(path);
  }
}
