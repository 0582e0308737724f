/// <reference lib="esnext.disposable" />

/**
 * Critical points, level sets and smoothing of scalar fields on triangle meshes.
 *
 * A *field* has one number per vertex, in the order of the mesh's vertices. Vertices and triangles are numbered from 0. Lengths
 * are in the units of the positions, values in the units of the field; nothing is rescaled unless a comment says so. Every array
 * that comes out is a copy of the caller's own: changing it changes nothing here, and nothing done here later changes it.
 * Whatever fails throws a {@link MorseSmoothError}. An option that does not exist fails with `UnknownOption`, one out of its range
 * with `InvalidOption`, one that means nothing for what was asked with `InapplicableOption`.
 *
 * @module
 */

/** Numbers as they are taken. Values of a plain array must all be of type `number` (otherwise `InvalidArgument`). */
export type Numbers = Float64Array | Float32Array | readonly number[];
/** Vertex numbers as they are taken: whole, from 0 to 2³² − 1. */
export type Ids = Uint32Array | Uint16Array | readonly number[];

/**
 * Loads the WebAssembly module. In a browser, wait for it before any other call (otherwise `NotInitialized`); in Node the import
 * has already done it. Calling it again is free and gives the same promise; after a failure it tries anew.
 *
 * @throws `LoadFailed` where the module cannot be fetched or compiled; `detail` has `url` and `status` if a server answered.
 */
export default function init(options?: InitOptions): Promise<void>;

/** What {@link init} takes. */
export interface InitOptions {
  /**
   * Where `morse_smooth_bg.wasm` is, or its content. Without it the file beside the script is fetched, and with
   * `morse-smooth/inline` nothing is.
   */
  wasm?: URL | string | Request | Response | BufferSource | WebAssembly.Module;
}

/** Of this package, such as `"0.1.0"`. */
export const version: string;

/** Any failure of this package. */
export class MorseSmoothError extends Error {
  /** For code that carries errors across threads; this package makes its own. */
  constructor(code: string, message: string, detail?: Record<string, unknown>, options?: { cause?: unknown });
  /**
   * Names the failure for programs; stays the same while messages improve.
   *
   * - files: `EmptyFile`, `UnknownFormat`, `UnsupportedFormat`, `UnsupportedFeature`, `Truncated`, `UnexpectedEnd`,
   *   `InvalidNumber`, `InvalidSyntax`, `MissingElement`, `FaceIndexOutOfBounds`, `UnknownColumn`, `TooLarge`,
   *   `FieldsNotSupported`, `BinaryNotSupported`
   * - meshes: `EmptyMesh`, `PositionsNotTriples`, `TrianglesNotTriples`, `TooManyElements`, `NonFinitePosition`,
   *   `PositionOverflow`, `IndexOutOfBounds`, `ZeroArea`, `ZeroWeightSum`
   * - fields: `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`, `NonFiniteLevel`
   * - systems: `NotPositiveDefinite` (`column`: the vertex at which a factorisation or an iteration failed),
   *   `IndefinitePreconditioner` (`iterations` done), `NotConverged` (`iterations` done, `residual` reached), `OutOfMemory`
   *   (`bytes` needed)
   * - calls: `UnknownOption`, `InvalidOption`, `InapplicableOption`, `UnsupportedOption`, `InvalidArgument`
   * - life of objects: `NotInitialized`, `LoadFailed`, `UseAfterFree`, `Busy`
   * - `InternalError`: a bug of ours, always worth a report
   */
  readonly code: string;
  /** The numbers and names in the message: `vertex`, `triangle`, `index`, `line`, `option`, `expected`, `bytes`, … */
  readonly detail: Record<string, unknown>;
}

// ---------------------------------------------------------------------------------------------------------------- files

export type MeshFormat = 'obj' | 'off' | 'ply' | 'vtk';

