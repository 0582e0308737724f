/**
 * Fields on geometries of three.js: a geometry as a mesh, a field as colors, level sets as lines, critical points as signs, and what was
 * clicked on. three.js is the caller's own (an optional peer dependency), and so are all objects that come out: `dispose` them.
 *
 * A *vertex map* has for every vertex of a geometry the vertex of the mesh that it became; geometries have several vertices at seams
 * and sharp edges, or three of their own for each triangle. Where a vertex map is asked for, `null` says that the vertices are the same.
 *
 * @module
 */

import type {
  BufferAttribute,
  BufferGeometry,
  ColorRepresentation,
  DataTexture,
  GLBufferAttribute,
  InstancedMesh,
  InterleavedBufferAttribute,
  Intersection,
  LineSegments,
  Material,
  Object3D,
  Points,
} from 'three';
import type { Ids, LevelSets, Numbers, OwnFloat64Array, OwnUint32Array, Polylines, TriMesh, Weld } from './index.js';
import type { Colormap } from './snapshot.js';

export { MorseSmoothError } from './index.js';

/** An attribute of a geometry; one that is on the graphics card only cannot be read (`UnsupportedGeometry`). */
export type Attribute = BufferAttribute | InterleavedBufferAttribute | GLBufferAttribute;

/** What `new TriMesh(…)` takes, and `createMesh` of `morse-smooth/worker`, which may have the arrays transferred. */
export interface GeometryArrays {
  /** x, y, z of each vertex of the geometry. */
  positions: OwnFloat64Array;
  /** Three vertices of the geometry for each triangle. */
  triangles: OwnUint32Array;
}

/**
 * A geometry of triangles, or that of a mesh, as arrays of the caller's own. Positions are those of the attribute, interleaved, normalized
 * or half as precise as they may be: before morph targets, bones and matrices of any kind. Triangles are those within `drawRange`;
 * groups, which only choose materials, are passed over.
 *
 * @throws `UnsupportedGeometry` (`reason`: `"lines"`, `"points"`, `"several"`, `"instances"`, `"noPositions"`, `"itemSize"`, `"noData"`,
 *   `"onlyOnGraphicsCard"`); `TrianglesNotTriples` (`length`)
 */
export function arraysOf(source: BufferGeometry | Object3D): GeometryArrays;

/** What {@link meshOf} makes. */
export interface GeometryMesh {
  /** Free it when done. */
  mesh: TriMesh;
  /** For every vertex of the geometry the vertex of the mesh. */
  vertexMap: OwnUint32Array;
}

/**
 * The mesh of a geometry, {@link arraysOf} which are welded, by default within a millionth of the diagonal of the bounding box: seams and
 * the corners of geometries without an index close. In a browser, `init` of `morse-smooth` comes first.
 *
 * @throws as {@link arraysOf} and `new TriMesh(…)`
 */
export function meshOf(source: BufferGeometry | Object3D, options?: { weld?: Weld }): GeometryMesh;

/**
 * An indexed geometry of a mesh's arrays, as `readMesh` of `morse-smooth/files` gives them, with normals. three.js draws in single
 * precision: what is far from the origin for its size is to be moved there before.
 */
export function geometryOf(arrays: { positions: Numbers; triangles: Ids | null }): BufferGeometry;

/** What is filled with a field. */
export interface TargetOptions {
  /** An attribute from an earlier call, which is filled anew and sent to the graphics card again, instead of a new one. */
  target?: BufferAttribute | InterleavedBufferAttribute;
}

/** A field on the mesh as an attribute with one number for each vertex of the geometry, in single precision; for shaders of one's own. */
export function fieldAttribute(
  values: Numbers,
  vertexMap: Ids | null,
  options?: TargetOptions,
): BufferAttribute | InterleavedBufferAttribute;

/** What {@link fieldValues} takes. */
export interface FieldValuesOptions {
  /** Which component of the attribute is the field, where it has several. */
  component?: number;
  /** What vertices do that became one but have different values: `"error"` (default) or `"mean"`. */
  seams?: 'error' | 'mean';
  /** How far values may lie apart and still count as one, which is their mean; in units of the field. Default 0. */
  tolerance?: number;
}

/**
 * The other way round: one value for each vertex of the mesh from an attribute of the geometry. `seams` are the vertices where
 * values disagreed, of which there are none unless these are to become means. `NaN` is a missing value; beside one it disagrees.
 *
 * @throws `SeamDisagreement` (`vertex`, `corners`, `values` of the first; `count` of all), `LengthMismatch`, `UnsupportedGeometry`
 */
export function fieldValues(
  attribute: Attribute,
  vertexMap: Ids | null,
  options?: FieldValuesOptions,
): { values: OwnFloat64Array; seams: OwnUint32Array };

/** How values become colors, those of the pictures of `morse-smooth/snapshot`. */
export interface ColorOptions {
  /** A color map by name, default `"viridis"`; or red, green and blue, 0 to 255, of colors at equal steps, such as `DrawList.colors`. */
  colormap?: Colormap | Numbers;
  /** The values with the first and the last color, which values beyond them have, too. Default: least and greatest value. */
  range?: readonly [number, number];
}

