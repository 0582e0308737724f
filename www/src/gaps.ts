/** Fields with gaps: values that are not a number (NaN) are missing. No state. */
import type { TriMesh } from 'morse-smooth';
import type { Shape } from './protocol';

/** What becomes of gaps where the method can choose: holes remain holes, or they are filled smoothly. */
export type Missing = 'omit' | 'fill';

/** One value per vertex, of which some may be missing. */
export interface Field {
  /** As they were given. */
  values: Float64Array;
  /** What is read off the field: without the values at vertices that no triangle with three values has. */
  known: Float64Array;
  /** How many vertices have no value. */
  gaps: number;
}

export function fieldFrom(values: Float64Array, triangles: Uint32Array): Field {
  const gaps = gapsIn(values);
  return { values, known: gaps > 0 ? withoutLoose(values, triangles) : values, gaps };
}

export const gapsIn = (values: Float64Array): number => values.reduce((count, x) => count + Number(Number.isNaN(x)), 0);

/** For every analysis: gaps are holes. */
export const omitting = (values: Float64Array): { missing?: 'omit' } =>
  values.some(Number.isNaN) ? { missing: 'omit' } : {};

function withoutLoose(values: Float64Array, triangles: Uint32Array): Float64Array {
  const known = new Float64Array(values.length).fill(NaN);
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = triangles.subarray(t, t + 3);
    if (!corners.some((v) => Number.isNaN(values[v]!))) for (const v of corners) known[v] = values[v]!;
  }
  return known;
}

/** Of the part that has values, which the critical points add up to. */
export function shapeOf(whole: TriMesh, values: Float64Array): Shape {
  const part = gapsIn(values) > 0 ? whole.withoutMissing(values).mesh : null;
  try {
    const { eulerCharacteristic, closed } = (part ?? whole).topology;
    return { eulerCharacteristic, closed };
  } finally {
    part?.free();
  }
}
