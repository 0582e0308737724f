/** The user's side of constraints: which vertices are constrained now, and how picking changes that. */
import { element, whole } from '../dom';
import type { Found, Hierarchy, Pairs } from '../protocol';
import { ordinaryPoints, pointsOf } from './points';
import type { Point } from './points';
import { hasConstraints } from './settings';
import type { Method, Rule } from './settings';
import { PointTable } from './table';

const NONE: Found = { features: new Uint32Array(0), values: new Float64Array(0), all: new Uint32Array(0) };

export interface ConstrainingEvents {
  /** What is picked has changed, and with it perhaps the rule. */
  picked(): void;
  /** Picked vertices are to take the place of the rule's. */
  rule(rule: Rule): void;
  /** What to mark on the surface. */
  marked(found: Found): void;
  /** Which vertices are in the set, where the threshold is not what decides; null where it is. */
  chosen(features: ReadonlySet<number> | null): void;
  point(point: Point | null): void;
  /** A vertex was clicked while the chosen extrema are what is marked. */
  extremum(vertex: number): void;
}

export class Constraining {
  private picked: number[] = [];
  private found = NONE;
  private extrema: { found: Found; areFixed: boolean } | null = null;
  private method: Method = 'tikhonov';
  private rule: Rule = 'persistence';
  private components = 1;
  private hierarchy: Hierarchy | null = null;
  private pairs: Pairs | null = null;
  private critical: readonly Point[] = [];
  /** What the table has: these, and so many that are no critical points. */
  private listed: readonly Point[] = [];
  private ordinary = 0;

  private readonly table: PointTable;
  private readonly text = element('#constrained', HTMLElement);
  private readonly others = element('#others', HTMLElement);
  private readonly takeOverButton = element('#take-over', HTMLButtonElement);
  private readonly clearButton = element('#clear-picked', HTMLButtonElement);

  constructor(private readonly events: ConstrainingEvents) {
    this.table = new PointTable({
      toggle: (vertex) => this.toggle([vertex]),
      point: (point) => events.point(point),
    });
    this.takeOverButton.addEventListener('click', () => {
      this.takeOver();
      events.picked();
    });
    this.clearButton.addEventListener('click', () => {
      this.picked = [];
      events.rule('picked');
      events.picked();
    });
  }

  get vertices(): readonly number[] {
    return this.picked;
  }

  set vertices(picked: readonly number[]) {
    this.picked = [...picked];
  }

  private get isOn(): boolean {
    return hasConstraints({ method: this.method });
  }

  /** Vertices are those of one mesh. */
  setMesh(components: number): void {
    this.components = components;
    this.hierarchy = this.pairs = null;
    this.setFound(NONE);
  }

  setHierarchy(hierarchy: Hierarchy): void {
    this.hierarchy = hierarchy;
    this.renew();
  }

  setPairs(pairs: Pairs): void {
    this.pairs = pairs;
    this.renew();
  }

  setFound(found: Found): void {
    this.found = found;
    this.show();
  }

  /** Chosen extrema, which are marked in place of constraints; null for none. `areFixed`: they are not chosen one by one. */
  setExtrema(found: Found | null, areFixed: boolean): void {
    if (!found && !this.extrema) return;
    this.extrema = found && { found, areFixed };
    this.show();
  }

  setMethod(method: Method, rule: Rule): void {
    if (method === this.method && rule === this.rule) return;
    Object.assign(this, { method, rule });
    this.show();
  }

  /** Takes all of them out where all are in, else in. A rule's set is taken over first, since it is the one that one sees. */
  toggle(vertices: readonly number[]): void {
    if (this.extrema) return vertices.forEach((vertex) => this.events.extremum(vertex));
    if (!this.isOn) return;
    this.takeOver();
    const set = new Set(this.picked);
    const areIn = vertices.every((vertex) => set.has(vertex));
    for (const vertex of vertices) {
      if (areIn) set.delete(vertex);
      else set.add(vertex);
    }
    this.picked = [...set].sort((a, b) => a - b);
    this.events.picked();
  }

  private takeOver(): void {
    if (this.rule === 'picked') return;
    this.picked = [...this.found.features];
    this.events.rule('picked');
  }

  private renew(): void {
    const { hierarchy, pairs } = this;
    // One comes after the other, for another field, and both are about the same critical points then.
    if (!hierarchy || !pairs) return;
    this.critical = pointsOf(hierarchy, pairs);
    this.show();
  }

  private show(): void {
    const { isOn, extrema } = this;
    const found = extrema?.found ?? (isOn ? this.found : NONE);
    const { features, all } = found;
    const chosen = new Set(features);
    const ordinary = ordinaryPoints(this.critical, found);
    // Sorting a hundred thousand takes its time, and most changes leave the rows as they are.
    if (this.critical !== this.listed || ordinary.length + this.ordinary > 0)
      this.table.setPoints([...this.critical, ...ordinary]);
    this.listed = this.critical;
    this.ordinary = ordinary.length;
    this.table.setChosen(chosen, extrema ? !extrema.areFixed : isOn);
    this.text.textContent = `${whole(all.length)} constrained (${whole(features.length)} feature ${features.length === 1 ? 'point' : 'points'})`;
    this.others.hidden = this.components === 1 && features.length > 0;
    this.takeOverButton.disabled = this.rule === 'picked';
    this.clearButton.disabled = features.length === 0;
    this.events.marked(found);
    this.events.chosen(isOn && this.rule !== 'persistence' ? chosen : null);
  }
}