/** Something in the input that was put right or left out. */
export interface Diagnostic {
  /** Stable name. */
  code: string;
  /** One sentence for people. */
  message: string;
  /** How many there are. */
  count: number;
  /** Numbers of the first few. */
  examples: number[];
}

/** What {@link readMesh} found. */
export interface MeshFile {
  mesh: TriMesh;
  /** Per-vertex numbers of the file, by their name there. */
  fields: Record<string, Float64Array>;
  format: MeshFormat;
  warnings: Diagnostic[];
}

/** What {@link readMesh} takes. */
export interface ReadMeshOptions {
  /** Taken at its word. Default: recognised from the content, or else from the ending of `fileName`. */
  format?: MeshFormat;
  /** Only its ending matters. */
  fileName?: string;
  /** Make one vertex of all vertices at the same position. Default `false`. */
  weld?: boolean;
}

/**
 * Reads a mesh and the fields that come with it: OBJ, OFF, PLY (text, binary of both byte orders), legacy VTK PolyData (text,
 * binary). Polygons are cut into triangles.
 *
 * @throws the codes for files and for meshes of {@link MorseSmoothError.code}
 */
export function readMesh(bytes: Uint8Array, options?: ReadMeshOptions): MeshFile;

/** What {@link readField} takes. */
export interface ReadFieldOptions {
  /** Default: told from the content. */
  format?: 'txt' | 'csv';
  /** Of a table: its name in the first line, or its number from 0. Default: the first column of numbers. */
  column?: string | number;
}

/**
 * Reads a field from text: numbers with blanks or line ends between them, or a column of a table with commas, semicolons or tabs.
 *
 * @throws `InvalidNumber` with the `line`; `NonFiniteValue` with the `vertex`; `UnknownColumn`; `EmptyFile`
 */
export function readField(bytes: Uint8Array, options?: ReadFieldOptions): Float64Array;

/** What {@link writeMesh} takes. */
export interface WriteMeshOptions {
  format: MeshFormat;
  /** Fields to write along, by name; PLY and VTK have room for them (otherwise `FieldsNotSupported`). */
  fields?: Record<string, Numbers>;
  /** PLY and VTK can be binary (otherwise `BinaryNotSupported`). Default `false`. */
  binary?: boolean;
}

/**
 * Writes a mesh, and fields where the format has room for them, in double precision. In PLY names, blanks become `_`; an empty
 * name becomes `field`, and a name that is there already (in PLY also `x`, `y`, `z`) gets a number.
 */
export function writeMesh(mesh: TriMesh, options: WriteMeshOptions): Uint8Array;

// ----------------------------------------------------------------------------------------------------------------- mesh

/** What kind of surface a mesh is. */
export interface MeshTopology {
  /** Vertices − edges + triangles. */
  eulerCharacteristic: number;
  /** Connected parts of the surface; vertices of no triangle are none. */
  components: number;
  /** Closed walks along the boundary. */
  boundaryLoops: number;
  /** No boundary edge. */
  closed: boolean;
  orientable: boolean;
  /** Number of handles, all components together; `null` where it is not defined: non-manifold or not orientable. */
  genus: number | null;
  /** Edges with three triangles or more. */
  nonManifoldEdges: number;
  /** Vertices around which the triangles are neither one fan nor one disk. */
  nonManifoldVertices: number;
  /** Vertices of no triangle. */
  isolatedVertices: number;
  /** Triangles that name a vertex twice (they were dropped) or have no area (they were kept). */
  degenerateTriangles: number;
}

/**
 * A triangle mesh. Any triangles will do: closed, with boundary, of several parts, non-manifold, not orientable.
 *
 * It lives in WebAssembly memory: call {@link TriMesh.free} when done, or declare it with `using`. Used after that it throws
 * `UseAfterFree`. (The garbage collector also gets there, but not soon.)
 */
