/**
 * Which minima and maxima a field shall have, and no others.
 *
 * - vertices: minima or maxima as they are in the field (`NotAnExtremum` for one that is neither)
 * - {@link NamedExtrema}: vertices, whatever they are in the field
 * - {@link PersistentExtrema}, {@link MostPersistentExtrema}: by a rule
 *
 * A component of the mesh without a chosen minimum or maximum is an error (`Unconstrained`) unless `complete` adds them. What no field
 * on the mesh can avoid, where parts of it hang together by single vertices, stays: {@link Prescribed.unavoidable}.
 */
export type Extrema = Ids | NamedExtrema | PersistentExtrema | MostPersistentExtrema;

/** The vertices that shall be minima, and those that shall be maxima. Two of one kind must not be neighbours (`AdjacentExtrema`). */
export interface NamedExtrema {
  from?: undefined;
  minima: Ids;
  maxima: Ids;
}

/** What both rules for extrema take. */
interface ExtremaByPersistence {
  from: 'persistence';
  /**
   * Whose persistence it is. `"smoothed"` (default): the field that is smoothed without prescribed extrema; its extrema cost hardly any
   * smoothness. `"input"`: the field as it came in, where noise makes vertices persistent that lie beside the places that are meant.
   */
  of?: 'smoothed' | 'input';
}

/** The extrema of persistence above the threshold, and the lowest and the highest vertex of every component of the mesh. */
export interface PersistentExtrema extends ExtremaByPersistence {
  threshold: number;
  /** `"relative"` (default): a fraction of the range of the input. `"absolute"`: in units of the field. */
  thresholdIs?: 'relative' | 'absolute';
  minima?: undefined;
  maxima?: undefined;
}

/** So many of the most persistent ones (`TooFewExtrema` where there are fewer). The lowest and the highest vertex of every component come first. */
export interface MostPersistentExtrema extends ExtremaByPersistence {
  minima: number;
  maxima: number;
  threshold?: undefined;
  thresholdIs?: undefined;
}

/** What is asked of a field with prescribed extrema, whichever functional is to be small. */
export interface ExtremaOptions extends MissingOptions {
  /** Default: those of persistence above 0.05 of the range in the smoothed field. */
  extrema?: Extrema;
  /** Whether components of the mesh without a chosen minimum or maximum get their lowest or highest vertex. Default false. */
  complete?: boolean;
  /** `"keep"`: the chosen extrema keep their values to the last bit; `Infeasible` where that leaves no room. Default `"free"`. */
  values?: 'free' | 'keep';
  /**
   * The least difference along each step from neighbour to neighbour that shapes the field, relative to the range of the input: above 0,
   * below 0.01. Default 1e-6, which survives rounding to single precision and costs next to nothing.
   */
  margin?: number;
  /**
   * The least persistence of the chosen extrema in the result, relative to the range of the input, so that none becomes shallow. Default:
   * no more than the margin makes.
   */
  prominence?: number;
  /** `"input"`: no value leaves the range of the input. Default `"free"`: what is smoothest may leave it a little. */
  range?: 'free' | 'input';
  /**
   * From how many smoothed fields the steps are taken: 1 (default), or 3 (those of ε, ε/8 and 8ε), of which the best result counts. It
   * takes as many times as long; worth it where the chosen extrema are few of the many that the smoothed field has.
   */
  representatives?: 1 | 3;
  /** Whether to take steps once more, from the result. It takes twice as long and usually gains little. Default false. */
  again?: boolean;
  /**
   * Whether the smoothed field, flooded, is enough: it has exactly the chosen extrema in little more than the time of one smoothing, but
   * is flat where others were, with the smallest steps of double precision: single precision does not tell them. `margin`, `prominence`,
   * `range: "input"`, `values: "keep"`, `representatives: 3` and `again` are not for it: `InapplicableOption`. Default false.
   */
  preview?: boolean;
}

/** The options of {@link Smoother.prescribe} with the functional of Tikhonov smoothing. */
export interface PrescribeOptions extends ExtremaOptions {
  /** As for {@link Smoother.tikhonov}. */
  epsilon: Epsilon;
  /** As for {@link Smoother.tikhonov}. */
  metric?: Metric;
  /** As for {@link Smoother.tikhonov}. */
  massScale?: MassScale;
  constraints?: undefined;
}

/** The same with operator `"fem"`, by a length instead of ε. */
export interface PrescribeByWavelengthOptions extends ExtremaOptions {
  /** As for {@link Smoother.tikhonov}. */
  cutoffWavelength: number;
  constraints?: undefined;
}

/** The options of {@link Smoother.prescribe} with the functional of least squares, whose data are the values of some vertices alone. */
export interface PrescribeByLeastSquaresOptions extends ExtremaOptions {
  /** As for {@link Smoother.leastSquares}. */
  epsilon: Epsilon;
  /** As for {@link Smoother.leastSquares}. */
  constraints: Constraints;
  /** As for {@link Smoother.leastSquares}. */
  weights?: Numbers;
  /** As for {@link Smoother.leastSquares}. */
  unconstrained?: 'error' | 'keep' | 'mean';
}

/**
 * A field with prescribed extrema. Energies are ‖Lx‖² + ε‖x − f‖² of the field scaled to [0, 1] by the range of the input, in the
 * operator and the metric that were used.
 */
export interface Prescribed extends Smoothed {
  /** The minima of the result by (value, number), ascending: the chosen ones and those that are unavoidable. */
  minima: OwnUint32Array;
  /** Its maxima. */
  maxima: OwnUint32Array;
  /** Those of them that nobody chose and no field on this mesh can do without; empty on manifolds. */
  unavoidable: OwnUint32Array;
  /** The energy of the result. */
  energy: number;
  /** The energy of the field that is smoothed without prescribed extrema: no other field has less. */
  unconstrainedEnergy: number;
  /** The least rise along a step over the one that was asked for. 0.9 or more certifies that there are no other extrema. */
  leastSlack: number;
  /** The margin that was used: the one asked for, or what double precision can tell at values far from 0. 0 for a preview. */
  margin: number;
  /** No field that rises along the same steps has less energy by more than this share of it. For a preview: no field at all. */
  gap: number;
  /** Iterations of the interior-point method, with one factorisation each, or rounds of the dual method, with none. */
  iterations: number;
  /** Solves with factors. */
  solves: number;
  /**
   * How the field was found: by an interior-point method; by multipliers of the few steps that the smoothed field lacks (`dual`), which
   * is quicker; or as the smoothed field, flooded (`preview`).
   */
  route: 'interiorPoint' | 'dual' | 'preview';
}

/** What {@link smooth} takes for prescribed extrema. */
export interface SmoothByPrescriptionOptions extends SmootherOptions, Omit<PrescribeOptions, 'epsilon'> {
  method: 'prescribe';
  /** As for {@link Smoother.prescribe}. Default `"auto"`. */
  epsilon?: Epsilon;
}

/** What {@link smooth} takes for prescribed extrema with operator `"fem"`, by a length instead of ε. */
export interface SmoothByWavelengthPrescriptionOptions extends SmootherOptions, PrescribeByWavelengthOptions {
  operator: 'fem';
  method: 'prescribe';
}

/** What {@link smooth} takes for prescribed extrema with the functional of least squares; weights are for {@link Smoother.prescribe}. */
export interface SmoothByConstrainedPrescriptionOptions
  extends SmootherOptions, Omit<PrescribeByLeastSquaresOptions, 'weights' | 'epsilon'> {
  method: 'prescribe';
  /** As for {@link Smoother.prescribe}. Default `"auto"`. */
  epsilon?: Epsilon;
}
