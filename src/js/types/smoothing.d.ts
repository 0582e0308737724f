/**
 * Weights w_ij of the Laplacian: `"cotangent"` is (cot α + cot β)/2 of the angles facing the edge; `"intrinsicDelaunay"` is the
 * same after edges are flipped within the surface until no weight between two triangles is negative, which suits bad triangles,
 * those of zero area included; `"uniform"` is 1. These are symmetric; `"meanValue"`, and `"normalizedCotangent"` with each row
 * divided by its weight sum, are not.
 */
export type LaplacianWeights = 'cotangent' | 'intrinsicDelaunay' | 'meanValue' | 'normalizedCotangent' | 'uniform';

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

/** How systems are set up and solved. */
export interface SmootherOptions extends ProgressOptions {
  /** Default `"cotangent"`, and operator `"fem"` has no other: `InapplicableOption`. */
  weights?: LaplacianWeights;
  /** Default `"paper"`. */
  operator?: Operator;
  /**
   * `"cholesky"` solves with a sparse factor. `"cg"` iterates without one: little memory, and with weights that are not
   * symmetric many iterations for small ε, or `NotConverged`. `"auto"` (default) takes the route that is expected to be fastest, and one that
   * needs less memory where that is short. {@link SolverReport.route} says which it was.
   */
  solver?: 'auto' | 'cholesky' | 'cg';
  /** The precision of factors; iterations without one are in double precision. Default `"double"`. */
  precision?: Precision;
  /** Whether to find {@link SmoothReport.perturbationFactor} for every result, which takes some more solves. Default false. */
  bounds?: boolean;
}

/** What smoothing makes of values that are missing, which are `NaN`. An infinite value is always an error (`NonFiniteValue`). */
export interface FillOptions {
  /**
   * `"error"` (default): a missing value fails with `NonFiniteValue` (`vertex`). `"omit"`: triangles with a missing vertex are left
   * out, as if the mesh had a hole there, and missing values come back as `NaN`. `"fill"`: smoothness is asked for on the whole mesh
   * and the data term runs over the known vertices alone, so that gaps are filled smoothly. A vertex that is missing in one channel
   * is missing in all.
   */
  missing?: 'error' | 'omit' | 'fill';
}

/** The options of Tikhonov smoothing. */
export interface TikhonovOptions extends FillOptions {
  /** With `missing: "fill"` alone: a component of the mesh without any value. Default `"error"`. */
  unconstrained?: 'error' | 'keep' | 'mean';
  /**
   * ε > 0, without a unit (with scale `"raw"`: per area; with operator `"fem"`: per length⁴). Large keeps the field, small
   * smooths it; the range of interest is wide, say 1e-6 to 1e4 where ε has no unit. Or a rule that chooses it.
   */
  epsilon: Epsilon;
  /** Default `"mass"`. Operator `"fem"` has its own: `InapplicableOption`. */
  metric?: Metric;
  /** Default `"meanOne"`. Metric `"identity"` has no mass to scale, operator `"fem"` its own: `InapplicableOption`. */
  massScale?: MassScale;
}

/** The options of Tikhonov smoothing with operator `"fem"`, by a length instead of ε. */
export interface WavelengthOptions extends FillOptions {
  /** With `missing: "fill"` alone: a component of the mesh without any value. Default `"error"`. */
  unconstrained?: 'error' | 'keep' | 'mean';
  /**
   * Waves of this length ℓ, in the units of the mesh, are left with half their amplitude, shorter ones with less: ε is
   * (2π/ℓ)⁴. Sensible between the mean length of the edges and the diameter of the mesh. With operator `"paper"`, or beside
   * `epsilon`: `InapplicableOption`.
   */
  cutoffWavelength: number;
}

/** Fields with several values per vertex. */
export interface ChannelOptions {
  /**
   * How many numbers each vertex has, side by side: channel c of vertex i is at `i * channels + c`, as in positions. Each is
   * smoothed by itself, all of them on one factor. Default 1.
   */
  channels?: number;
}

