/** Counts as steps over δ: what they are at a δ, and how to draw them. */
import type { Hierarchy, Steps } from '../protocol';

export interface Counts {
  minima: number;
  maxima: number;
  saddles: number;
}

/** Only the changes within a bin of this many over the whole width can be told apart on a screen. */
const BINS = 2000;

function rowAt(deltas: Float64Array, delta: number): number {
  let low = 0;
  let high = deltas.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (deltas[middle]! <= delta) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}

export function countsAt(steps: Steps, delta: number): Counts {
  const row = rowAt(steps.delta, delta);
  return { minima: steps.minima[row]!, maxima: steps.maxima[row]!, saddles: steps.saddles[row]! };
}

/** Whether a critical point is left at δ. At 0 all are, even those that only their number tells from an equal neighbour. */
export function staysAt({ vertices, vanishesAt }: Hierarchy, delta: number): (vertex: number) => boolean {
  if (delta === 0) return () => true;
  const left = new Set(vertices.filter((_, k) => vanishesAt[k]! > delta));
  return (vertex) => left.has(vertex);
}

/** The δ at which some line has a corner; of more than can be drawn, the first and the last in each bin. */
export function corners(all: readonly Steps[], end: number): number[] {
  const found: number[] = [0, end];
  for (const { delta } of all) {
    const inside = rowAt(delta, end) + 1;
    for (let k = 0; k < inside; k++) {
      const bin = (at: number): number => Math.floor((BINS * delta[at]!) / end);
      const isEnd = k === 0 || k === inside - 1 || bin(k) !== bin(k - 1) || bin(k) !== bin(k + 1);
      if (inside <= BINS || isEnd) found.push(delta[k]!);
    }
  }
  return [...new Set(found)].sort((a, b) => a - b);
}
