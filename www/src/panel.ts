/** One side of the page, before or after: its view, its counts and its check of Euler's formula. */
import type { CriticalCounts } from 'morse-smooth';
import type { Solids, SolidSize } from 'morse-smooth/snapshot';
import { element, whole } from './dom';
import { chosen, SADDLE } from './glyphs';
import type { Found, Hierarchy, Part, Shape, Side } from './protocol';
import type { Lit } from './reading/reading';
import { countsAt, staysAt } from './reading/steps';
import { Viewer } from './viewer';

interface Critical {
  /** At δ = 0, as the solids. */
  counts: CriticalCounts;
  hierarchy: Hierarchy;
  solids: readonly Solids[];
  size: SolidSize;
  shape: Shape;
}

export class Panel {
  /** Null where the browser has no WebGL 2: the numbers still work. */
  readonly viewer: Viewer | null;
  /** True while there is no field to show. */
  awaiting = true;
  private readonly root: HTMLElement;
  private critical: Critical | null = null;

  constructor(side: Side) {
    this.root = element(`[data-testid="${side}"]`, HTMLElement);
    try {
      this.viewer = new Viewer(element('canvas', HTMLCanvasElement, this.root));
    } catch {
      this.viewer = null;
    }
    this.say(this.viewer ? 'Loading…' : NO_GRAPHICS);
  }

  /** `gap`: the color of gaps. */
  setShades(label: string, shades: Float32Array, gap: number | null): void {
    this.awaiting = false;
    this.part('label').textContent = label;
    this.viewer?.setShades(shades, gap);
    this.say('');
  }

  /** A sentence in place of the picture; empty for none. */
  say(text: string): void {
    if (!this.viewer) text = NO_GRAPHICS;
    const empty = this.part('empty');
    empty.textContent = text;
    empty.hidden = text === '';
  }

  setHierarchy(
    { counts, hierarchy, solids, shape }: Extract<Part, { kind: 'hierarchy' }>,
    size: SolidSize,
    delta: number,
  ): void {
    this.critical = { counts, hierarchy, solids, size, shape };
    this.setDelta(delta);
  }

  /** The hierarchy has the answer for every δ: nothing needs to be computed while the slider moves. */
  setDelta(delta: number): void {
    if (!this.critical) return;
    const { counts, hierarchy, solids, size, shape } = this.critical;
    this.viewer?.setSolids(delta === 0 ? solids : chosen(solids, staysAt(hierarchy, delta), size));
    this.setCounts({ ...countsAt(hierarchy, delta), indexSum: delta === 0 ? counts.indexSum : null }, shape);
  }

  /** While ε moves, without all that takes longer; `points` are those at the δ that is shown. */
  setPreview({ shades, counts, ...points }: Extract<Part, { kind: 'preview' }>): void {
    if (!this.critical) return;
    const { size, shape } = this.critical;
    this.viewer?.setPreview(shades, points, size, !shape.closed);
    this.setCounts(counts, shape);
  }

  /** Names the pair that is lit in this view, if any. */
  setLit(pair: Lit | null, path?: Uint32Array): void {
    if (pair && !this.awaiting) this.root.dataset['lit'] = `${pair.extremum} ${pair.saddle}`;
    else delete this.root.dataset['lit'];
    this.root.dataset['path'] = String((path?.length ?? 0) / 2);
    const points = pair && {
      vertices: Uint32Array.of(pair.extremum, pair.saddle),
      kinds: Int8Array.of(pair.kind, SADDLE),
    };
    this.viewer?.setLit(points, path);
  }

  /** A single point instead of a pair. */
  setSpot(spot: { vertex: number; kind: number } | null): void {
    this.setLit(null);
    if (!spot || this.awaiting) return;
    this.root.dataset['lit'] = String(spot.vertex);
    const kind = Math.abs(spot.kind) === 1 ? spot.kind : SADDLE;
    this.viewer?.setLit({ vertices: Uint32Array.of(spot.vertex), kinds: Int8Array.of(kind) });
  }

  setConstrained(found: Found): void {
    this.root.dataset['constrained'] = [...found.features].join(' ');
    this.viewer?.setConstrained(found);
  }

  /** On every mesh the indices of all vertices add up to its Euler characteristic; on a closed one that is m + M − s. */
  private setCounts(counts: CriticalCounts, { eulerCharacteristic, closed }: Shape): void {
    const { minima, maxima, saddles, indexSum } = counts;
    this.part('minima').textContent = whole(minima);
    this.part('maxima').textContent = whole(maxima);
    this.part('saddles').textContent = whole(saddles);
    const sum = closed ? 'm + M − s' : 'Σ index';
    const euler = this.part('euler');
    const holds = indexSum === eulerCharacteristic;
    euler.classList.toggle('wrong', indexSum !== null && !holds);
    euler.textContent =
      indexSum === null
        ? `χ = ${whole(eulerCharacteristic)}, checked at δ = 0`
        : `${sum} = ${whole(indexSum)} ${holds ? '= χ ✓' : `≠ χ = ${whole(eulerCharacteristic)} ✗`}`;
  }

  clear(text: string): void {
    this.awaiting = true;
    this.critical = null;
    this.setLit(null);
    this.part('label').textContent = '';
    for (const part of ['minima', 'maxima', 'saddles']) this.part(part).textContent = '–';
    this.part('euler').textContent = '';
    this.viewer?.clearField();
    this.say(text);
  }

  private part(name: string): HTMLElement {
    return element(`[data-part="${name}"]`, HTMLElement, this.root);
  }
}

const NO_GRAPHICS = 'This browser offers no WebGL 2, so there is no picture; the numbers are computed all the same.';
