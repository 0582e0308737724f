/** The panel "Reading the field": both plots, what they say in words, and what the user does to them. */
import { element, short, whole } from '../dom';
import type { Hierarchy, Overrides, Pairs, Side } from '../protocol';
import { Curve } from './curve';
import { Diagram, MOST } from './diagram';
import { Selection } from './selection';
import { countsAt } from './steps';

/** A pair of critical points, to be shown on the surface. */
export interface Lit {
  extremum: number;
  saddle: number;
  /** −1 for a minimum, 1 for a maximum. */
  kind: number;
}

export interface ReadingEvents {
  delta(value: number): void;
  /** How far δ is of interest. */
  deltaEnd(value: number): void;
  threshold(value: number): void;
  /** Some pair was decided about, or all decisions were taken back. */
  overrides(overrides: Overrides): void;
  /** A pair was clicked while pairs are judged by constrained vertices. */
  toggle(ends: number[]): void;
  lit(pair: Lit | null): void;
  /** Other pairs are kept, or the field has others. */
  kept(): void;
}

export class Reading {
  private readonly selection = new Selection();
  private readonly curve: Curve;
  private readonly diagram: Diagram;
  private readonly hierarchies: Partial<Record<Side, Hierarchy>> = {};
  private delta = 0;
  private pointed: number | null = null;
  /** Why the pairs are not those that the threshold is for; empty where they are. */
  private elsewhere = '';
  /** What a click on the surface has come to. */
  private answer = '';

  private readonly curveText = element('#curve-values', HTMLElement);
  private readonly pairText = element('#pair-values', HTMLElement);
  private readonly reset = element('#reset-pairs', HTMLButtonElement);

  constructor(private readonly events: ReadingEvents) {
    this.curve = new Curve(element('#curve', HTMLElement), {
      delta: (value) => events.delta(value),
      end: (value) => events.deltaEnd(value),
      hover: (value) => this.describeCounts(value ?? this.delta),
    });
    this.diagram = new Diagram(element('#diagram', HTMLElement), this.selection, {
      threshold: (value) => events.threshold(value),
      point: (pair) => this.point(pair),
      toggle: (pair) => {
        if (this.selection.chosen) {
          const { extrema, saddles } = this.selection.pairs!;
          return events.toggle([extrema[pair]!, saddles[pair]!]);
        }
        this.decide(pair);
      },
    });
    this.reset.addEventListener('click', () => {
      this.selection.reset();
      this.decided();
    });
  }

  get overrides(): Overrides {
    return this.selection.overrides;
  }

  setHierarchy(side: Side, hierarchy: Hierarchy | null): void {
    if (!hierarchy && !this.hierarchies[side]) return;
    if (hierarchy) this.hierarchies[side] = hierarchy;
    else delete this.hierarchies[side];
    this.curve.setSteps(side, hierarchy);
    this.describeCounts(this.delta);
  }

  setPairs(pairs: Pairs, range: [number, number]): void {
    this.selection.setPairs(pairs, range);
    this.answer = '';
    this.diagram.update(true);
    this.describePair();
    this.events.kept();
  }

  /** What the controls say; nothing is reported back. */
  setState(delta: number, threshold: number, overrides: Overrides): void {
    this.delta = delta;
    this.curve.setDelta(delta);
    this.describeCounts(delta);
    this.selection.threshold = threshold;
    this.selection.overrides = overrides;
    this.redraw();
  }

  /** Null where the threshold and decisions about pairs are what counts. */
  setChosen(vertices: ReadonlySet<number> | null): void {
    if (!vertices && !this.selection.chosen) return;
    this.selection.chosen = vertices;
    this.redraw();
  }

  setDelta(delta: number): void {
    this.delta = delta;
    this.curve.setDelta(delta);
    this.describeCounts(delta);
  }

  setThreshold(threshold: number): void {
    this.selection.threshold = threshold;
    this.redraw();
  }

  /** The extrema that are kept, in the order of their numbers, with those that have no partner. */
  get kept(): number[] {
    const { pairs } = this.selection;
    if (!pairs) return [];
    const paired = pairs.extrema.filter((_, pair) => this.selection.isKept(pair));
    const alone = pairs.essential.filter((_, k) => pairs.essentialKinds[k] !== 0);
    return [...paired, ...alone].sort((a, b) => a - b);
  }

  /** Of the field after; null for none. */
  setResult(pairs: Pairs | null): void {
    this.diagram.setResult(pairs);
  }