/**
 * Which vertices are constrained: their numbers, or a rule that finds them. With `stars` (default `true`) the vertices next
 * to those found are constrained, too, which interpolation needs to keep critical points with their types; numbers alone
 * mean these vertices and no others. Where there are several channels, a rule finds those of all of them together.
 */
export type Constraints =
  Ids | VertexConstraints | CriticalPointConstraints | PersistenceConstraints | KMeansConstraints;

/** Vertices by number, repeated ones once, with or without those next to them. */
export interface VertexConstraints {
  from: 'vertices';
  vertices: Ids;
  /** Default `true`. */
  stars?: boolean;
}

/** The critical points that are left at δ: by default all of them. */
export interface CriticalPointConstraints extends Omit<DeltaOptions, 'rule'> {
  from: 'criticalPoints';
  /** Default `true`. */
  stars?: boolean;
}

/** Both ends of each pair of persistence above the threshold, and all critical points without a partner. */
export interface PersistenceConstraints {
  from: 'persistence';
  threshold: number;
  /** `"relative"` (default): a fraction of the range. `"absolute"`: in units of the field. */
  thresholdIs?: 'relative' | 'absolute';
  /** Default `true`. */
  stars?: boolean;
}

/** For each of so many clusters of the values (k-means) the vertex whose value is nearest to their mean. */
export interface KMeansConstraints {
  from: 'kMeans';
  /** 1 or more. */
  clusters: number;
  /** The seed of the random numbers that the search begins with; the same seed gives the same vertices. Default 0. */
  seed?: number;
  /** Default `true`. */
  stars?: boolean;
}

/** The options of the methods with constraints. */
export interface ConstraintOptions extends ChannelOptions, FillOptions {
  constraints: Constraints;
  /**
   * What becomes of a component of the mesh without a constrained vertex: `"error"` (default) fails with `Unconstrained`
   * (`component`, and its least `vertex`), `"keep"` leaves its values, `"mean"` gives all its vertices the mean of them.
   */
  unconstrained?: 'error' | 'keep' | 'mean';
}

/** The options of interpolation. */
export interface InterpolateOptions extends ConstraintOptions {
  /**
   * `"harmonic"` (default): Lx = 0 at every vertex that is not constrained, the paper's reduced system. `"biharmonic"`: ‖Lx‖ as
   * small as can be, its eq. (6) as stated; smoother, but it may overshoot.
   */
  energy?: 'harmonic' | 'biharmonic';
}

/** The options of least squares with constraints. */
export interface LeastSquaresOptions extends ConstraintOptions {
  /** ε > 0, without a unit (with operator `"fem"`: per length²). Large fits the constrained values, small smooths. */
  epsilon: Epsilon;
  /**
   * Positive weights of the constrained vertices: for vertices by number, without stars, one for each of them as they are listed
   * (of a vertex listed twice the larger one counts), else one for each of {@link TriMesh.constrainedVertices}. Default 1 each.
   */
  weights?: Numbers;
}

/** The options of the low-pass filter. */
export interface LowPassOptions extends ChannelOptions, MissingOptions {
  /** How often the filter is applied. 0 leaves the field as it is. */
  iterations: number;
  /** The λ of the step x ← x − λD⁻¹Lx, D the diagonal of L: above 0, up to 1. Default 0.5. */
  lambda?: number;
  /**
   * The μ of a second step x ← x − μD⁻¹Lx in each iteration: from −1 to 0. Below −λ it undoes the shrinking (Taubin's λ|μ filter, such as
   * 0.5 and −0.53). Default 0: plain diffusion.
   */
  mu?: number;
}

/** The options of the bilateral filter. */
export interface BilateralOptions extends ChannelOptions, MissingOptions {
  /** How often the filter is applied. 0 leaves the field as it is. */
  iterations: number;
  /** Neighbours of a vertex are the vertices within this distance through space, in the units of the mesh. Positive. */
  radius: number;
  /** Standard deviation of the weight by distance, in the units of the mesh. Positive. */
  sigmaDistance: number;
  /** Standard deviation of the weight by difference, in the units of the field. Positive. */
  sigmaValue: number;
}

