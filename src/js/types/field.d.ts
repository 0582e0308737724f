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
  vertices: OwnUint32Array;
  /** −1 minimum, 0 saddle, 1 maximum. */
  kinds: OwnInt8Array;
  /** How often each vertex counts: an ordinary saddle once, a monkey saddle twice, …; an extremum once. */
  multiplicities: OwnUint32Array;
  /** 1 on the boundary, else 0. */
  onBoundary: OwnUint8Array;
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
  points: OwnFloat64Array;
  /** One more than there are lines. */
  offsets: OwnUint32Array;
}

/** Level sets. A closed line does not repeat its first point. */
export interface LevelSets extends Polylines {
  /** The level of each line, not one entry for each level: a level can have several lines, or none. */
  levels: OwnFloat64Array;
  /** 1 for each line that closes, 0 for one that ends at the boundary. */
  closed: OwnUint8Array;
  /** The two ends a < b of the edge that each point lies on. */
  edges: OwnUint32Array;
  /** Where on its edge each point lies: t of (1 − t)·a + t·b. */
  parameters: OwnFloat64Array;
}

/** Two levels for each saddle: just below it and just above. */
export interface SaddleLevels {
  /** All saddles, or these vertices. */
  saddles: true | Ids;
  /** Distance of the levels from the saddle's value, relative to the range. Default 0: the nearest levels that tell sides. */
  offset?: number;
}

/** The mesh cut along level sets: see {@link TriMesh.bands}. */
export interface Bands {
  /** The levels, ascending, each once. */
  levels: OwnFloat64Array;
  /** x, y, z of each point. */
  points: OwnFloat64Array;
  /** Three points for each triangle, turned as the triangle of the mesh that it is a part of. */
  triangles: OwnUint32Array;
  /** The band of each triangle, 0 up to and including the number of levels. */
  bands: OwnUint32Array;
  /** The triangle of the mesh that each triangle is a part of. */
  parents: OwnUint32Array;
  /** The ends a ≤ b of the edge that each point lies on; twice the same where it is a vertex. */
  edges: OwnUint32Array;
  /** Where on its edge each point lies: t of (1 − t)·a + t·b. */
  parameters: OwnFloat64Array;
}

/** The critical points at every δ: see {@link TriMesh.deltaHierarchy}. A vertex is critical at δ = 0, and at every δ below the one at which it vanishes. */
export interface DeltaHierarchy {
  /** Every critical vertex at δ = 0, ascending. */
  vertices: OwnUint32Array;
  /** −1 minimum, 0 saddle, 1 maximum. */
  kinds: OwnInt8Array;
  /** The relative δ at which each vertex stops being critical: 0 where only its number tells it from an equal neighbour. */
  vanishesAt: OwnFloat64Array;
  /** The same δ in units of the field. */
  vanishesAtAbsolute: OwnFloat64Array;
  /**
   * Numbers of critical points as steps over the relative δ: row 0 is δ = 0, and row k holds from `delta[k]` up to, not
   * including, `delta[k + 1]`. (Where ties matter, row 1 begins at the least number above 0.)
   */
  delta: OwnFloat64Array;
  minima: OwnUint32Array;
  maxima: OwnUint32Array;
  /** With multiplicity. */
  saddles: OwnUint32Array;
}

/** Pairs of extrema and saddles: see {@link TriMesh.persistence}. Entry k of the first six arrays is about the same pair. */
export interface PersistencePairs {
  extrema: OwnUint32Array;
  saddles: OwnUint32Array;
  /** −1 minimum and saddle, 1 saddle and maximum. */
  kinds: OwnInt8Array;
  /** The lower of the two values. */
  birth: OwnFloat64Array;
  /** The higher of the two values. */
  death: OwnFloat64Array;
  /** death − birth; descending. */
  persistence: OwnFloat64Array;
  /** The lowest vertex of each component of the mesh. */
  essentialMinima: OwnUint32Array;
  /** The highest vertex of each component of the mesh. */
  essentialMaxima: OwnUint32Array;
  /**
   * Saddles at which a loop begins that never closes up: as many as the first Betti number, 2g on a closed orientable surface.
   * A vertex may stand there several times.
   */
  essentialSaddles: OwnUint32Array;
}

/** Numbers of extrema as steps over the threshold: see {@link TriMesh.persistenceCurve}. Row k holds from `threshold[k]` up to, not including, `threshold[k + 1]`. */
export interface PersistenceCurve {
  /** In units of the field; row 0 is 0. */
  threshold: OwnFloat64Array;
  /** Minima of persistence above the threshold, the lowest vertex of each component included. */
  minima: OwnUint32Array;
  maxima: OwnUint32Array;
}

/** What {@link TriMesh.simplify} returns. */
export interface Simplified {
  /** One value for each vertex. */
  values: OwnFloat64Array;
  /**
   * Extrema that were to go, but that no field on this mesh can do without: there are some only where parts of the mesh hang together
   * in single vertices. Ascending.
   */
  unavoidable: OwnUint32Array;
}

/** What {@link TriMesh.simplify} is to keep. */
export type SimplifyOptions =
  | { threshold: number; thresholdIs?: 'relative' | 'absolute'; keep?: undefined }
  | { keep: Ids; threshold?: undefined; thresholdIs?: undefined };

/** Which lines {@link TriMesh.morseComplex} returns. */
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
  saddles: OwnUint32Array;
  /** The extremum that each line leads to. */
  extrema: OwnUint32Array;
  /** −1 to a minimum, 1 to a maximum. */
  kinds: OwnInt8Array;
  /** The vertex of each point. */
  vertices: OwnUint32Array;
}

/**
 * The Morse complex at every threshold: see {@link TriMesh.morseHierarchy}. A saddle of multiplicity k stands for k simple ones, each a node of its own. At a threshold
 * t > 0 the complex has the nodes with `cancelledAt` above t, and at 0 all of them; an arc leads from its saddle to its extremum or, where that is
 * cancelled, to where `into` leads from there.
 */
export interface MorseHierarchy {
  /** The vertex of each node: the extrema first, then the saddles. */
  vertices: OwnUint32Array;
  /** −1 minimum, 0 saddle, 1 maximum. */
  kinds: OwnInt8Array;
  /** The persistence of the pair that the node is cancelled with, in units of the field; infinite for those that stay. */
  cancelledAt: OwnFloat64Array;
  /** For each node the one that it is cancelled with; itself for those that stay. */
  partners: OwnUint32Array;
  /** For each extremum the node of the one that takes over its arcs; for others the node itself. */
  into: OwnUint32Array;
  /** Two nodes for each arc, a saddle and an extremum: on a surface without boundary four arcs for each saddle. */
  arcs: OwnUint32Array;
}

/** Where the steepest paths end: see {@link TriMesh.basins}. A vertex of no triangle has 4294967295. */
export interface Basins {
  /** The minimum at which the path downwards ends. */
  descending: OwnUint32Array;
  /** The maximum at which the path upwards ends. */
  ascending: OwnUint32Array;
}

/** How rough a field is: see {@link TriMesh.smoothness}. */
export interface Smoothness {
  sobolev: number;
  laplacianNorm: number;
}

/** A matrix by its columns: column j has the entries `columnPointers[j]` up to, not including, `columnPointers[j + 1]`. */
export interface SparseMatrix {
  rows: number;
  columns: number;
  columnPointers: OwnUint32Array;
  /** The row of each entry, ascending in each column. */
  rowIndices: OwnUint32Array;
  values: OwnFloat64Array;
}
