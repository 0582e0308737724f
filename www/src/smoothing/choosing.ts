/** The user's side of choosing ε: both plots along ε, which point at the same, and the rules. */
import type { ChosenEpsilon, EpsilonRule } from 'morse-smooth';
import { about, clamp, element, input, select, short, whole } from '../dom';
import type { EpsilonCurve, Part } from '../protocol';
import { EpsilonCounts } from '../reading/epsilon-counts';
import { LCurve } from '../reading/l-curve';
import { along, RULES } from '../reading/marks';
import type { RuleName } from '../reading/marks';

const COUNT_RANGE = [1, 1e7] as const;
const FEW = 20;
/** The box of ε has four digits. */
const SAME = 1e-3;

export interface ChoosingEvents {
  /** Set in a plot, or dragged there. */
  epsilon(value: number): void;
  choose(rule: EpsilonRule): void;
}

export class Choosing {
  private readonly panel = element('#choosing', HTMLElement);
  private readonly none = element('#epsilon-none', HTMLElement);
  private readonly state = element('#family-state', HTMLElement);
  private readonly normsText = element('#norms-values', HTMLElement);
  private readonly countsText = element('#epsilon-counts-values', HTMLElement);
  private readonly choicesText = element('#choices-text', HTMLElement);
  private readonly rule = select('epsilon-rule');
  private readonly most = input('most-points');
  private readonly button = element('#choose', HTMLButtonElement);
  private readonly lCurve: LCurve;
  private readonly counts: EpsilonCounts;

  private epsilon = 1;
  private hovered: number | null = null;
  private curve: EpsilonCurve | null = null;
  private choices: readonly ChosenEpsilon[] = [];
  /** By the button. */
  private chosen: ChosenEpsilon | null = null;

  constructor(events: ChoosingEvents) {
    const pointing = {
      epsilon: (value: number) => events.epsilon(value),
      hover: (value: number | null) => {
        this.hovered = value;
        this.redraw();
      },
    };
    this.lCurve = new LCurve(element('#l-curve', HTMLElement), pointing);
    this.counts = new EpsilonCounts(element('#epsilon-counts', HTMLElement), pointing);
    this.most.addEventListener('change', () => {
      this.most.value = String(this.wanted);
    });
    this.rule.addEventListener('change', () => this.showRule());
    this.button.addEventListener('click', () => events.choose(this.wish));
    element('#open-choosing', HTMLButtonElement).addEventListener('click', () => this.open());
    this.showRule();
    this.clear('');
  }

  /** What ε can be held by in the plots. */
  get handles(): HTMLElement[] {
    return [this.lCurve.handle, this.counts.handle];
  }

  setEpsilon(epsilon: number): void {
    this.epsilon = epsilon;
    this.redraw();
  }

  /** Another field, or another method: what is shown belongs to the last one. `why` there is nothing; empty where it is to come. */
  clear(why: string): void {
    this.setCurve(null);
    this.choices = [];
    this.chosen = null;
    this.setState('coming', why);
    this.redraw();
  }

  setFamily({ state, why, error }: Extract<Part, { kind: 'family' }>): void {
    if (state === 'none' || state === 'coming') return this.clear(state === 'none' ? why : '');
    this.setState(state, '');
    this.state.textContent = `error ${about(error)}${state === 'growing' ? ', refining…' : ''}`;
  }

  setCurve(curve: EpsilonCurve | null): void {
    this.curve = curve;
    this.lCurve.setCurve(curve);
    this.counts.setCurve(curve);
    this.describe();
  }

  setChoices(choices: readonly ChosenEpsilon[]): void {
    this.choices = choices;
    this.redraw();
  }

  setChosen(choice: ChosenEpsilon): void {
    this.chosen = choice;
    this.redraw();
  }

  private setState(state: string, why: string): void {
    this.panel.dataset['family'] = why ? 'none' : state;
    this.panel.classList.toggle('has-none', why !== '');
    this.none.textContent = why;
    this.none.hidden = why === '';
    this.state.textContent = '';
    this.button.disabled = why !== '';
  }