/**
 * Smooths fields on one mesh. What depends on the mesh alone is worked out once. Every method calls its own `onProgress`, or else the
 * one that the smoother was made with.
 */
export class Smoother {
  /**
   * The mesh may be freed afterwards. Where the mesh is large, `onProgress` is called while the operators are assembled, too, with the
   * phase `"analysis"` and the fraction 0, and can stop that: what the smoother is made for has not begun.
   */
  constructor(mesh: TriMesh, options?: SmootherOptions);

  /**
   * The minimiser x of ‖Lx‖² + ε·(x − f)ᵀB(x − f), from (LᵀL + εB) x = εBf; with operator `"fem"` from
   * (L M⁻¹ L + εM) x = εMf. Constants stay as they are. After an error the smoother works on as before.
   *
   * @throws `InvalidOption` for ε ≤ 0; `InapplicableOption`; `LengthMismatch`, `NonFiniteValue`; `NotPositiveDefinite`,
   *   `IndefinitePreconditioner` or `NotConverged` where ε is too small for the mesh; `OutOfMemory` where the mesh is too large
   *   for the solver chosen
   */
  // The last one is that of which the compiler speaks where none fits.
  tikhonov(values: Numbers, options: WavelengthOptions & ChannelOptions & ProgressOptions): Smoothed;
  tikhonov(values: Numbers, options: TikhonovOptions & ChannelOptions & ProgressOptions): Smoothed;

  /**
   * Keeps the values of the constrained vertices to the last bit, and finds smooth ones for the others. With stars, all
   * constrained critical points keep their types. {@link SmoothReport.maximumPrinciple} tells what harmonic interpolation
   * promises about other extrema.
   *
   * @throws as {@link Smoother.tikhonov}; `Unconstrained`; `IndexOutOfBounds` (`index`) for a constrained vertex
   */
  interpolate(values: Numbers, options: InterpolateOptions & ProgressOptions): Smoothed;

  /**
   * The minimiser x of ‖Lx‖² + ε·Σ w_i (x_i − f_i)² over the constrained vertices i, from (LᵀL + εΔ) x = εΔf (the paper's eq. 7):
   * between these, values are free.
   *
   * @throws as {@link Smoother.interpolate}; `LengthMismatch` or `InvalidWeight` (`vertex`, `index`) for the weights
   */
  leastSquares(values: Numbers, options: LeastSquaresOptions & ProgressOptions): Smoothed;

  /**
   * Laplacian filtering, step by step: what the paper compares itself with. No system is solved.
   *
   * @throws `Diverged` (`iterations`) where negative weights make the values grow beyond all bounds
   */
  lowPass(values: Numbers, options: LowPassOptions & ProgressOptions): Smoothed;

  /**
   * The bilateral filter, which the paper compares itself with as well: every value moves by the mean difference to its neighbours,
   * weighted by distance and by difference, so that steps stay sharp. Takes time in proportion to the vertices within the radius.
   */
  bilateral(values: Numbers, options: BilateralOptions & ProgressOptions): Smoothed;

  /**
   * The smoothest field that has exactly the chosen minima and maxima: of all fields that rise along the same steps as the smoothed
   * field once other extrema are flooded, the one of the least ‖Lx‖² + ε‖x − f‖². On a closed surface it has minima + maxima − χ saddles.
   * Classification has confirmed its extrema when it is returned.
   *
   * @throws as {@link Smoother.tikhonov}, with constraints as {@link Smoother.leastSquares}; `IndexOutOfBounds` (`index`),
   *   `NotAnExtremum` (`vertex`), `ConflictingExtremum` (`vertex`: a minimum and a maximum), `AdjacentExtrema` (`first`, `second`, `kind`),
   *   `TooFewExtrema` (`kind`, `wanted`, `found`) for the extrema; `Unconstrained` (`component`, `vertex`) for a component without a minimum or a maximum; `Infeasible` (`from`,
   *   `to`) where kept values, the range or the prominence contradict each other; `ConstantField`; `InapplicableOption` for several
   *   channels and for `missing: "fill"`; `NotConverged`
   */
  prescribe(values: Numbers, options: PrescribeByWavelengthOptions & ProgressOptions): Prescribed;
  prescribe(values: Numbers, options: PrescribeByLeastSquaresOptions & ProgressOptions): Prescribed;
  prescribe(values: Numbers, options: PrescribeOptions & ProgressOptions): Prescribed;

