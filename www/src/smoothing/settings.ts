/** What makes the field on the right, and everything that each method takes. */
import type { LaplacianWeights, Metric } from 'morse-smooth';
import type { Missing } from '../gaps';
import type { Settings } from '../protocol';

export type Method = 'tikhonov' | 'interpolate' | 'leastSquares' | 'lowPass' | 'bilateral' | 'simplify';
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
  rule: 'persistence',
  clusters: 20,
  stars: true,
  unconstrained: 'error',
  picked: [],
};

/** Of Taubin's λ|μ filter beside the default λ. */
export const TAUBIN_MU = -0.53;

export function hasConstraints({ method }: { method: Method }): boolean {
  return method === 'interpolate' || method === 'leastSquares';
}

/** Whether the method can give values to vertices that have none. */
export function canFill({ method }: { method: Method }): boolean {
  return method === 'tikhonov' || hasConstraints({ method });
}

export function byElements({ method, metric }: Pick<Smoothing, 'method' | 'metric'>): boolean {
  return method === 'tikhonov' && metric === 'finiteElements';
}

/** Finite elements have a wavelength instead. */
export function usesEpsilon({ method, metric }: Pick<Smoothing, 'method' | 'metric'>): boolean {
  return method === 'leastSquares' || (method === 'tikhonov' && !byElements({ method, metric }));
}

/** Whether the threshold and the decisions about pairs have a part in what the method does. */
export function usesPairs({ method, rule }: { method: Method; rule: Rule }): boolean {
  return method === 'simplify' || (hasConstraints({ method }) && rule === 'persistence');
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
  const by = {
    tikhonov: [metric, byElements(settings) ? wavelength : epsilon],
    interpolate: [energy, unconstrained, constraints],
    leastSquares: [epsilon, unconstrained, constraints],
    lowPass: [settings.lowPass],
    bilateral: [settings.bilateral],
    simplify: [persistence, overrides],
  }[method];
  const missing = canFill({ method }) ? settings.missing : 'omit';
  return JSON.stringify([field, method, by, missing, method === 'simplify' ? [] : [weights, bounds]]);
}

/** The same for the smoothed fields of all ε. */
export function familyKey(settings: Settings): string {
  return smoothingKey({ ...settings, epsilon: NaN });
}

/** What the saved field's name ends in. */
export function suffixOf(settings: Smoothing): string {
  const { method, energy, lowPass } = settings;
  return {
    tikhonov: byElements(settings) ? 'finite_elements' : 'tikhonov',
    interpolate: energy,
    leastSquares: 'least_squares',
    lowPass: lowPass.mu === 0 ? 'diffusion' : 'low_pass',
    bilateral: 'bilateral',
    simplify: 'simplified',
  }[method];
}
