/** Which pairs the user keeps: a threshold, and decisions about single pairs that go before it. */
import type { Overrides, Pairs } from '../protocol';
import { countAbove, keptPairs, NO_OVERRIDES } from './pairs';

export class Selection {
  pairs: Pairs | null = null;
  /** Lowest and highest value of the field. */
  range: [number, number] = [0, 1];
  private share = 0;
  private decided = new Map<number, 'kept' | 'dropped'>();
  private mask = new Uint8Array(0);
  private set: ReadonlySet<number> | null = null;

  setPairs(pairs: Pairs, range: [number, number]): void {
    this.pairs = pairs;
    this.range = range;
    this.renew();
  }

  /** Relative to the range. */
  get threshold(): number {
    return this.share;
  }

  set threshold(share: number) {
    this.share = share;
    this.renew();
  }

  get width(): number {
    return this.range[1] - this.range[0];
  }

  get overrides(): Overrides {
    const of = (wanted: 'kept' | 'dropped'): number[] =>
      [...this.decided]
        .flatMap(([extremum, decision]) => (decision === wanted ? [extremum] : []))
        .sort((a, b) => a - b);
    return { kept: of('kept'), dropped: of('dropped') };
  }

  set overrides({ kept, dropped }: Overrides) {
    this.decided = new Map([
      ...kept.map((extremum) => [extremum, 'kept'] as const),
      ...dropped.map((extremum) => [extremum, 'dropped'] as const),
    ]);
    this.renew();
  }

  /** The vertices that are constrained, where that is what pairs are judged by: both ends are in or the pair is out. */
  get chosen(): ReadonlySet<number> | null {
    return this.set;
  }

  set chosen(vertices: ReadonlySet<number> | null) {
    this.set = vertices;
    this.renew();
  }

  isKept(pair: number): boolean {
    return this.mask[pair] === 1;
  }

  isDecided(pair: number): boolean {
    return !this.set && this.decided.has(this.pairs!.extrema[pair]!);
  }

  /** A decision that says what the threshold says anyway is none. */
  toggle(pair: number): void {
    const { extrema, persistence } = this.pairs!;
    const keep = !this.isKept(pair);
    if (keep === pair < countAbove(persistence, this.share * this.width)) this.decided.delete(extrema[pair]!);
    else this.decided.set(extrema[pair]!, keep ? 'kept' : 'dropped');
    this.renew();
  }

  reset(): void {
    this.overrides = NO_OVERRIDES;
  }

  /** Extrema that stay, those without a partner included, and the pairs that go. */
  counts(): { minima: number; maxima: number; kept: number; dropped: number } {
    const counts = { minima: 0, maxima: 0, kept: 0, dropped: 0 };
    if (!this.pairs) return counts;
    for (const kind of this.pairs.essentialKinds) {
      if (kind < 0) counts.minima += 1;
      if (kind > 0) counts.maxima += 1;
    }
    this.mask.forEach((kept, pair) => {
      if (!kept) counts.dropped += 1;
      else if (this.pairs!.kinds[pair]! < 0) counts.minima += 1;
      else counts.maxima += 1;
      counts.kept += kept;
    });
    return counts;
  }

  private renew(): void {
    if (!this.pairs) return;
    const { set } = this;
    const { extrema, saddles } = this.pairs;
    this.mask = new Uint8Array(extrema.length);
    if (set) {
      this.mask.forEach((_, k) => (this.mask[k] = set.has(extrema[k]!) && set.has(saddles[k]!) ? 1 : 0));
      return;
    }
    for (const pair of keptPairs(this.pairs, this.share * this.width, this.overrides)) this.mask[pair] = 1;
  }
}