export class TriMesh {
  /**
   * @param positions x, y, z of vertex 0, then of vertex 1, …
   * @param triangles three vertex numbers for each triangle
   * @param options `weld`: make one vertex of all vertices at the same position. Default `false`
   * @throws `PositionsNotTriples`, `TrianglesNotTriples`, `NonFinitePosition` (`vertex`), `IndexOutOfBounds` (`triangle`, `index`),
   *   `EmptyMesh`
   */
  constructor(positions: Numbers, triangles: Ids, options?: { weld?: boolean });

  readonly vertexCount: number;
  readonly edgeCount: number;
  readonly triangleCount: number;
  /** Sum of the triangles' areas. */
  readonly area: number;
  readonly topology: Readonly<MeshTopology>;
  /** What was put right or left out when the mesh was made. */
  readonly warnings: Diagnostic[];

  /** x, y, z of each vertex. */
  positions(): Float64Array;
  /** Three vertex numbers for each triangle. */
  triangles(): Uint32Array;

  /**
   * Minima, saddles and maxima of a field. Equal values are told apart by their vertex numbers, so that at δ = 0 the index sum
   * is the Euler characteristic, whatever the field.
   *
   * @throws `LengthMismatch` (`expected`, `actual`), `NonFiniteValue` (`vertex`)
   */
  criticalPoints(values: Numbers, options?: DeltaOptions): CriticalPoints;

  /**
   * The lines on which the field has the given values, or `count` values that cut its range into equal parts (none where the field
   * is constant), or values just below and just above `saddles`, where the lines change their shape. At most 10,000.
   *
   * @throws `NonFiniteLevel` (`index`), `LengthMismatch`, `NonFiniteValue`; `IndexOutOfBounds` (`index`) for a vertex in `saddles`;
   *   `OutOfMemory` (`bytes`) for more points than fit
   */
  levelSets(values: Numbers, levels: Numbers | { count: number } | SaddleLevels): LevelSets;

  /**
   * The mesh cut along level sets, so that every triangle lies between two levels: band k holds what is at least `levels[k − 1]`
   * and less than `levels[k]`. What a filled contour plot draws.
   *
   * @throws `NonFiniteLevel` (`index`), `LengthMismatch`, `NonFiniteValue`; `InvalidOption` for more than 10,000 levels;
   *   `OutOfMemory` (`bytes`)
   */
  bands(values: Numbers, levels: Numbers | { count: number }): Bands;

  /**
   * For every critical vertex the δ at which it stops being one, and the number of critical points at every δ. At each δ that is what
   * {@link TriMesh.criticalPoints} finds by the strict rule, exactly.
   *
   * @throws `LengthMismatch` (`expected`, `actual`), `NonFiniteValue` (`vertex`)
   */
  deltaHierarchy(values: Numbers, options?: { link?: Link }): DeltaHierarchy;

  /**
   * Pairs every extremum with the saddle at which its component of the sublevel (superlevel) set joins that of a lower (higher)
   * extremum. The most persistent pair comes first. Slower where sheets meet, and slow on soups in which most edges have many
   * triangles.
   */
  persistence(values: Numbers): PersistencePairs;

  /** How many extrema {@link TriMesh.simplify} leaves, for every threshold. */
  persistenceCurve(values: Numbers): PersistenceCurve;

  /**
   * A field near the given one that has no other extrema than those of persistence above the threshold (`thresholdIs`:
   * `"relative"` to the range, the default, or `"absolute"`), or than those in `keep`. With a threshold no value changes by more
   * than it. Regions that become flat are tilted by the smallest steps that numbers have, so that the extrema by
   * (value, vertex number) are exactly the wanted ones; this is checked before the result is returned. (Where a pair is as
   * persistent as the threshold, these steps may come on top of it, at most as many as the flat region has vertices.)
   *
   * What is kept is told by the pairs of the given field; in the result, these extrema may be less persistent.
   *
   * @throws `NotAnExtremum` (`vertex`), `IndexOutOfBounds` (`index`) for a vertex in `keep`; `Unconstrained` (`component`) where `keep` has no minimum or no
   *   maximum in a component; `UnavoidableExtremum` (`vertex`) where the mesh hangs together in a single vertex and has no room for
   *   such a field
   */
  simplify(values: Numbers, options: SimplifyOptions): Float64Array;

