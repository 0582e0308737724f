/**
 * ε, or a rule that chooses it. {@link SmoothReport.choice} says which ε was taken and why.
 *
 * - `"auto"`: the rule that came nearest to the best ε in most of the cases measured, `"gcv"`
 * - `"gcv"`: generalised cross-validation, ‖x − f‖²/(n − tr)² made least; right where the noise of neighbouring vertices is independent
 * - `"lCurve"`: the corner of the curve (ln ‖x − f‖, ln ‖Lx‖), the point of its largest curvature
 * - `"discrepancy"`: the largest ε whose residual is as large as noise of standard deviation `noise` makes it, in the units of the field;
 *   without `noise`, its level is estimated from the field
 * - `"atMostCriticalPoints"`: the largest ε, of twenty in each decade, that leaves no more than `count` critical points, saddles with
 *   multiplicity; `TooManyCriticalPoints` where none does
 *
 * Each takes a {@link SmoothingFamily}: about five factorisations before the one for the ε that is chosen.
 */
export type Epsilon = number | EpsilonRule;

/** A rule that chooses ε: see {@link Epsilon}. */
export type EpsilonRule =
  | 'auto'
  | { rule: 'gcv' | 'lCurve' }
  | { rule: 'discrepancy'; noise?: number }
  | { rule: 'atMostCriticalPoints'; count: number };

/** An ε that a rule chose. */
export interface ChosenEpsilon {
  epsilon: number;
  rule: 'gcv' | 'lCurve' | 'discrepancy' | 'atMostCriticalPoints';
  /** Why, in a sentence. */
  reason: string;
  /** The ε that came next: other minima or corners, the best one first. */
  runnersUp: number[];
  /** Where the level of the noise was estimated: the first channel's. */
  noise: NoiseLevel | null;
}

/** The level of the noise of a field. */
export interface NoiseLevel {
  /**
   * In the units of the field: the size of what smoothing by the ε of cross-validation takes away, over the degrees of freedom that it takes
   * away.
   */
  standardDeviation: number;
  /** The same from second differences along edges: too large where the mesh is coarse for the field. */
  byDifferences: number;
  /** How far the two agree: to within 15 %, to within a factor of 1.5, or no better. */
  confidence: 'high' | 'medium' | 'low';
}

/** The options of {@link Smoother.family}. */
export interface FamilyOptions extends ChannelOptions, FillOptions, ProgressOptions {
  /** Default `"tikhonov"`, with constraints `"leastSquares"`. */
  method?: 'tikhonov' | 'leastSquares';
  /** As for {@link Smoother.tikhonov}. */
  metric?: Metric;
  /** As for {@link Smoother.tikhonov}. */
  massScale?: MassScale;
  /** As for {@link Smoother.leastSquares}. */
  constraints?: Constraints;
  /** As for {@link Smoother.leastSquares}, one for each constrained vertex. */
  weights?: Numbers;
  /** As for the method. */
  unconstrained?: 'error' | 'keep' | 'mean';
  /** The least and the largest ε. Default `[1e-6, 1e4]`. */
  epsilonRange?: [number, number];
  /** The largest relative error over the range. Default 1e-6. */
  tolerance?: number;
  /** Where the space begins, and is good first; beyond the range, its nearer end. Default 1. */
  epsilon?: number;
  /** The most factorisations; {@link SmoothingFamily.grow} takes one more each time. Default as many as the tolerance needs. */
  factorizations?: number;
}

/**
 * The smoothed fields for all ε of a range, in a space of a few dozen vectors: a product with them for each ε. Made by
 * {@link Smoother.family}; takes about 900 bytes for each vertex and channel while it grows, half of that afterwards.
 *
 * ε outside of the range fails with `InvalidOption`.
 */
export class SmoothingFamily {
  private constructor();
  readonly epsilonRange: [number, number];
  /** The number of vectors, for all channels together. */
  readonly dimension: number;
  readonly factorizations: number;
  /** The ε that factors were computed for, in that order. */
  readonly shifts: OwnFloat64Array;
  /**
   * The largest estimated relative error ‖x − x_ε‖₂/‖x_ε‖₂ over the range, of the field scaled to [0, 1]. An estimate: on the meshes
   * measured it was between a third of the largest error and ten times as large.
   */
  readonly errorEstimate: number;
  /** Whether the tolerance is reached, or more factorisations would bring it no nearer. */
  readonly complete: boolean;
  /** The estimated relative error for one ε. */
  errorAt(epsilon: number): number;
  /** One factorisation more, where the estimated error is largest. Returns whether the family is complete; then nothing is done. */
  grow(options?: ProgressOptions): boolean;
  /** The smoothed values alone, in milliseconds; {@link SmoothingFamily.at} adds the report. */
  values(epsilon: number): OwnFloat64Array;
  /** As {@link Smoother.tikhonov} or {@link Smoother.leastSquares} returns it, with the route `"family"`. */
  at(epsilon: number, options?: ProgressOptions): Smoothed;
  /** Norms, and on demand numbers of critical points, along ε. */
  sweep(options?: SweepOptions): Sweep;
  /** Chooses ε. Default `"auto"`. */
  choose(rule?: EpsilonRule, options?: ProgressOptions): ChosenEpsilon;
  /** Which extrema are there for which ε, the longest lived first. */
  lives(options?: LivesOptions): ExtremumLives;
  /** Gives the memory back, as {@link TriMesh.free} does. */
  free(): void;
  [Symbol.dispose](): void;
}

/** The options of {@link SmoothingFamily.sweep}. */
export interface SweepOptions extends ProgressOptions {
  /** Default 41 in equal steps of their logarithms, or four in each decade of another range, both ends included. */
  epsilons?: Numbers;
  /** Whether critical points are counted, which takes longer than all the rest. Default false. */
  counts?: boolean;
  /** Default 0, the first. */
  channel?: number;
}

/** What becomes of a field along ε, one entry for each. Norms are of the field scaled to [0, 1], as in {@link SmoothReport}. */
export interface Sweep {
  epsilons: OwnFloat64Array;
  /** max |x − f|. */
  lInfinity: OwnFloat64Array;
  /** ‖x − f‖ in the metric used: falls as ε grows. */
  metricNorm: OwnFloat64Array;
  /** ‖Lx‖₂: grows with ε. */
  laplacianNorm: OwnFloat64Array;
  /** xᵀLx. */
  sobolev: OwnFloat64Array;
  /** Empty unless `counts`. */
  minima: OwnUint32Array;
  maxima: OwnUint32Array;
  /** With multiplicity. */
  saddles: OwnUint32Array;
  /** The place in `epsilons` that is nearest to the corner of the L-curve. */
  lCurveCorner: number;
}

/** The options of {@link SmoothingFamily.lives}. */
export interface LivesOptions extends ProgressOptions {
  /** Default 0, the first. */
  channel?: number;
  /** How many ε in each decade are looked at, 1 to 100. Default 8. */
  perDecade?: number;
}

/**
 * Extrema followed from large ε to small, the longest lived first: a ranking of features by the scales at which they are there. From one
 * ε to the next an extremum goes to where the steepest path from it ends; of several that meet, the longest lived goes on.
 */
export interface ExtremumLives {
  /** −1 minimum, 1 maximum. */
  kinds: OwnInt8Array;
  /** The vertex at the largest ε at which it is there, and at the least. */
  firstVertices: OwnUint32Array;
  lastVertices: OwnUint32Array;
  largestEpsilons: OwnFloat64Array;
  leastEpsilons: OwnFloat64Array;
}
