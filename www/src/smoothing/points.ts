/** The rows of the table of critical points: what is known of each, which of them are wanted, in which order. */
import type { Found, Hierarchy, Pairs } from '../protocol';

/** Beside −1, 0 and 1: a vertex that is constrained though it is no critical point. */
export const ORDINARY = 2;

export interface Point {
  vertex: number;
  /** −1 minimum, 0 saddle, 1 maximum, or ORDINARY. */
  kind: number;
  value: number;
  /** Of its most persistent pair, in units of the field; infinite without a partner. */
  persistence: number;
  /** The relative δ at which it stops being critical. */
  vanishes: number;
}

export const COLUMNS = ['kind', 'vertex', 'value', 'persistence', 'vanishes'] as const;
export type Column = (typeof COLUMNS)[number];

export interface Order {
  by: Column;
  descending: boolean;
}

export function pointsOf(hierarchy: Hierarchy, pairs: Pairs): Point[] {
  const persistence = new Map<number, number>();
  // The most persistent pair comes first, and only the first counts.
  const note = (vertex: number, value: number): void => {
    if (!persistence.has(vertex)) persistence.set(vertex, value);
  };
  pairs.essential.forEach((vertex) => note(vertex, Infinity));
  pairs.persistence.forEach((value, k) => {
    note(pairs.extrema[k]!, value);
    note(pairs.saddles[k]!, value);
  });
  return Array.from(hierarchy.vertices, (vertex, k) => ({
    vertex,
    kind: hierarchy.kinds[k]!,
    value: hierarchy.values[k]!,
    persistence: persistence.get(vertex) ?? 0,
    vanishes: hierarchy.vanishesAt[k]!,
  }));
}

/** Constrained vertices that are no critical points. */
export function ordinaryPoints(critical: readonly Point[], { features, values }: Found): Point[] {
  if (features.length === 0) return [];
  const known = new Set(critical.map(({ vertex }) => vertex));
  return Array.from(features).flatMap((vertex, k) =>
    known.has(vertex) ? [] : [{ vertex, kind: ORDINARY, value: values[k]!, persistence: 0, vanishes: 0 }],
  );
}

/** Of equal ones the lower vertex comes first, whichever way. */
export function sorted(points: readonly Point[], { by, descending }: Order): Point[] {
  const sign = descending ? -1 : 1;
  const compare = (a: number, b: number): number => (a < b ? -sign : a > b ? sign : 0);
  return [...points].sort((a, b) => compare(a[by], b[by]) || a.vertex - b.vertex);
}