  /**
   * From each saddle the steepest paths along edges, one for each component of its lower and of its upper link, to the extrema
   * where they end. Paths of the same direction that meet go on together.
   */
  morseComplex(values: Numbers, options?: MorseComplexOptions): MorseComplex;

  /** The Morse complex at every threshold: what is cancelled when, and into what. */
  morseHierarchy(values: Numbers): MorseHierarchy;

  /**
   * For every vertex the minimum and the maximum at which its steepest path ends, where pairs of persistence up to
   * `persistence` are cancelled, as in {@link TriMesh.morseComplex}; by default none.
   */
  basins(values: Numbers, options?: Omit<MorseComplexOptions, 'paths'>): Basins;

  /** How rough a field is: its Sobolev semi-norm fᵀLf and ‖Lf‖₂, of the values as they are. */
  smoothness(values: Numbers, options?: { weights?: LaplacianWeights }): Smoothness;

  /**
   * The Laplacian L, n × n: l_ij = −w_ij for an edge, rows that sum to 0, so positive semi-definite where symmetric.
   * Default weights `"cotangent"`.
   */
  laplacian(options?: { weights?: LaplacianWeights }): SparseMatrix;

  /**
   * The mass matrix B, n × n, symmetric: `"galerkin"` (consistent; default) or `"lumped"` (its diagonal of row sums). Its entries
   * sum to the area with scale `"raw"`, and to the number of vertices with `"meanOne"` (default).
   */
  mass(options?: { kind?: 'galerkin' | 'lumped'; massScale?: MassScale }): SparseMatrix;

  /** Gives the memory back. Once is enough, twice does no harm. `Busy` from within a call's `onProgress`. */
  free(): void;
  [Symbol.dispose](): void;
}

// ------------------------------------------------------------------------------------------------------ analysis of a field

/**
 * How a saddle is recognised when δ > 0, going round the vertices next to it: by neighbours in a row that are beyond δ on
 * opposite sides (`"consecutive"`), or after leaving out the ones within δ (`"skip"`).
 */
export type Link = 'consecutive' | 'skip';

/** Which critical points to tell. */
export interface DeltaOptions {
  /** Differences up to δ do not count. Zero or more; default 0. */
  delta?: number;
  /** `"relative"` (default): δ is a fraction of the greatest difference along an edge. `"absolute"`: in units of the field. */
  deltaIs?: 'relative' | 'absolute';
  /** Default `"consecutive"`. */
  link?: Link;
  /**
   * `"strict"` (default): an extremum is beyond δ of all its neighbours, so a greater δ never has more critical points.
   * `"literal"`: the paper's text to the letter, by which extrema grow with δ; for comparison.
   */
  rule?: 'strict' | 'literal';
}

/** The critical points of a field: entry k of every array is about the same vertex. Vertices ascend. */
export interface CriticalPoints {
  vertices: Uint32Array;
  /** −1 minimum, 0 saddle, 1 maximum. */
  kinds: Int8Array;
  /** Of a saddle: 1 for an ordinary one, 2 for a monkey saddle, … Of an extremum: 1. */
  multiplicities: Uint32Array;
  /** 1 on the boundary, else 0. */
  onBoundary: Uint8Array;
  counts: CriticalCounts;
}

/** How many critical points there are. */
export interface CriticalCounts {
  minima: number;
  maxima: number;
  /** Each as often as its multiplicity says. */
  saddles: number;
  /** At δ = 0 the sum of the indices of all vertices, equal to the Euler characteristic; `null` for δ > 0. */
  indexSum: number | null;
}

