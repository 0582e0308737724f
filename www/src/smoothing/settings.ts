/** What makes the field on the right, and everything that each method takes. */
import type { LaplacianWeights, Metric } from 'morse-smooth';
import type { Missing } from '../gaps';
import type { Settings } from '../protocol';

export type Method = 'prescribe' | 'tikhonov' | 'interpolate' | 'leastSquares' | 'lowPass' | 'bilateral' | 'simplify';
/** What finds the constrained vertices: all critical points, those left at δ, persistent pairs, clusters of values, or the user. */
export type Rule = 'critical' | 'delta' | 'persistence' | 'kMeans' | 'picked';

export interface LowPass {
  iterations: number;
  lambda: number;
  /** 0 for diffusion. */
  mu: number;
}

/** Lengths are multiples of the mean edge and values shares of the range, so that they suit any mesh and field. */
export interface Bilateral {
  iterations: number;
  radius: number;
  sigmaDistance: number;
  sigmaValue: number;
}

/** Of the method whose result has exactly the chosen extrema. */
export interface Exact {
  /** Whose pairs the threshold is for. The decisions in the diagram are about those of the input, and count for these alone. */
  of: 'input' | 'smoothed';
  keepValues: boolean;
  /** The least height of every chosen extremum, relative to the range; 0 for none in particular. */
  prominence: number;
}

export interface Smoothing {
  method: Method;
  weights: LaplacianWeights;
  /** Whether the report is to bound the influence of errors, which takes more solves. */
  bounds: boolean;
  /** What becomes of gaps in the field; only some methods can fill. */
  missing: Missing;
  epsilon: number;
  /** Of Tikhonov smoothing; with finite elements a wavelength takes the place of ε. */
  metric: Metric | 'finiteElements';
  /** A multiple of the mean edge. */
  wavelength: number;
  energy: 'harmonic' | 'biharmonic';
  lowPass: LowPass;
  bilateral: Bilateral;
  exact: Exact;
  rule: Rule;
  clusters: number;
  stars: boolean;
  unconstrained: 'error' | 'keep' | 'mean';
  /** The vertices of the rule `picked`. */
  picked: readonly number[];
}

export const INITIAL_SMOOTHING: Smoothing = {
  method: 'tikhonov',
  weights: 'cotangent',
  bounds: false,
  missing: 'omit',
  epsilon: 0.1,
  metric: 'mass',
  wavelength: 10,
  energy: 'harmonic',
  lowPass: { iterations: 20, lambda: 0.5, mu: 0 },
  bilateral: { iterations: 5, radius: 3, sigmaDistance: 1.5, sigmaValue: 0.1 },
  exact: { of: 'input', keepValues: false, prominence: 0 },
  rule: 'persistence',
  clusters: 20,
  stars: true,
  unconstrained: 'error',
  picked: [],
};

/** Of Taubin's λ|μ filter beside the default λ. */
export const TAUBIN_MU = -0.53;

export function isExact({ method }: { method: Method }): boolean {
  return method === 'prescribe';
}

export function hasConstraints({ method }: { method: Method }): boolean {
  return method === 'interpolate' || method === 'leastSquares';
}

/** Whether the method can give values to vertices that have none. */
export function canFill({ method }: { method: Method }): boolean {
  return method === 'tikhonov' || hasConstraints({ method });
}

export function byElements({ method, metric }: Pick<Smoothing, 'method' | 'metric'>): boolean {
  return (method === 'tikhonov' || isExact({ method })) && metric === 'finiteElements';
}

/** Finite elements have a wavelength instead. */
export function usesEpsilon({ method, metric }: Pick<Smoothing, 'method' | 'metric'>): boolean {
  return (
    method === 'leastSquares' || ((method === 'tikhonov' || isExact({ method })) && !byElements({ method, metric }))
  );
}

/** Whether the threshold and the decisions about pairs have a part in what the method does. */
export function usesPairs({ method, rule }: { method: Method; rule: Rule }): boolean {
  return method === 'simplify' || isExact({ method }) || (hasConstraints({ method }) && rule === 'persistence');
}

export function usesDelta({ method, rule }: { method: Method; rule: Rule }): boolean {
  return hasConstraints({ method }) && rule === 'delta';
}

/** Without what only other sides of the page depend on. */
export function smoothingOf(settings: Smoothing): Smoothing {
  const keys = Object.keys(INITIAL_SMOOTHING) as (keyof Smoothing)[];
  return Object.fromEntries(keys.map((key) => [key, settings[key]])) as unknown as Smoothing;
}

/** Everything that the constrained vertices depend on, and nothing else. */
export function constraintsKey(settings: Settings): string {
  const { field, rule, stars, delta, link, persistence, overrides, clusters, picked } = settings;
  const by = {
    critical: [],
    delta: [delta, link],
    persistence: [persistence, overrides],
    kMeans: [clusters],
    picked,
  }[rule];
  return JSON.stringify([field, rule, stars, by]);
}

/** Everything that the field after depends on, and nothing else. */
export function smoothingKey(settings: Settings): string {
  const { field, method, weights, bounds, epsilon, metric, wavelength } = settings;
  const { energy, unconstrained, persistence, overrides } = settings;
  const constraints = hasConstraints(settings) ? constraintsKey(settings) : '';
  const { exact } = settings;
  const level = byElements(settings) ? wavelength : epsilon;
  const by = {
    prescribe: [metric, level, exact, persistence, exact.of === 'input' ? overrides : []],
    tikhonov: [metric, level],
    interpolate: [energy, unconstrained, constraints],
    leastSquares: [epsilon, unconstrained, constraints],
    lowPass: [settings.lowPass],
    bilateral: [settings.bilateral],
    simplify: [persistence, overrides],
  }[method];
  const missing = canFill({ method }) ? settings.missing : 'omit';
  const operator = { simplify: [], prescribe: [weights] }[method as string] ?? [weights, bounds];
  return JSON.stringify([field, method, by, missing, operator]);
}

/** The same for the smoothed fields of all ε. Those of exact extrema are without the choice, as Tikhonov smoothing has them. */
export function familyKey(settings: Settings): string {
  const method = isExact(settings) ? 'tikhonov' : settings.method;
  return smoothingKey({ ...settings, method, epsilon: NaN });
}

/** What the saved field's name ends in. */
export function suffixOf(settings: Smoothing): string {
  const { method, energy, lowPass } = settings;
  return {
    prescribe: 'exact',
    tikhonov: byElements(settings) ? 'finite_elements' : 'tikhonov',
    interpolate: energy,
    leastSquares: 'least_squares',
    lowPass: lowPass.mu === 0 ? 'diffusion' : 'low_pass',
    bilateral: 'bilateral',
    simplify: 'simplified',
  }[method];
}
