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

/** The part of a mesh whose triangles have three values, or all of it. */
export interface Part {
  mesh: TriMesh;
  values: Float64Array;
  /** The numbers that vertices have in the part; those without a value are left out. */
  into(vertices: Iterable<number>): number[];
  /** Numbers in the part as those in the mesh. */
  back(vertices: Uint32Array): Uint32Array<ArrayBuffer>;
}

/** For what takes no gaps. */
export function onPart<T>(whole: TriMesh, values: Float64Array, use: (part: Part) => T): T {
  const back = (vertices: Uint32Array): Uint32Array<ArrayBuffer> => new Uint32Array(vertices);
  if (gapsIn(values) === 0) return use({ mesh: whole, values, into: (vertices) => [...vertices], back });
  const { mesh, vertices } = whole.withoutMissing(values);
  const numbers = new Map(Array.from(vertices, (vertex, number) => [vertex, number]));
  try {
    return use({
      mesh,
      values: Float64Array.from(vertices, (vertex) => values[vertex]!),
      into: (wanted) => [...wanted].flatMap((vertex) => numbers.get(vertex) ?? []),
      back: (found) => Uint32Array.from(found, (number) => vertices[number]!),
    });
  } finally {
    mesh.free();
  }
}

/** Of the part that has values, which the critical points add up to. */
export const shapeOf = (mesh: TriMesh, values: Float64Array): Shape =>
  onPart(mesh, values, (part) => {
    const { eulerCharacteristic, closed } = part.mesh.topology;
    return { eulerCharacteristic, closed };
  });