/** Lines of points: line k has the points `offsets[k]` up to, not including, `offsets[k + 1]`. */
export interface Polylines {
  /** x, y, z of each point. */
  points: Float64Array;
  /** One more than there are lines. */
  offsets: Uint32Array;
}

/** Level sets. A closed line does not repeat its first point. */
export interface LevelSets extends Polylines {
  /** The level of each line. */
  levels: Float64Array;
  /** 1 for each line that closes, 0 for one that ends at the boundary. */
  closed: Uint8Array;
  /** The two ends a < b of the edge that each point lies on. */
  edges: Uint32Array;
  /** Where on its edge each point lies: t of (1 − t)·a + t·b. */
  parameters: Float64Array;
}

/** Two levels for each saddle: just below it and just above. */
export interface SaddleLevels {
  /** All saddles, or these vertices. */
  saddles: true | Ids;
  /** Distance of the levels from the saddle's value, relative to the range. Default 0: the nearest levels that tell sides. */
  offset?: number;
}

/** See {@link TriMesh.bands}. */
export interface Bands {
  /** The levels, ascending, each once. */
  levels: Float64Array;
  /** x, y, z of each point. */
  points: Float64Array;
  /** Three points for each triangle, turned as the triangle of the mesh that it is a part of. */
  triangles: Uint32Array;
  /** The band of each triangle, 0 up to and including the number of levels. */
  bands: Uint32Array;
  /** The triangle of the mesh that each triangle is a part of. */
  parents: Uint32Array;
  /** The ends a ≤ b of the edge that each point lies on; twice the same where it is a vertex. */
  edges: Uint32Array;
  /** Where on its edge each point lies: t of (1 − t)·a + t·b. */
  parameters: Float64Array;
}

/** See {@link TriMesh.deltaHierarchy}. A vertex is critical at δ = 0, and at every δ below the one at which it vanishes. */
export interface DeltaHierarchy {
  /** Every critical vertex at δ = 0, ascending. */
  vertices: Uint32Array;
  /** −1 minimum, 0 saddle, 1 maximum. */
  kinds: Int8Array;
  /** The relative δ at which each vertex stops being critical: 0 where only its number tells it from an equal neighbour. */
  vanishesAt: Float64Array;
  /** The same δ in units of the field. */
  vanishesAtAbsolute: Float64Array;
  /**
   * Numbers of critical points as steps over the relative δ: row 0 is δ = 0, and row k holds from `delta[k]` up to, not
   * including, `delta[k + 1]`. (Where ties matter, row 1 begins at the least number above 0.)
   */
  delta: Float64Array;
  minima: Uint32Array;
  maxima: Uint32Array;
  /** With multiplicity. */
  saddles: Uint32Array;
}

/** See {@link TriMesh.persistence}. Entry k of the first six arrays is about the same pair. */
export interface PersistencePairs {
  extrema: Uint32Array;
  saddles: Uint32Array;
  /** −1 minimum and saddle, 1 saddle and maximum. */
  kinds: Int8Array;
  /** The lower of the two values. */
  birth: Float64Array;
  /** The higher of the two values. */
  death: Float64Array;
  /** death − birth; descending. */
  persistence: Float64Array;
  /** The lowest vertex of each component of the mesh. */
  essentialMinima: Uint32Array;
  /** The highest vertex of each component of the mesh. */
  essentialMaxima: Uint32Array;
  /**
   * Saddles at which a loop begins that never closes up: as many as the first Betti number, 2g on a closed orientable surface.
   * A vertex may stand there several times.
   */
  essentialSaddles: Uint32Array;
}

/** See {@link TriMesh.persistenceCurve}. Row k holds from `threshold[k]` up to, not including, `threshold[k + 1]`. */
export interface PersistenceCurve {
  /** In units of the field; row 0 is 0. */
  threshold: Float64Array;
  /** Minima of persistence above the threshold, the lowest vertex of each component included. */
  minima: Uint32Array;
  maxima: Uint32Array;
}

