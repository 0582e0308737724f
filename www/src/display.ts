/** From the package's double-precision arrays to what the graphics card wants. No mathematics of fields here. */
import type { LevelSets, MorseComplex, Polylines, TriMesh } from 'morse-smooth';
import type { DisplayMesh } from './protocol';

/** Moves the bounding box's middle to the origin and the farthest vertex to distance 1. */
export interface Placement {
  centre: [number, number, number];
  scale: number;
}

export function placementOf(positions: Float64Array): Placement {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    const axis = i % 3;
    const value = positions[i]!;
    if (value < low[axis]!) low[axis] = value;
    if (value > high[axis]!) high[axis] = value;
  }
  const centre = low.map((value, axis) => (value + high[axis]!) / 2) as [number, number, number];
  let farthest = 0;
  for (let i = 0; i < positions.length; i += 3) {
    farthest = Math.max(
      farthest,
      Math.hypot(positions[i]! - centre[0], positions[i + 1]! - centre[1], positions[i + 2]! - centre[2]),
    );
  }
  return { centre, scale: farthest > 0 ? 1 / farthest : 1 };
}

/** Subtracting the centre in double precision keeps far-away coordinates (maps in metres) from jittering in single. */
export function placed(points: Float64Array, { centre, scale }: Placement): Float32Array<ArrayBuffer> {
  const moved = new Float32Array(points.length);
  for (let i = 0; i < points.length; i++) moved[i] = (points[i]! - centre[i % 3]!) * scale;
  return moved;
}

/** Things that are thin along z (terrain, plates) are looked at from above; everything else stands on y. */
function upOf(positions: Float32Array): 'y' | 'z' {
  const extent = [0, 0, 0];
  for (let i = 0; i < positions.length; i++) extent[i % 3] = Math.max(extent[i % 3]!, Math.abs(positions[i]!));
  return extent[2]! < 0.75 * Math.min(extent[0]!, extent[1]!) ? 'z' : 'y';
}

/**
 * Whether the triangles face inwards, so that normals and with them the glyphs would sink into the surface.
 *
 * Three times the enclosed volume over the area is 1 for a ball and about 0 for a sheet, which has no inside.
 */
function facesInwards(positions: Float32Array, triangles: Uint32Array): boolean {
  let volume = 0;
  let area = 0;
  const corner = (t: number, k: number, axis: number): number => positions[3 * triangles[3 * t + k]! + axis]!;
  for (let t = 0; 3 * t < triangles.length; t++) {
    const [ax, ay, az] = [corner(t, 0, 0), corner(t, 0, 1), corner(t, 0, 2)];
    const [ux, uy, uz] = [corner(t, 1, 0) - ax, corner(t, 1, 1) - ay, corner(t, 1, 2) - az];
    const [vx, vy, vz] = [corner(t, 2, 0) - ax, corner(t, 2, 1) - ay, corner(t, 2, 2) - az];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    volume += ax * nx + ay * ny + az * nz;
    area += Math.hypot(nx, ny, nz);
  }
  return volume < -0.1 * area;
}

export function displayMesh(mesh: TriMesh, positions: Float64Array, placement: Placement): DisplayMesh {
  const moved = placed(positions, placement);
  const triangles = new Uint32Array(mesh.triangles());
  if (facesInwards(moved, triangles)) {
    for (let t = 0; t < triangles.length; t += 3) triangles.subarray(t, t + 2).reverse();
  }
  return { positions: moved, triangles, area: mesh.area * placement.scale ** 2, up: upOf(moved) };
}

export function rangeOf(values: Float64Array): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

/** Where each value stands in the range, 0 to 1; values beyond its ends are clamped. A constant field is all 0.5. */
export function shadesOf(values: Float64Array, [low, high]: [number, number]): Float32Array<ArrayBuffer> {
  const shades = new Float32Array(values.length);
  const width = high - low;
  for (let i = 0; i < values.length; i++) {
    shades[i] = width > 0 ? Math.min(1, Math.max(0, (values[i]! - low) / width)) : 0.5;
  }
  return shades;
}

/** After − before as shades: 0.5 where nothing has changed, 0 or 1 at the largest difference. */
export function differenceOf(
  before: Float64Array,
  after: Float64Array,
): { largest: number; shades: Float32Array<ArrayBuffer> } {
  let largest = 0;
  for (let i = 0; i < after.length; i++) largest = Math.max(largest, Math.abs(after[i]! - before[i]!));
  const shades = new Float32Array(after.length);
  for (let i = 0; i < after.length; i++) shades[i] = largest > 0 ? 0.5 + (after[i]! - before[i]!) / largest / 2 : 0.5;
  return { largest, shades };
}

/** The mean length of the triangles' sides. */
export function meanEdgeOf(positions: Float64Array, triangles: Uint32Array): number {
  let sum = 0;
  for (let k = 0; k < triangles.length; k++) {
    const from = 3 * triangles[k]!;
    const to = 3 * triangles[k % 3 === 2 ? k - 2 : k + 1]!;
    sum += Math.hypot(
      positions[to]! - positions[from]!,
      positions[to + 1]! - positions[from + 1]!,
      positions[to + 2]! - positions[from + 2]!,
    );
  }
  return sum > 0 ? sum / triangles.length : 1;
}

/** Pairs of points, six numbers a segment. */
export function segmentsOf(lines: LevelSets, placement: Placement): Float32Array<ArrayBuffer> {
  return segments(
    lines,
    placement,
    () => true,
    (k) => lines.closed[k] === 1,
  );
}

/** The lines of one direction, in the same form. */
export function pathsOf(complex: MorseComplex, kind: -1 | 1, placement: Placement): Float32Array<ArrayBuffer> {
  return segments(
    complex,
    placement,
    (k) => complex.kinds[k] === kind,
    () => false,
  );
}

function segments(
  lines: Polylines,
  placement: Placement,
  isWanted: (line: number) => boolean,
  isClosed: (line: number) => boolean,
): Float32Array<ArrayBuffer> {
  const points = placed(lines.points, placement);
  const count = lines.offsets.length - 1;
  let total = 0;
  for (let k = 0; k < count; k++)
    total += Math.max(0, lines.offsets[k + 1]! - lines.offsets[k]! - 1) + (isClosed(k) ? 1 : 0);
  const joined = new Float32Array(6 * total);
  let at = 0;
  const add = (from: number, to: number): void => {
    joined.set(points.subarray(3 * from, 3 * from + 3), at);
    joined.set(points.subarray(3 * to, 3 * to + 3), at + 3);
    at += 6;
  };
  for (let k = 0; k < count; k++) {
    if (!isWanted(k)) continue;
    const first = lines.offsets[k]!;
    const last = lines.offsets[k + 1]! - 1;
    for (let i = first; i < last; i++) add(i, i + 1);
    if (isClosed(k) && last > first) add(last, first);
  }
  return joined.slice(0, at);
}
