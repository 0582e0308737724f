/** The worker's side of saving fields. No state. */
import { writeMesh } from 'morse-smooth/files';

/** A PLY file of the mesh with fields, whose missing values are left out. */
export function fileOf(
  positions: Float64Array,
  triangles: Uint32Array,
  fields: Record<string, Float64Array>,
): Uint8Array<ArrayBuffer> {
  const options = { format: 'ply', fields: plainNames(fields), binary: true, missing: 'omit' } as const;
  return new Uint8Array(writeMesh({ positions, triangles }, options));
}

/** PLY property names are single words. */
function plainNames(fields: Record<string, Float64Array>): Record<string, Float64Array> {
  return Object.fromEntries(Object.entries(fields).map(([name, values]) => [plainName(name), values]));
}

export const plainName = (name: string): string => name.replace(/[^\w.-]+/g, '_');
