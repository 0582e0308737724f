/** Plain numbers about fields and meshes that the worker needs in several places. */

export function rangeOf(values: Float64Array): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
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