  /**
   * The smoothed fields of all ε at once: six or seven factorisations, after which each ε takes milliseconds. Only one call of the smoother
   * or of its families' `grow` runs at a time.
   *
   * @throws as the method; `InvalidOption` for the range and the tolerance
   */
  family(values: Numbers, options?: FamilyOptions): SmoothingFamily;

  /** Norms and numbers of critical points along ε, by a family that is made and freed for it. */
  sweep(values: Numbers, options?: FamilyOptions & SweepOptions): Sweep;

  /** Gives the memory back, as {@link TriMesh.free} does. */
  free(): void;
  [Symbol.dispose](): void;
}

/** A smoothed field and what became of it. */
export interface Smoothed {
  /** The values as they came in: in the same units and order, channels side by side. */
  values: OwnFloat64Array;
  /** The report of the first channel. */
  report: SmoothReport;
  /** The reports of all channels. */
  reports: SmoothReport[];
}

/** What smoothing did to a field f. Norms and differences are those of f scaled to [0, 1], so that fields can be compared. */
export interface SmoothReport {
  method: 'tikhonov' | 'interpolate' | 'leastSquares' | 'lowPass' | 'bilateral' | 'prescribe';
  /** The equation of the paper, such as `"(5)"`, or one of its references; `"fem"` for that operator. */
  equation: string;
  /** The ε that was used; `null` where there is none. */
  epsilon: number | null;
  /** How ε was chosen; `null` where it was given, or there is none. */
  choice: ChosenEpsilon | null;
  /** How many vertices are constrained, stars included. */
  constraintCount: number;
  before: CriticalCounts;
  after: CriticalCounts;
  /** Greatest change: max |x − f|. */
  lInfinity: number;
  /** ‖x − f‖₂. */
  l2: number;
  /** ‖x − f‖ in the metric that was used: with least squares over the constrained vertices, by their weights. */
  metricNorm: number;
  /** ‖Lx‖₂. */
  laplacianNorm: number;
  /** fᵀLf. */
  sobolevBefore: number;
  /** xᵀLx. */
  sobolevAfter: number;
  /** How many critical points of the field are among the constrained vertices, stars left out. `null` without constraints. */
  constrainedCriticalPoints: number | null;
  /** How many of those are critical points of the same type and multiplicity still. `null` without constraints. */
  preserved: number | null;
  /** Minima and maxima of the result at vertices that are not constrained. `null` without constraints. */
  freeExtrema: number | null;
  /**
   * If the values change by e, the result changes by at most this times ‖e‖₂ (sections 4.2 and 4.3 of the paper; for interpolation, e
   * is a change of the constrained values). `null` unless `bounds` asks for it, for the bilateral filter, which is not linear, and
   * where rounding hides the least eigenvalue.
   */
  perturbationFactor: number | null;
  /** What harmonic interpolation promises about extrema; `null` for all else. */
  maximumPrinciple: MaximumPrinciple | null;
  solver: SolverReport;
}

/**
 * Where no weight is negative, each free value of a harmonic interpolation is a weighted mean of its neighbours', and no free vertex
 * an extremum among them. With weights `"intrinsicDelaunay"` only boundary edges, and those of three triangles and more, can have
 * negative weights; the neighbours are then those of the intrinsic triangulation.
 */
export interface MaximumPrinciple {
  /** The least weight between a free vertex and a neighbour; 0 where there is none. */
  smallestWeight: number;
  /** Free vertices that are extrema among the neighbours that L couples them with, by more than rounding (1e-12 of the range). */
  extrema: number;
  /** Free vertices that are extrema, in the same sense, among the neighbours along the mesh's own edges: counted, not promised. */
  meshExtrema: number;
}