/** What {@link TriMesh.simplify} is to keep. */
export type SimplifyOptions =
  | { threshold: number; thresholdIs?: 'relative' | 'absolute'; keep?: undefined }
  | { keep: Ids; threshold?: undefined; thresholdIs?: undefined };

/** See {@link TriMesh.morseComplex}. */
export interface MorseComplexOptions {
  /** Pairs of persistence up to this are cancelled first. Default 0: none, not even tied ones. */
  persistence?: number;
  /** `"relative"` (default): a fraction of the range. `"absolute"`: in units of the field. */
  persistenceIs?: 'relative' | 'absolute';
  /** `"whole"` (default): every line runs to its extremum. `"merged"`: a line ends where it meets one that is there already. */
  paths?: 'whole' | 'merged';
}

/**
 * One line for each saddle and component of its link, from the saddle to the extremum. Where cancelled paths lead back over a saddle,
 * two of its lines can become one.
 */
export interface MorseComplex extends Polylines {
  /** The saddle that each line comes from. */
  saddles: Uint32Array;
  /** The extremum that each line leads to. */
  extrema: Uint32Array;
  /** −1 to a minimum, 1 to a maximum. */
  kinds: Int8Array;
  /** The vertex of each point. */
  vertices: Uint32Array;
}

/**
 * See {@link TriMesh.morseHierarchy}. A saddle of multiplicity k stands for k simple ones, each a node of its own. At a threshold
 * t > 0 the complex has the nodes with `cancelledAt` above t, and at 0 all of them; an arc leads from its saddle to its extremum or, where that is
 * cancelled, to where `into` leads from there.
 */
export interface MorseHierarchy {
  /** The vertex of each node: the extrema first, then the saddles. */
  vertices: Uint32Array;
  /** −1 minimum, 0 saddle, 1 maximum. */
  kinds: Int8Array;
  /** The persistence of the pair that the node is cancelled with, in units of the field; infinite for those that stay. */
  cancelledAt: Float64Array;
  /** For each node the one that it is cancelled with; itself for those that stay. */
  partners: Uint32Array;
  /** For each extremum the node of the one that takes over its arcs; for others the node itself. */
  into: Uint32Array;
  /** Two nodes for each arc, a saddle and an extremum: on a surface without boundary four arcs for each saddle. */
  arcs: Uint32Array;
}

/** See {@link TriMesh.basins}. A vertex of no triangle has 4294967295. */
export interface Basins {
  /** The minimum at which the path downwards ends. */
  descending: Uint32Array;
  /** The maximum at which the path upwards ends. */
  ascending: Uint32Array;
}

/** See {@link TriMesh.smoothness}. */
export interface Smoothness {
  sobolev: number;
  laplacianNorm: number;
}

/** A matrix by its columns: column j has the entries `columnPointers[j]` up to, not including, `columnPointers[j + 1]`. */
export interface SparseMatrix {
  rows: number;
  columns: number;
  columnPointers: Uint32Array;
  /** The row of each entry, ascending in each column. */
  rowIndices: Uint32Array;
  values: Float64Array;
}

// ------------------------------------------------------------------------------------------------------------- smoothing

/**
 * Weights w_ij of the Laplacian: `"cotangent"` is (cot α + cot β)/2 of the angles facing the edge; `"intrinsicDelaunay"` is
 * the same after edges are flipped within the surface until no weight between two triangles is negative, which suits bad
 * triangles, those of zero area included; `"uniform"` is 1. These are symmetric; `"meanValue"`, and `"normalizedCotangent"`
 * with each row divided by its weight sum, are not.
 */
export type LaplacianWeights = 'cotangent' | 'meanValue' | 'normalizedCotangent' | 'uniform' | 'intrinsicDelaunay';

