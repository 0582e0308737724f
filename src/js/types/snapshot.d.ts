/**
 * Pictures of fields on triangle meshes, as PNG files: no graphics card, no window. A WebAssembly module of its own, which draws
 * the same bytes everywhere.
 *
 * @module
 */

import type {
  CriticalPoints,
  Ids,
  InitOptions,
  LevelSets,
  MorseComplex,
  Numbers,
  OwnFloat32Array,
  OwnFloat64Array,
  OwnUint32Array,
  OwnUint8Array,
} from './index.js';

export { MorseSmoothError } from './index.js';

/**
 * Loads the WebAssembly module of the pictures, which is another one than that of the package's main entry. In a browser, wait for
 * it before any other call (otherwise `NotInitialized`); in Node the first call does it by itself.
 *
 * @throws `LoadFailed` where the module cannot be fetched or compiled.
 */
export default function init(options?: InitOptions): Promise<void>;

/** Names of color maps. All but the last three are perceptually uniform; those three diverge from their middle. */
export type Colormap = 'viridis' | 'cividis' | 'magma' | 'inferno' | 'plasma' | 'coolWarm' | 'blueRed' | 'purpleGreen';

/** From where to look at the mesh. The whole of it is in the picture, whatever the direction. */
export interface Camera {
  /** From the middle of the mesh towards the camera, of any length. Default: from the front and above, straight on what is plane. */
  direction?: readonly [number, number, number];
  /** What points upwards in the picture; not along `direction`. Default: y, or z for what lies flat ({@link Surface.up}). */
  up?: readonly [number, number, number];
}

/**
 * What to draw on the surface. Level sets, critical points and the Morse complex are found here, at δ = 0, or drawn as they were
 * found before: results of `TriMesh` are taken as they are, with all that is in them.
 */
export interface DrawOptions {
  /** The color map. Default `"viridis"`. */
  colormap?: Colormap;
  /** The values with the first and the last color, which values beyond them have, too. Default: least and greatest value. */
  range?: readonly [number, number];
  /** Level sets: at these values, so many inside the range, or lines from `TriMesh.levelSets`. Default `{ count: 15 }`. */
  levels?: Numbers | { count: number } | Pick<LevelSets, 'points' | 'offsets' | 'levels' | 'closed'>;
  /** One color between two levels. Default false. */
  bands?: boolean;
  /** All critical points, or those from `TriMesh.criticalPoints`. Default true. */
  criticalPoints?: boolean | Pick<CriticalPoints, 'vertices' | 'kinds'>;
  /**
   * The Morse complex: the whole, without the pairs up to a persistence (relative to the range of the values), or lines from
   * `TriMesh.morseComplex`. Default false.
   */
  morseComplex?: boolean | { persistence: number } | Pick<MorseComplex, 'vertices' | 'offsets' | 'kinds'>;
  /**
   * What NaN among the values means. `"omit"`: there is no value. Triangles with such a corner are grey, and lines and points are those
   * of the field without them. Default `"error"` (`NonFiniteValue`).
   */
  missing?: 'error' | 'omit';
}

/** What {@link snapshot} takes. */
export interface SnapshotOptions extends DrawOptions {
  /** The width in pixels, 1 to 8192. Default 1200. */
  width?: number;
  /** The height in pixels, 1 to 8192. Default 900. */
  height?: number;
  /** A bar that says which color is which value, where there is room. Default true. */
  colorBar?: boolean;
  /**
   * The text above the picture, where there is room; as much of it as fits. Letters are those of ASCII and some of Greek; others become
   * boxes. Default: nothing.
   */
  title?: string;
  camera?: Camera;
}

/**
 * What {@link sheet} takes. `width` and `height` are those of each picture without its color bar (default 600 × 560), and the title is above
 * them all; the whole sheet has at most 8192 pixels along a side. What was found on one field is not for two
 * (`InapplicableOption`).
 */
export interface SheetOptions extends SnapshotOptions {
  levels?: Numbers | { count: number };
  criticalPoints?: boolean;
  morseComplex?: boolean | { persistence: number };
  /** What is written above each picture. Default `["before", "after", "difference"]`. */
  titles?: readonly [string, string, string];
  /** The color map of the difference. Default `"coolWarm"`. */
  differenceColormap?: Colormap;
  /** The difference with the last color; its negative has the first. Default: the largest that there is. */
  largestDifference?: number;
}

/**
 * Draws a field on a mesh: a shaded surface with the colors of the values, level sets, critical points, a color bar.
 *
 * The positions and triangles are those of `new TriMesh(…)`, the values one for each vertex. Returns a PNG file.
 *
 * @throws what `new TriMesh(…)` and `TriMesh.criticalPoints` throw; `InvalidOption`, `UnknownOption`; `OutOfMemory`.
 */
export function snapshot(positions: Numbers, triangles: Ids, values: Numbers, options?: SnapshotOptions): OwnUint8Array;

