/** The user's side of exact extrema: which vertices are marked as chosen, and what is said of them. */
import type { ExactReport, Found } from '../protocol';

export const BY_SMOOTHED = 'The threshold is for the smoothed field; dots: input, crosses: result';

export const EXACT_PREVIEW = 'Preview: the chosen extrema, still rough';

/** Of the result, where nobody knows them before. */
export function extremaOf(exact: ExactReport | null): number[] {
  return exact ? [...exact.minima, ...exact.maxima].sort((a, b) => a - b) : [];
}

/** As constraints are marked, without neighbours. */
export function foundOf(vertices: readonly number[]): Found {
  const features = Uint32Array.from(vertices);
  return { features, values: new Float64Array(features.length), all: features };
}