/** `"meanOne"` multiplies B by n/area, so that ε means the same in metres and in millimetres; `"raw"` leaves it. */
export type MassScale = 'meanOne' | 'raw';

/**
 * How closeness to f is measured, that is the B of (LᵀL + εB) x = εBf: the identity (the paper's eq. 3), the consistent mass
 * matrix or the lumped one (its eq. 5).
 */
export type Metric = 'identity' | 'mass' | 'lumped';

/**
 * The operator whose square is the smoothness: `"paper"` is LᵀL beside εB; `"fem"` is L M⁻¹ L beside εM, with the cotangent
 * Laplacian L and the lumped areas M in the units of the mesh. The latter is the Laplace–Beltrami operator by finite elements:
 * what an ε does then depends on the surface and not on how finely it is meshed.
 */
export type Operator = 'paper' | 'fem';

/**
 * The precision of factors. `"single"` takes half the memory for a factor and refines the solution to about the same accuracy;
 * where the system is too badly conditioned for that, the factor is computed in double precision after all.
 */
export type Precision = 'double' | 'single';

/** How far a long call has come. */
export interface Progress {
  /** What begins now. */
  phase: 'analysis' | 'factorization' | 'solve' | 'report';
  /** How much of the whole is done: from 0 to 1. Goes back where a way to solve the system is given up for another one. */
  fraction: number;
}

/** How systems are set up and solved. */
export interface SmootherOptions {
  /** Default `"cotangent"`, and operator `"fem"` has no other: `InapplicableOption`. */
  weights?: LaplacianWeights;
  /** Default `"paper"`. */
  operator?: Operator;
  /**
   * `"cholesky"` solves with a sparse factor. `"cg"` iterates without one: little memory, and with weights that are not
   * symmetric many iterations for small ε. `"auto"` (default) takes the route that is expected to be fastest, and one that
   * needs less memory where that is short. {@link SolverReport.route} says which it was.
   */
  solver?: 'auto' | 'cholesky' | 'cg';
  /** Of factors; iterations without one are in double precision. Default `"double"`. */
  precision?: Precision;
  /** Called while work goes on. What it throws comes out of that call; the objects stay usable. */
  onProgress?: (progress: Progress) => void;
}

/** Of Tikhonov smoothing. */
export interface TikhonovOptions {
  /**
   * ε > 0, without a unit (with scale `"raw"`: per area; with operator `"fem"`: per length⁴). Large keeps the field, small
   * smooths it; the range of interest is wide, say 1e-6 to 1e4 where ε has no unit.
   */
  epsilon: number;
  /** Default `"mass"`. Operator `"fem"` has its own: `InapplicableOption`. */
  metric?: Metric;
  /** Default `"meanOne"`. Metric `"identity"` has no mass to scale, operator `"fem"` its own: `InapplicableOption`. */
  massScale?: MassScale;
}

/** Of Tikhonov smoothing with operator `"fem"`, by a length instead of ε. */
export interface WavelengthOptions {
  /**
   * Waves of this length ℓ, in the units of the mesh, are left with half their amplitude, shorter ones with less: ε is
   * (2π/ℓ)⁴. Sensible between the mean length of the edges and the diameter of the mesh. With operator `"paper"`, or beside
   * `epsilon`: `InapplicableOption`.
   */
  cutoffWavelength: number;
}

/** Smooths fields on one mesh. What depends on the mesh alone is worked out once. */
export class Smoother {
  /** The mesh may be freed afterwards. */
  constructor(mesh: TriMesh, options?: SmootherOptions);

