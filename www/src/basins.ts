/** Colors for basins, so that neighbours differ and a basin has the same color on both sides of the page. */

/** How many colors there are; colormap.ts has them. */
export const BASIN_COLORS = 12;
/** Of a vertex in no triangle. */
const NOWHERE = 0xffffffff;
export const NO_COLOR = 255;

export interface BasinColors {
  /** For each vertex the number of its color. */
  colors: Uint8Array<ArrayBuffer>;
  /** The color of each basin, by its extremum. */
  byExtremum: Map<number, number>;
}

/**
 * Greedily, the basins with most neighbours first. Each takes the color that it has in `preferred`, where no neighbour has it,
 * else the rarest free one. More neighbours than colors is possible on a mesh with handles: then one color repeats.
 */
export function colorBasins(
  labels: Uint32Array,
  triangles: Uint32Array,
  preferred: ReadonlyMap<number, number> = new Map(),
): BasinColors {
  const neighbours = new Map<number, Set<number>>();
  for (const label of labels) if (label !== NOWHERE && !neighbours.has(label)) neighbours.set(label, new Set());
  const join = (a: number, b: number): void => {
    if (a === b) return;
    neighbours.get(a)?.add(b);
    neighbours.get(b)?.add(a);
  };
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [labels[triangles[t]!]!, labels[triangles[t + 1]!]!, labels[triangles[t + 2]!]!];
    join(a, b);
    join(b, c);
    join(c, a);
  }
  const byExtremum = new Map<number, number>();
  const uses = new Array<number>(BASIN_COLORS).fill(0);
  const order = [...neighbours].sort(([a, of], [b, other]) => other.size - of.size || a - b);
  for (const [extremum, around] of order) {
    const taken = new Set([...around].map((other) => byExtremum.get(other)));
    const wish = preferred.get(extremum);
    let color = wish !== undefined && !taken.has(wish) ? wish : -1;
    if (color < 0) {
      const free = uses.map((_, k) => k).filter((k) => !taken.has(k));
      const choice = free.length > 0 ? free : uses.map((_, k) => k);
      color = choice.reduce((best, k) => (uses[k]! < uses[best]! ? k : best));
    }
    byExtremum.set(extremum, color);
    uses[color]! += 1;
  }
  return { colors: Uint8Array.from(labels, (label) => byExtremum.get(label) ?? NO_COLOR), byExtremum };
}
