/** The numbers of critical points against δ, before and after, with a mark at the δ that is shown. */
import uPlot from 'uplot';
import { short } from '../dom';
import type { Side, Steps } from '../protocol';
import { ACCENT, axis, MAXIMUM, MINIMUM, plotIn, pointIn, SADDLE } from './plot';
import { corners, countsAt } from './steps';

/** The end of the δ slider. */
const END = 0.5;
/** A pixel is about this much of δ; more digits would be noise. */
const DIGITS = 1e4;
const KINDS = ['minima', 'maxima', 'saddles'] as const;
const COLOURS = { minima: MINIMUM, maxima: MAXIMUM, saddles: SADDLE } as const;

export interface CurveEvents {
  /** The mark is dragged or set. */
  delta(value: number): void;
  /** The δ under the pointer; null when it leaves. */
  hover(value: number | null): void;
}

export class Curve {
  private readonly plot: uPlot;
  private readonly steps: Partial<Record<Side, Steps>> = {};
  private delta = 0;

  constructor(box: HTMLElement, events: CurveEvents) {
    const path = uPlot.paths.stepped!({ align: 1 });
    const lines = (['after', 'before'] as const).flatMap((side) =>
      KINDS.map((kind) => ({
        label: `${kind} ${side}`,
        stroke: COLOURS[kind],
        width: side === 'before' ? 2 : 1.25,
        ...(side === 'after' ? { dash: [5, 4] } : {}),
        paths: path,
        points: { show: false },
      })),
    );
    this.plot = plotIn(box, {
      scales: {
        x: { time: false, range: [0, END] },
        // Like a logarithm for large numbers, and has a 0.
        y: { distr: 4, range: (_plot, _low, high) => [0, Math.max(4, 1.4 * (high ?? 0))] },
      },
      axes: [
        axis('relative δ', { size: 24, space: 60 }),
        axis('critical points', { size: widthOf, space: 22, values: sparse }),
      ],
      series: [{}, ...lines],
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      hooks: { draw: [() => this.drawMark()] },
    });
    this.listen(events);
  }

  /** Null where there is no field. */
  setSteps(side: Side, steps: Steps | null): void {
    if (steps) this.steps[side] = steps;
    else delete this.steps[side];
    const deltas = corners(Object.values(this.steps), END);
    const columns = (['after', 'before'] as const).flatMap((of) =>
      KINDS.map((kind) => {
        const known = this.steps[of];
        return deltas.map((delta) => (known ? countsAt(known, delta)[kind] : null));
      }),
    );
    this.plot.setData([deltas, ...columns]);
  }

  setDelta(delta: number): void {
    this.delta = delta;
    this.plot.redraw(false, false);
  }

  private drawMark(): void {
    const { ctx, bbox } = this.plot;
    const ratio = uPlot.pxRatio;
    const x = this.plot.valToPos(Math.min(this.delta, END), 'x', true);
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = ACCENT;
    ctx.lineWidth = 2 * ratio;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(x, bbox.top + 5 * ratio, 5 * ratio, 0, 2 * Math.PI);
    ctx.fill();
    ctx.restore();
  }

  private listen(events: CurveEvents): void {
    const { over } = this.plot;
    const at = (event: PointerEvent): number => {
      const value = this.plot.posToVal(pointIn(this.plot, event)[0], 'x');
      return Math.round(DIGITS * Math.min(END, Math.max(0, value))) / DIGITS;
    };
    over.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      over.setPointerCapture(event.pointerId);
      events.delta(at(event));
    });
    over.addEventListener('pointermove', (event) => {
      if (over.hasPointerCapture(event.pointerId)) events.delta(at(event));
      events.hover(at(event));
    });
    over.addEventListener('pointerleave', () => events.hover(null));
  }
}

/** Room for the widest number. */
function widthOf(_plot: uPlot, values: string[] | null): number {
  return 12 + 7 * Math.max(1, ...(values ?? []).map((text) => text.length));
}

/** 1, 10, 100: the lines between them need no numbers. */
function sparse(_plot: uPlot, splits: number[]): string[] {
  return splits.map((value) => (value === 0 || Number.isInteger(Math.log10(value)) ? short(value) : ''));
}