  /** Brings the plots into sight, from beside the slider. */
  private open(): void {
    element('#tab-choosing', HTMLButtonElement).click();
    this.panel.scrollIntoView({ block: 'nearest' });
    if (this.none.hidden) this.rule.focus({ preventScroll: true });
  }

  private showRule(): void {
    this.most.hidden = this.rule.value !== 'atMostCriticalPoints';
  }

  private get wanted(): number {
    const { valueAsNumber } = this.most;
    return Math.round(clamp(Number.isFinite(valueAsNumber) ? valueAsNumber : FEW, COUNT_RANGE));
  }

  private get wish(): EpsilonRule {
    const rule = this.rule.value as 'auto' | RuleName;
    if (rule === 'auto') return rule;
    return rule === 'atMostCriticalPoints' ? { rule, count: this.wanted } : { rule };
  }

  private redraw(): void {
    const { epsilon, hovered } = this;
    const state = { epsilon, hovered, choices: this.marked };
    this.lCurve.setState(state);
    this.counts.setState(state);
    this.describe();
  }

  private get marked(): readonly ChosenEpsilon[] {
    const { chosen } = this;
    // Rules that are marked anyway come to the same again.
    return chosen ? [chosen, ...this.choices.filter(({ rule }) => rule !== chosen.rule)] : this.choices;
  }

  private describe(): void {
    const { curve, hovered } = this;
    const epsilon = hovered ?? this.epsilon;
    const at = `ε = ${short(epsilon)}: `;
    if (!curve) {
      this.normsText.textContent = this.countsText.textContent = '–';
      this.choicesText.textContent = '';
      return;
    }
    const of = (column: Float64Array): number => along(curve, column, epsilon);
    const norms = `${at}‖x − f‖ = ${short(of(curve.distances))}, ‖Lx‖ = ${short(of(curve.roughness))}`;
    this.normsText.textContent = this.normsText.title = norms;
    this.countsText.replaceChildren(at, ...countsAt(curve, epsilon));
    const { marked } = this;
    const meant = marked.find((choice) => isSame(choice.epsilon, epsilon));
    this.choicesText.textContent = this.choicesText.title = meant
      ? sentences(meant)
      : `Marked: ${marked.map(({ rule, epsilon: at }) => `${RULES[rule].name} ε\u00a0=\u00a0${short(at)}`).join(', ')}.`;
  }
}

const isSame = (a: number, b: number): boolean => Math.abs(a / b - 1) < SAME;

/** Why, and what would have been next. */
function sentences({ reason, runnersUp, noise }: ChosenEpsilon): string {
  const next = runnersUp.length > 0 ? ` Next best: ε = ${runnersUp.map(short).join(', ')}.` : '';
  return `${reason}${next}${noise ? ` Confidence: ${noise.confidence}.` : ''}`;
}

/** Of the nearest ε at which they were counted. */
function countsAt(curve: EpsilonCurve, epsilon: number): (string | HTMLElement)[] {
  let best = -1;
  let least = Infinity;
  curve.epsilons.forEach((other, k) => {
    const far = Math.abs(Math.log(other / epsilon));
    if (far < least && !Number.isNaN(curve.minima[k]!)) [best, least] = [k, far];
  });
  if (best < 0) return ['critical points are still to be counted'];
  const item = (kind: string, text: string): HTMLElement => {
    const span = document.createElement('span');
    span.className = `of-${kind}`;
    span.textContent = text;
    return span;
  };
  return [
    least > 1e-9 ? 'about ' : '',
    item('minimum', `${whole(curve.minima[best]!)} minima`),
    ', ',
    item('maximum', `${whole(curve.maxima[best]!)} maxima`),
    ', ',
    item('saddle', `${whole(curve.saddles[best]!)} saddles`),
  ];
}
