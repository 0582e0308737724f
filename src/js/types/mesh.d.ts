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
 * Whether vertices that lie together become one: those at the same position (`true`), or also those within `tolerance`, a fraction of
 * the diagonal of the bounding box, from 0 (default) to below 1. Each becomes the first of them.
 */
export type Weld = boolean | { tolerance?: number };

/**
 * A triangle mesh. Any triangles will do: closed, with boundary, of several parts, non-manifold, not orientable.
 *
 * It lives in WebAssembly memory: call {@link TriMesh.free} when done, or declare it with `using`. Used after that it throws
 * `UseAfterFree`. (The garbage collector also gets there, but not soon.)
 */
export class TriMesh {
  /**
   * @param positions x, y, z of vertex 0, then of vertex 1, …
   * @param triangles three vertex numbers for each triangle; `null` for a soup, in which every three vertices are a triangle
   * @param options `weld`: whether vertices that lie together become one. Default `false`
   * @throws `PositionsNotTriples`, `TrianglesNotTriples`, `NonFinitePosition` (`vertex`), `IndexOutOfBounds` (`triangle`, `index`),
   *   `EmptyMesh`
   */
  constructor(positions: Numbers, triangles: Ids | null, options?: { weld?: Weld });

  readonly vertexCount: number;
  readonly edgeCount: number;
  readonly triangleCount: number;
  /** Sum of the triangles' areas. */
  readonly area: number;
  readonly topology: Readonly<MeshTopology>;
  /** What was put right or left out when the mesh was made. */
  readonly warnings: Diagnostic[];

  /** x, y, z of each vertex. */
  positions(): OwnFloat64Array;
  /** Three vertex numbers for each triangle. */
  triangles(): OwnUint32Array;

  /**
   * For every vertex as it was given the vertex of this mesh that it became by welding; `null` where all are as they were given. A
   * value for each vertex as given becomes one for each vertex of the mesh through it.
   */
  vertexMap(): OwnUint32Array | null;

  /**
   * The mesh of the triangles whose three vertices all have a value, which is not `NaN`, and for each of its vertices the vertex of
   * this mesh; vertices of no triangle are left out. Free it when done.
   *
   * @throws `EmptyMesh` where no triangle is left; `LengthMismatch`; `NonFiniteValue` for an infinite value
   */
  withoutMissing(values: Numbers): { mesh: TriMesh; vertices: OwnUint32Array };

  /**
   * Minima, saddles and maxima of a field. Equal values are told apart by their vertex numbers, so that at δ = 0 the index sum
   * is the Euler characteristic, whatever the field.
   *
   * @throws `LengthMismatch` (`expected`, `actual`), `NonFiniteValue` (`vertex`)
   */
  criticalPoints(values: Numbers, options?: DeltaOptions & AnalysisOptions): CriticalPoints;

  /**
   * The lines on which the field has the given values, or `count` values that cut its range into equal parts (none where the field
   * is constant, and fewer where the range holds fewer numbers), or values just below and just above `saddles`, where the lines change their shape. At most 10,000.
   *
   * @throws `NonFiniteLevel` (`index`), `LengthMismatch`, `NonFiniteValue`; `IndexOutOfBounds` (`index`) for a vertex in `saddles`;
   *   `OutOfMemory` (`bytes`) for more points than fit
   */
  levelSets(values: Numbers, levels: Numbers | { count: number } | SaddleLevels, options?: AnalysisOptions): LevelSets;

  /**
   * The mesh cut along level sets, so that every triangle lies between two levels: band k holds what is at least `levels[k − 1]`
   * and less than `levels[k]`. What a filled contour plot draws.
   *
   * @throws `NonFiniteLevel` (`index`), `LengthMismatch`, `NonFiniteValue`; `InvalidOption` for more than 10,000 levels;
   *   `OutOfMemory` (`bytes`)
   */
  bands(values: Numbers, levels: Numbers | { count: number }, options?: AnalysisOptions): Bands;

  /**
   * For every critical vertex the δ at which it stops being one, and the number of critical points at every δ. At each δ that is what
   * {@link TriMesh.criticalPoints} finds by the strict rule, exactly.
   *
   * @throws `LengthMismatch` (`expected`, `actual`), `NonFiniteValue` (`vertex`)
   */
  deltaHierarchy(values: Numbers, options?: { link?: Link } & AnalysisOptions): DeltaHierarchy;

  /**
   * Pairs every extremum with the saddle at which its component of the sublevel (superlevel) set joins that of a lower (higher)
   * extremum. The most persistent pair comes first. Slower where sheets meet.
   */
  persistence(values: Numbers, options?: AnalysisOptions): PersistencePairs;

  /** How many extrema {@link TriMesh.simplify} leaves, for every threshold. */
  persistenceCurve(values: Numbers, options?: AnalysisOptions): PersistenceCurve;

  /**
   * A field near the given one that has no other extrema than those of persistence above the threshold (`thresholdIs`:
   * `"relative"` to the range, the default, or `"absolute"`), or than those in `keep`. With a threshold no value changes by more
   * than it. Regions that become flat are tilted by the smallest steps that numbers have, so that the extrema by
   * (value, vertex number) are exactly the wanted ones; this is checked before the result is returned. (Where a pair is as
   * persistent as the threshold, these steps may come on top of it, at most as many as the flat region has vertices.)
   *
   * What is kept is told by the pairs of the given field; in the result, these extrema may be less persistent.
   *
   * @throws `NotAnExtremum` (`vertex`), `IndexOutOfBounds` (`index`) for a vertex in `keep`; `Unconstrained` (`component`) where
   *   `keep` has no minimum or no maximum in a component
   */
  simplify(values: Numbers, options: SimplifyOptions & AnalysisOptions): Simplified;

  /**
   * From each saddle the steepest paths along edges, one for each component of its lower and of its upper link, to the extrema
   * where they end. Paths of the same direction that meet go on together.
   */
  morseComplex(values: Numbers, options?: MorseComplexOptions & AnalysisOptions): MorseComplex;

  /** The Morse complex at every threshold: what is cancelled when, and into what. */
  morseHierarchy(values: Numbers, options?: AnalysisOptions): MorseHierarchy;

  /**
   * For every vertex the minimum and the maximum at which its steepest path ends, where pairs of persistence up to
   * `persistence` are cancelled, as in {@link TriMesh.morseComplex}; by default none.
   */
  basins(values: Numbers, options?: Omit<MorseComplexOptions, 'paths'> & AnalysisOptions): Basins;

  /**
   * The vertices that constraints come to, ascending, each once: stars included, with several channels those of all of them. With
   * the same `missing` they are those that smoothing constrains; vertices without a value are none of them.
   *
   * @throws `IndexOutOfBounds` (`index`); `InvalidOption`, such as for 0 clusters; `MissingValue` (`vertex`) for a vertex by number
   *   without a value
   */
  constrainedVertices(
    values: Numbers,
    constraints: Constraints,
    options?: ChannelOptions & FillOptions & ProgressOptions,
  ): OwnUint32Array;

  /**
   * How rough a field is: its Sobolev semi-norm fᵀLf and ‖Lf‖₂, of the values as they are. With `missing: "omit"` L is that of the
   * mesh without the triangles that have a missing vertex.
   */
  smoothness(values: Numbers, options?: { weights?: LaplacianWeights } & AnalysisOptions): Smoothness;

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