/** How the system was solved. */
export interface SolverReport {
  /**
   * - `"complexCholesky"`: a complex factor on the pattern of L, which solves eq. (3) and operator `"fem"`
   * - `"cholesky"`: a real factor on the pattern of LᵀL
   * - `"cgComplexCholesky"`: conjugate gradients, preconditioned by the complex factor; for eq. (5) where LᵀL is large
   * - `"cgCholesky"`: conjugate gradients, preconditioned by the real factor of a matrix nearby; where the triangles are so thin that
   *   rounding takes a pivot of LᵀL
   * - `"cgMultigrid"`: conjugate gradients, preconditioned by multigrid, without a factor
   * - `"cgJacobi"`: conjugate gradients, preconditioned by the diagonal
   * - `"family"`: the space of a {@link SmoothingFamily}
   * - `"none"`: there was nothing to solve, or the method is a filter
   *
   * Only the second and the fifth can do with weights that are not symmetric. Interpolation takes the second, on the pattern of L where
   * it is harmonic, the fourth or the fifth.
   */
  route:
    | 'complexCholesky'
    | 'cholesky'
    | 'cgComplexCholesky'
    | 'cgCholesky'
    | 'cgMultigrid'
    | 'cgJacobi'
    | 'family'
    | 'none';
  /** The precision of the factor. `"doubleAfterSingle"` where single precision was asked for and was not enough. `"double"` without a factor. */
  precision: 'double' | 'single' | 'doubleAfterSingle';
  /** Size of the system; 0 for filters. */
  unknowns: number;
  /** Entries of the factor; 0 without one. */
  factorNonzeros: number;
  /**
   * ‖b − Ax‖/‖b‖ of the system solved, with its matrix in factored form. No measure of the error: where few vertices are constrained
   * it can be large though x is right to many digits.
   */
  relativeResidual: number;
  /** Corrections of the first solution. */
  refinementSteps: number;
  /** Iterations of conjugate gradients, those for corrections included, or of a filter; 0 where the factor itself solves. */
  iterations: number;
}

/**
 * Smooths once. For several fields, or for several ε, a {@link Smoother} is quicker. The method is `"tikhonov"`, or
 * `"leastSquares"` where there are constraints, unless named.
 */
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothByWavelengthOptions): Smoothed;
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothByLeastSquaresOptions): Smoothed;
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothByInterpolationOptions): Smoothed;
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothByPrescriptionOptions): Prescribed;
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothByWavelengthPrescriptionOptions): Prescribed;
export function smooth(mesh: TriMesh, values: Numbers, options: SmoothByConstrainedPrescriptionOptions): Prescribed;
export function smooth(mesh: TriMesh, values: Numbers, options?: SmoothOptions): Smoothed;

/** What {@link smooth} takes. */
export interface SmoothOptions extends SmootherOptions, Omit<TikhonovOptions, 'epsilon'>, ChannelOptions {
  method?: 'tikhonov';
  /** As for {@link Smoother.tikhonov}. Default `"auto"`. */
  epsilon?: Epsilon;
  constraints?: undefined;
}

/** What {@link smooth} takes with operator `"fem"`, by a length instead of ε. */
export interface SmoothByWavelengthOptions extends SmootherOptions, WavelengthOptions, ChannelOptions {
  operator: 'fem';
  method?: 'tikhonov';
  constraints?: undefined;
}

/** What {@link smooth} takes for least squares; weights of constraints are for {@link Smoother.leastSquares}. */
export interface SmoothByLeastSquaresOptions extends SmootherOptions, Omit<LeastSquaresOptions, 'weights' | 'epsilon'> {
  method?: 'leastSquares';
  /** As for {@link Smoother.leastSquares}. Default `"auto"`. */
  epsilon?: Epsilon;
}

/** What {@link smooth} takes for interpolation. */
export interface SmoothByInterpolationOptions extends SmootherOptions, InterpolateOptions {
  method: 'interpolate';
}
