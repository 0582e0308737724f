/** Which pairs are kept: those above the threshold, but for the ones that the user has decided otherwise. */
import type { Overrides } from '../protocol';

export const NO_OVERRIDES: Overrides = { kept: [], dropped: [] };

export function hasOverrides({ kept, dropped }: Overrides): boolean {
  return kept.length + dropped.length > 0;
}

/** Pairs come in descending persistence, so that those above a threshold come first: how many they are. */
export function countAbove(persistence: Float64Array, threshold: number): number {
  let low = 0;
  let high = persistence.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (persistence[middle]! > threshold) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Numbers of the kept pairs, the most persistent one first. `threshold` is in units of the field. */
export function keptPairs(
  { extrema, persistence }: { extrema: Uint32Array; persistence: Float64Array },
  threshold: number,
  overrides: Overrides,
): number[] {
  const above = countAbove(persistence, threshold);
  if (!hasOverrides(overrides)) return Array.from({ length: above }, (_, k) => k);
  const wanted = new Set(overrides.kept);
  const unwanted = new Set(overrides.dropped);
  const kept: number[] = [];
  extrema.forEach((extremum, k) => {
    if (wanted.has(extremum) || (k < above && !unwanted.has(extremum))) kept.push(k);
  });
  return kept;
}