  /** A sentence where pairs are not decided about here; empty where they are. */
  setElsewhere(sentence: string): void {
    if (sentence === this.elsewhere) return;
    this.elsewhere = sentence;
    this.diagram.setIdle(sentence !== '');
    this.describePair();
  }

  /** Keeps or drops the pair that the vertex belongs to. */
  toggleAt(vertex: number): void {
    const { pairs } = this.selection;
    if (!pairs || this.elsewhere) return;
    const pair = pairs.extrema.includes(vertex) ? pairs.extrema.indexOf(vertex) : pairs.saddles.indexOf(vertex);
    if (pair >= 0) return this.decide(pair);
    this.answer = pairs.essential.includes(vertex)
      ? `Vertex ${vertex} has no partner, so it always stays.`
      : `Vertex ${vertex} is no critical point of the input.`;
    this.describePair();
  }

  private decide(pair: number): void {
    if (this.elsewhere) return;
    this.selection.toggle(pair);
    this.decided();
  }

  private decided(): void {
    this.redraw();
    this.events.overrides(this.selection.overrides);
  }

  /** Where the line is cut short for want of room, the pointer shows it whole. */
  private sayPair(text: string): void {
    this.pairText.textContent = this.pairText.title = text;
  }

  private redraw(): void {
    this.answer = '';
    this.diagram.update(false);
    this.describePair();
    this.events.kept();
  }

  private point(pair: number | null): void {
    this.pointed = pair;
    this.describePair();
    if (pair === null) return this.events.lit(null);
    const { extrema, saddles, kinds } = this.selection.pairs!;
    this.events.lit({ extremum: extrema[pair]!, saddle: saddles[pair]!, kind: kinds[pair]! });
  }

  private describeCounts(delta: number): void {
    const { before, after } = this.hierarchies;
    if (!before) {
      this.curveText.textContent = '–';
      return;
    }
    const { minima, maxima, saddles } = countsAt(before, delta);
    const left = after ? countsAt(after, delta) : null;
    const change = (from: number, to: number | undefined): string =>
      to === undefined ? whole(from) : `${whole(from)} → ${whole(to)}`;
    const item = (kind: string, what: string): HTMLElement => {
      const span = document.createElement('span');
      span.className = `of-${kind}`;
      span.textContent = what;
      return span;
    };
    this.curveText.replaceChildren(
      `δ = ${short(delta)}: `,
      item('minimum', `${change(minima, left?.minima)} minima`),
      ', ',
      item('maximum', `${change(maxima, left?.maxima)} maxima`),
      ', ',
      item('saddle', `${change(saddles, left?.saddles)} saddles`),
    );
  }

  private describePair(): void {
    const { selection } = this;
    const { overrides } = selection;
    this.reset.disabled = overrides.kept.length + overrides.dropped.length === 0;
    const { pairs } = selection;
    if (!pairs) return;
    if (this.pointed === null) {
      if (this.answer || this.elsewhere) return this.sayPair(this.answer || this.elsewhere);
      const { minima, maxima, dropped } = selection.counts();
      const hidden = pairs.extrema.length - MOST;
      const more = hidden > 0 ? `; the ${whole(hidden)} least persistent pairs are not drawn` : '';
      if (selection.chosen) {
        const { kept } = selection.counts();
        return this.sayPair(
          `Both ends of ${whole(kept)} of ${plural(pairs.extrema.length, 'pair', 'pairs')} constrained`,
        );
      }
      this.sayPair(
        `Keeps ${plural(minima, 'minimum', 'minima')} and ${plural(maxima, 'maximum', 'maxima')}, drops ${plural(dropped, 'pair', 'pairs')}${more}`,
      );
      return;
    }
    const pair = this.pointed;
    const isMinimum = pairs.kinds[pair]! < 0;
    const [first, second] = isMinimum ? [pairs.birth, pairs.death] : [pairs.death, pairs.birth];
    const [inside, outside] = selection.chosen ? ['constrained', 'not constrained'] : ['kept', 'dropped'];
    const share = selection.width > 0 ? pairs.persistence[pair]! / selection.width : 0;
    this.sayPair(
      `${isMinimum ? 'Minimum' : 'Maximum'} ${pairs.extrema[pair]} (${short(first[pair]!)}), ` +
        `saddle ${pairs.saddles[pair]} (${short(second[pair]!)}): ` +
        `${short(100 * share)} %, ${selection.isKept(pair) ? inside : outside}` +
        (selection.isDecided(pair) ? ' by you' : ''),
    );
  }
}

function plural(count: number, one: string, many: string): string {
  return `${whole(count)} ${count === 1 ? one : many}`;
}
