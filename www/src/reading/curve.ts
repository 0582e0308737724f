/** The numbers of critical points against δ, before and after, with a mark at the δ that is shown. */
import uPlot from 'uplot';
import type { Side, Steps } from '../protocol';
import { ACCENT, axis, COUNT_SCALE, countAxis, FAMILY, MAXIMUM, MINIMUM, plotIn, pointIn, SADDLE, SOFT } from './plot';
import { corners, countsAt } from './steps';

/** Where the curve may end: at the first of these after which nothing changes, or at the last. */
const ENDS = [0.02, 0.05, 0.1, 0.2, 0.3, 0.5] as const;
/** A pixel is about this much of δ; more digits would be noise. */
const DIGITS = 1e4;
const KINDS = ['minima', 'maxima', 'saddles'] as const;
const COLORS = { minima: MINIMUM, maxima: MAXIMUM, saddles: SADDLE } as const;

export interface CurveEvents {
  /** The mark is dragged or set. */
  delta(value: number): void;
  /** The δ under the pointer; null when it leaves. */
  hover(value: number | null): void;
  /** How far the curve goes now. */
  end(delta: number): void;
}

export class Curve {
  private readonly plot: uPlot;
  private readonly steps: Partial<Record<Side, Steps>> = {};
  private delta = 0;
  private end: number = ENDS.at(-1)!;

  constructor(
    box: HTMLElement,
    private readonly events: CurveEvents,
  ) {
    const path = uPlot.paths.stepped!({ align: 1 });
    const lines = (['after', 'before'] as const).flatMap((side) =>
      KINDS.map((kind) => ({
        label: `${kind} ${side}`,
        stroke: COLORS[kind],
        width: side === 'before' ? 2 : 1.25,
        ...(side === 'after' ? { dash: [5, 4] } : {}),
        paths: path,
        points: { show: false },
      })),
    );
    this.plot = plotIn(box, {
      scales: {
        x: { time: false, range: () => [0, this.end] },
        y: COUNT_SCALE,
      },
      axes: [axis('relative δ', { size: 24, space: 60 }), countAxis()],
      series: [{}, ...lines],
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      hooks: {
        draw: [
          () => {
            this.drawKey();
            this.drawMark();
          },
        ],
      },
    });
    this.listen();
  }

  /** Null where there is no field. */
  setSteps(side: Side, steps: Steps | null): void {
    if (steps) this.steps[side] = steps;
    else delete this.steps[side];
    this.show();
  }

  setDelta(delta: number): void {
    this.delta = delta;
    if (delta > this.end) this.show();
    else this.plot.redraw(false, false);
  }

  private show(): void {
    const known = Object.values(this.steps);
    const last = Math.max(this.delta, ...known.map(({ delta }) => delta.at(-1) ?? 0));
    this.end = ENDS.find((end) => end >= last) ?? ENDS.at(-1)!;
    this.events.end(this.end);
    const deltas = corners(known, this.end);
    const columns = (['after', 'before'] as const).flatMap((of) =>
      KINDS.map((kind) => {
        const steps = this.steps[of];
        return deltas.map((delta) => (steps ? countsAt(steps, delta)[kind] : null));
      }),
    );
    this.plot.setData([deltas, ...columns]);
  }

  /** Above the curves, which fall to the right. */
  private drawKey(): void {
    if (!this.steps.after) return;
    const { ctx, bbox } = this.plot;
    const ratio = uPlot.pxRatio;
    ctx.save();
    ctx.font = `${12 * ratio}px ${FAMILY}`;
    ctx.textAlign = 'right';
    ctx.textBaseline = 'middle';
    ctx.fillStyle = ctx.strokeStyle = SOFT;
    let x = bbox.left + bbox.width - 6 * ratio;
    const y = bbox.top + 10 * ratio;
    for (const [side, width, dash] of [
      ['after', 1.25, [5, 4]],
      ['before', 2, []],
    ] as const) {
      ctx.fillText(side, x, y);
      x -= ctx.measureText(side).width + 6 * ratio;
      ctx.lineWidth = width * ratio;
      ctx.setLineDash(dash.map((length) => length * ratio));
      ctx.beginPath();
      ctx.moveTo(x - 22 * ratio, y);
      ctx.lineTo(x, y);
      ctx.stroke();
      x -= 36 * ratio;
    }
    ctx.restore();
  }

  private drawMark(): void {
    const { ctx, bbox } = this.plot;
    const ratio = uPlot.pxRatio;
    const x = this.plot.valToPos(Math.min(this.delta, this.end), 'x', true);
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

  private listen(): void {
    const { events } = this;
    const { over } = this.plot;
    const at = (event: PointerEvent): number => {
      const value = this.plot.posToVal(pointIn(this.plot, event)[0], 'x');
      return Math.round(DIGITS * Math.min(this.end, Math.max(0, value))) / DIGITS;
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
