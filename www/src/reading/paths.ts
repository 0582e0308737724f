/** The way along the Morse complex from a saddle to the extremum that it is paired with. */
import type { Arcs } from '../protocol';
import type { Lit } from './reading';

/**
 * The saddle's own lines may lead to extrema that were joined to the wanted one before: from those the way goes on over
 * lower saddles (higher ones, for a maximum), and over no others, so that it stays in the component that the pair is about.
 */
export class Paths {
  /** Lines by the vertex of either end, those downwards apart from those upwards. */
  private readonly ends: Record<-1 | 1, Map<number, number[]>> = { [-1]: new Map(), [1]: new Map() };

  constructor(private readonly arcs: Arcs) {
    arcs.kinds.forEach((kind, line) => {
      const ends = this.ends[kind < 0 ? -1 : 1];
      for (const vertex of [arcs.saddles[line]!, arcs.extrema[line]!]) {
        const lines = ends.get(vertex);
        if (lines) lines.push(line);
        else ends.set(vertex, [line]);
      }
    });
  }

  /** The two vertices of each segment; empty where there is no way. */
  between({ extremum, saddle, kind }: Lit): Uint32Array {
    const { arcs } = this;
    const ends = this.ends[kind < 0 ? -1 : 1];
    const height = (line: number): number => -kind * arcs.heights[line]!;
    const first = ends.get(saddle)?.[0];
    if (first === undefined) return new Uint32Array(0);
    const start = height(first);
    /** The line over which each vertex was reached first: the fewest lines, then. */
    const reached = new Map<number, number>([[saddle, -1]]);
    const queue = [saddle];
    for (let at = 0; at < queue.length && !reached.has(extremum); at++) {
      for (const line of ends.get(queue[at]!) ?? []) {
        const [from, to] = [arcs.saddles[line]!, arcs.extrema[line]!];
        if (from !== saddle && height(line) > start) continue;
        for (const next of [from, to]) {
          if (reached.has(next)) continue;
          reached.set(next, line);
          queue.push(next);
        }
      }
    }
    return this.segments(this.back(extremum, reached));
  }

  private back(extremum: number, reached: ReadonlyMap<number, number>): number[] {
    const lines: number[] = [];
    let vertex = extremum;
    for (let line = reached.get(vertex); line !== undefined && line >= 0; line = reached.get(vertex)) {
      lines.push(line);
      vertex = this.arcs.extrema[line] === vertex ? this.arcs.saddles[line]! : this.arcs.extrema[line]!;
    }
    return lines;
  }

  private segments(lines: readonly number[]): Uint32Array {
    const { offsets, vertices } = this.arcs;
    const joined: number[] = [];
    for (const line of lines)
      for (let i = offsets[line]!; i + 1 < offsets[line + 1]!; i++) joined.push(vertices[i]!, vertices[i + 1]!);
    return Uint32Array.from(joined);
  }
}
