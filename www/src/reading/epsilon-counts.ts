/** The numbers of critical points along ε, with the ε that is set, the one that is pointed at, and those that rules chose. */
import uPlot from 'uplot';
import type { EpsilonCurve } from '../protocol';
import { drawName, inRows, listen, powerAxis, redraw, REACH, roundEpsilon, ROW, RULES, upright } from './marks';
import type { EpsilonPlotEvents, EpsilonState } from './marks';
import { ACCENT, COUNT_SCALE, countAxis, MAXIMUM, MINIMUM, plotIn, SADDLE, SOFT } from './plot';

const COLORS = { minima: MINIMUM, maxima: MAXIMUM, saddles: SADDLE } as const;
const KINDS = ['minima', 'maxima', 'saddles'] as const;

export class EpsilonCounts {
  private readonly plot: uPlot;
  private ends: [number, number] = [-6, 4];
  private state: EpsilonState = { epsilon: 1, hovered: null, choices: [] };

  constructor(box: HTMLElement, events: EpsilonPlotEvents) {
    this.plot = plotIn(box, {
      scales: {
        x: { time: false, range: () => this.ends },
        y: { ...COUNT_SCALE, range: (_plot, _low, high) => [0, Math.max(9, 4 * (high ?? 0))] },
      },
      axes: [powerAxis('ε', { size: 24, space: 44 }), countAxis()],
      series: [
        {},
        ...KINDS.map((kind) => ({
          label: kind,
          stroke: COLORS[kind],
          width: kind === 'saddles' ? 1.5 : 2,
          // Counts come for every eighth ε first.
          spanGaps: true,
          points: { show: false },
        })),
      ],
      cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
      hooks: { draw: [() => this.draw()] },
    });
    listen(this.plot, (x) => this.epsilonAt(x), events);
  }

  get handle(): HTMLElement {
    return this.plot.over;
  }

  setCurve(curve: EpsilonCurve | null): void {
    const exponents = curve ? Array.from(curve.epsilons, Math.log10) : [];
    if (curve) this.ends = [exponents[0]!, exponents.at(-1)!];
    const known = (column: Float64Array): (number | null)[] =>
      Array.from(column, (value) => (Number.isNaN(value) ? null : value));
    this.plot.setData([exponents, ...KINDS.map((kind) => (curve ? known(curve[kind]) : []))]);
  }

  setState(state: EpsilonState): void {
    this.state = state;
    redraw(this.plot);
  }

  private epsilonAt(x: number): number {
    const near = this.state.choices.find(
      ({ epsilon }) => Math.abs(this.plot.valToPos(Math.log10(epsilon), 'x') - x) <= REACH,
    );
    const [low, high] = this.ends;
    return near?.epsilon ?? roundEpsilon(Math.min(high, Math.max(low, this.plot.posToVal(x, 'x'))));
  }

  private draw(): void {
    const { plot, state } = this;
    const { ctx, bbox } = plot;
    const ratio = uPlot.pxRatio;
    const place = (epsilon: number): number =>
      plot.valToPos(Math.min(this.ends[1], Math.max(this.ends[0], Math.log10(epsilon))), 'x', true);
    ctx.save();
    const choices = inRows(state.choices, place);
    const rowOf = (row: number): number => bbox.top + (ROW * (row + 0.5) + 2) * ratio;
    choices.forEach(({ epsilon, rule }, row) =>
      upright(plot, place(epsilon), rowOf(row), RULES[rule].color, 1.25, [5, 3]),
    );
    if (state.hovered !== null) upright(plot, place(state.hovered), bbox.top, SOFT, 1, [2, 2]);
    const x = place(state.epsilon);
    upright(plot, x, bbox.top, ACCENT, 2, []);
    ctx.beginPath();
    ctx.fillStyle = ACCENT;
    ctx.arc(x, bbox.top + bbox.height, 5 * ratio, 0, 2 * Math.PI);
    ctx.fill();
    choices.forEach((choice, row) => drawName(plot, choice, place(choice.epsilon), rowOf(row)));
    ctx.restore();
  }
}