/**
 * Draws two fields and after − before, side by side: the two with one range, the difference with one around zero. Returns a PNG
 * file.
 *
 * @throws as {@link snapshot}; `InapplicableOption`.
 */
export function sheet(
  positions: Numbers,
  triangles: Ids,
  before: Numbers,
  after: Numbers,
  options?: SheetOptions,
): OwnUint8Array;

/** A mesh that is drawn more than once. Call `free` when done with it. */
export class Scene {
  constructor(positions: Numbers, triangles: Ids);
  /** See {@link snapshot}. */
  snapshot(values: Numbers, options?: SnapshotOptions): OwnUint8Array;
  /** See {@link sheet}. */
  sheet(before: Numbers, after: Numbers, options?: SheetOptions): OwnUint8Array;
  /** The surface of every draw list. */
  surface(): Surface;
  /** What `snapshot` draws on the surface, for a renderer of one's own. */
  drawList(values: Numbers, options?: DrawOptions): DrawList;
  /** Gives the memory back. */
  free(): void;
  [Symbol.dispose](): void;
}

/**
 * A surface for drawing: moved and scaled so that the middle of its bounding box is the origin and its farthest vertex at distance 1,
 * with triangles that face outwards. A vertex of the mesh is there once for each sheet that meets in it.
 */
export interface Surface {
  /** x, y, z of each corner. */
  positions: OwnFloat32Array;
  /** Unit vectors. */
  normals: OwnFloat32Array;
  triangles: OwnUint32Array;
  /** The vertex of the mesh that each corner is. */
  vertices: OwnUint32Array;
  /** Which axis points up: z for things that lie flat. */
  up: 'y' | 'z';
  /** A point p of the mesh is drawn at (p − center) · scale. */
  center: [number, number, number];
  scale: number;
}

/** What is drawn on a surface, in one flat list of each kind. Colors of lines and solids are 0xrrggbb, widths pixels. */
export interface DrawList {
  /**
   * For each corner of the surface its place in `colors`, 0 to 1; below and above, the color is the first and the last. Linear on
   * triangles, as the field is. NaN where there is no value: then all of the triangle has the color `gap`.
   */
  shades: OwnFloat32Array;
  /**
   * The color map: red, green, blue, 0 to 255, at equal steps from shade 0 to shade 1. Between them it is linear; with `bands` it
   * has steps, and the nearest color is the right one.
   */
  colors: OwnUint8Array;
  /** The color of triangles with a corner without a value; null where every corner has one. */
  gap: number | null;
  /** The values with shade 0 and 1. */
  range: [number, number];
  /** The levels, ascending, each once. */
  levels: OwnFloat64Array;
  /** Level sets, then the Morse complex: later ones lie above earlier ones. */
  lines: Lines[];
  /** Critical points, one entry for each kind that there is. */
  solids: Solids[];
  /** The size of solids, for whoever draws fewer of them. */
  size: SolidSize;
  light: Light;
}

/** Lines of one style. */
export interface Lines {
  /** What they are. */
  kind: 'levels' | 'descending' | 'ascending';
  /** x, y, z of each point, on the surface. */
  points: OwnFloat32Array;
  /** Where each line starts among the points, and their number. */
  offsets: OwnUint32Array;
  /** 1 for each line that closes; its first point is not repeated. */
  closed: OwnUint8Array;
  stroke: Stroke;
}

/** How lines are drawn. */
export interface Stroke {
  color: number;
  width: number;
  /** 0 to 1. */
  opacity: number;
  /** A line under it, so that it stands out from any color. */
  casing: { color: number; width: number } | null;
}

/** Instances of one solid. */
export interface Solids {
  kind: 'minima' | 'saddles' | 'maxima';
  /** One solid, about as large as the unit ball, its axis along y: x, y, z of each corner, unit normals, triangles. */
  shape: { positions: OwnFloat32Array; normals: OwnFloat32Array; triangles: OwnUint32Array };
  color: number;
  /** The same solid, enlarged by `scale` and seen from its inside, makes a rim. */
  rim: { color: number; scale: number };
  /** What shines of the color without light, 0 to 1. */
  glow: number;
  /** The vertex of each instance. */
  vertices: OwnUint32Array;
  /** On the surface, x, y, z. The solid stands `lift` radii above it. */
  places: OwnFloat32Array;
  /** Unit vectors along which the axes stand. */
  axes: OwnFloat32Array;
  /** 1 where the surface is open, so that the axis is to be turned to the side that is looked at; else 0. */
  bothSides: OwnUint8Array;
  radius: number;
  lift: number;
}

/** The radius of n solids is √(`cover` / n), at least `least` and at most `most`. */
export interface SolidSize {
  cover: number;
  least: number;
  most: number;
}

/** Light from everywhere, and from one direction as the camera sees it (x right, y up, z towards the camera). */
export interface Light {
  ambient: number;
  diffuse: number;
  direction: [number, number, number];
}