/** Colors in bands. */
export interface BandOptions {
  /** One color between two levels: these values, or so many inside the range. Default: no bands. */
  levels?: Numbers | { count: number };
}

/**
 * A color for each vertex of the geometry, for a material with `vertexColors`. Colors are mixed over triangles; {@link colorTexture} is
 * exact there. A missing value (`NaN`) is grey.
 */
export function colorAttribute(
  values: Numbers,
  vertexMap: Ids | null,
  options?: ColorOptions & BandOptions & TargetOptions,
): BufferAttribute | InterleavedBufferAttribute;

/**
 * Texture coordinates that look a field up in {@link colorTexture}: for the attribute `uv`, or `uv1` where `channel` is 1. Colors then
 * are those of the values at each pixel, bands have sharp ends, and triangles with a missing value (`NaN`) are grey.
 *
 * @param options `range`: the values at the ends of the texture. Default: least and greatest value
 */
export function shadeAttribute(
  values: Numbers,
  vertexMap: Ids | null,
  options?: { range?: readonly [number, number] } & TargetOptions,
): BufferAttribute | InterleavedBufferAttribute;

/** A color map as a texture, the `map` of a material. `levels` as values want the `range` of {@link shadeAttribute}. `channel`: default 0. */
export function colorTexture(options?: ColorOptions & BandOptions & { channel?: number }): DataTexture;

/** Lines that are drawn: level sets, or those of the Morse complex. */
export type Lines = Polylines & Partial<Pick<LevelSets, 'levels' | 'closed'>>;

/** Lines cut into segments, and the line that each is of. */
export interface Segments {
  /** x, y, z of the two ends of each segment. */
  positions: Float32Array;
  lines: OwnUint32Array;
}

/** Lines cut into segments. */
export function segmentsOf(lines: Lines): Segments;

/** Colors of lines by their levels. */
export interface LineColorOptions {
  /** As in {@link ColorOptions}; without it lines have the color of their material. */
  colormap?: ColorOptions['colormap'];
  /** The levels with the first and the last color. Default: the least and the greatest level. */
  range?: readonly [number, number];
}

/** What is needed of a `LineSegmentsGeometry`, of which three.js has one for all its renderers. */
export interface WideLinesGeometry {
  setPositions(positions: Float32Array): unknown;
  setColors(colors: Float32Array): unknown;
}

/**
 * Fills a new `LineSegmentsGeometry` (for lines some pixels wide, by `LineSegments2`) or a `BufferGeometry` (for `LineSegments`) with
 * lines, and returns it. `userData.lines` says which line each segment is of.
 */
export function fillLines<Geometry extends BufferGeometry | WideLinesGeometry>(
  geometry: Geometry,
  lines: Lines,
  options?: LineColorOptions,
): Geometry;

/** Lines as `LineSegments`, one pixel wide. */
export function levelLines(
  lines: Lines,
  options?: LineColorOptions & { color?: ColorRepresentation; material?: Material },
): LineSegments;

/** Critical points: {@link TriMesh.criticalPoints} has them, or one chooses. */
export interface Found {
  vertices: Ids;
  /** −1 minimum, 0 saddle, 1 maximum. */
  kinds: Int8Array | readonly number[];
}

/** Colors of minima, saddles and maxima. Default: those of the pictures, blue, white and red. */
export interface SignOptions {
  colors?: readonly [ColorRepresentation, ColorRepresentation, ColorRepresentation];
  material?: Material;
}

/**
 * Critical points as squares of some pixels (`size`, default 9). `positions` are those of the mesh. `userData` has `vertices` and `kinds`:
 * a Raycaster's `index` is a place there.
 */
export function criticalPoints(found: Found, positions: Numbers, options?: SignOptions & { size?: number }): Points;

/**
 * Critical points as balls, or other solids (`geometry`, of size 1). `radius`: default 1.2 % of the diagonal of the mesh's bounding
 * box. `positions` are those of the mesh. `userData` has `vertices` and `kinds`: a Raycaster's `instanceId` is a place there.
 */
export function criticalMarkers(
  found: Found,
  positions: Numbers,
  options?: SignOptions & { radius?: number; geometry?: BufferGeometry },
): InstancedMesh;

/** What {@link pick} finds. */
export interface Picked {
  /** The corner of the triangle that is nearest to the place, as a vertex of the mesh. */
  vertex: number;
  /** The three corners, as vertices of the mesh. */
  vertices: [number, number, number];
  /** How much each of them counts at the place; the sum is 1. */
  weights: [number, number, number];
  /** The field's value at the place, linear between the corners; null where no values are given. */
  value: number | null;
}

/**
 * What a Raycaster has hit on a mesh that is drawn.
 *
 * @param values the field, for its value there; one number for each vertex of the mesh
 * @throws `InvalidArgument` for what is no hit on a mesh; `LengthMismatch` for one on another geometry
 */
export function pick(intersection: Intersection, vertexMap: Ids | null, values?: Numbers): Picked;