  /**
   * The minimiser x of ‖Lx‖² + ε·(x − f)ᵀB(x − f), from (LᵀL + εB) x = εBf; with operator `"fem"` from
   * (L M⁻¹ L + εM) x = εMf. Constants stay as they are. After an error the smoother works on as before.
   *
   * @param options `channels`: how many numbers each vertex has, side by side. Default 1
   * @throws `InvalidOption` for ε ≤ 0; `InapplicableOption`; `LengthMismatch`, `NonFiniteValue`; `NotPositiveDefinite`,
   *   `IndefinitePreconditioner` or `NotConverged` where ε is too small for the mesh; `OutOfMemory` where the mesh is too large
   *   for the solver chosen
   */
  tikhonov(values: Numbers, options: TikhonovOptions & { channels?: number }): Smoothed;
  tikhonov(values: Numbers, options: WavelengthOptions & { channels?: number }): Smoothed;

  /** Gives the memory back, as {@link TriMesh.free} does. */
  free(): void;
  [Symbol.dispose](): void;
}

/** A smoothed field and what became of it. */
export interface Smoothed {
  /** As they came in: same units, same order, channels side by side. */
  values: Float64Array;
  /** Of the first channel. */
  report: SmoothReport;
  /** Of every channel. */
  reports: SmoothReport[];
}

/** What smoothing did to a field f. Norms and differences are those of f scaled to [0, 1], so that fields can be compared. */
export interface SmoothReport {
  method: string;
  /** Of the paper, such as `"(5)"`; `"fem"` for that operator. */
  equation: string;
  epsilon: number | null;
  constraintCount: number;
  before: CriticalCounts;
  after: CriticalCounts;
  /** Greatest change: max |x − f|. */
  lInfinity: number;
  /** ‖x − f‖₂. */
  l2: number;
  /** ‖x − f‖ in the metric that was used. */
  metricNorm: number;
  /** ‖Lx‖₂. */
  laplacianNorm: number;
  /** fᵀLf. */
  sobolevBefore: number;
  /** xᵀLx. */
  sobolevAfter: number;
  /** `null` without constraints. */
  preserved: number | null;
  /** `null` without constraints. */
  freeExtrema: number | null;
  /** `null` unless it was asked for. */
  perturbationFactor: number | null;
  solver: SolverReport;
}

/** How the system was solved. */
export interface SolverReport {
  /**
   * - `"complexCholesky"`: a complex factor on the pattern of L, which solves eq. (3) and operator `"fem"`
   * - `"cholesky"`: a real factor on the pattern of LᵀL
   * - `"cgComplexCholesky"`: conjugate gradients, preconditioned by the complex factor; for eq. (5) where LᵀL is large
   * - `"cgMultigrid"`: conjugate gradients, preconditioned by multigrid, without a factor
   * - `"cgJacobi"`: conjugate gradients, preconditioned by the diagonal
   * - `"none"`: there was nothing to solve
   *
   * Only the second and the fifth can do with weights that are not symmetric.
   */
  route: 'complexCholesky' | 'cholesky' | 'cgComplexCholesky' | 'cgMultigrid' | 'cgJacobi' | 'none';
  /** Of the factor. `"doubleAfterSingle"` where single precision was asked for and was not enough. `"double"` without a factor. */
  precision: 'double' | 'single' | 'doubleAfterSingle';
  /** Size of the system. */
  unknowns: number;
  /** Entries of the factor; 0 without one. */
  factorNonzeros: number;
  /** ‖b − Ax‖/‖b‖ of the system solved, with its matrix in factored form. */
  relativeResidual: number;
  /** Corrections of the first solution. */
  refinementSteps: number;
  /** Of conjugate gradients, those for corrections included; 0 where the factor itself solves. */
  iterations: number;
}

/** Smooths one field once. For several, or for several ε, a {@link Smoother} is quicker. */
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothOptions): Smoothed;
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothByWavelengthOptions): Smoothed;

/** What {@link smooth} takes. */
export interface SmoothOptions extends SmootherOptions, TikhonovOptions {
  method?: 'tikhonov';
}

/** What {@link smooth} takes with operator `"fem"`, by a length instead of ε. */
export interface SmoothByWavelengthOptions extends SmootherOptions, WavelengthOptions {
  operator: 'fem';
  method?: 'tikhonov';
}
