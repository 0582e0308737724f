/** What both plots along ε share: powers of ten on their axes, and the signs of the ε that rules chose. */
import type { ChosenEpsilon } from 'morse-smooth';
import uPlot from 'uplot';
import { short } from '../dom';
import type { EpsilonCurve } from '../protocol';
import { axis, FAMILY, pointIn } from './plot';

export type RuleName = ChosenEpsilon['rule'];

/** What the plots show beside their curves. */
export interface EpsilonState {
  epsilon: number;
  /** The ε that is pointed at in either plot. */
  hovered: number | null;
  choices: readonly ChosenEpsilon[];
}

export interface EpsilonPlotEvents {
  /** Set or dragged. */
  epsilon(value: number): void;
  hover(value: number | null): void;
}

export const RULES: Record<RuleName, { name: string; color: string }> = {
  gcv: { name: 'cross-validation', color: '#7a2fa8' },
  lCurve: { name: 'L-curve corner', color: '#0a7455' },
  discrepancy: { name: 'discrepancy', color: '#a84f00' },
  atMostCriticalPoints: { name: 'number of points', color: '#3d4757' },
};
/** Pixels around a chosen ε in which it is meant. */
export const REACH = 7;
/** Room for the names above a curve. */
export const ROW = 14;
const FONT_SIZE = 11.5;

/** Of logarithms to base ten. */
export function powerAxis(label: string, more: uPlot.Axis): uPlot.Axis {
  return axis(label, {
    splits: (plot, which, low, high) => splitsOf(low, high, roomOf(plot, which) / Number(more.space)),
    values: (_plot, splits) => splits.map(powerOf),
    ...more,
  });
}

/** Pixels, without those of the other axis. */
const roomOf = ({ width, height }: uPlot, which: number): number => (which === 0 ? width - 70 : height - 50);

/** Powers of ten, every second or so where there is no room for all; on a short axis twice and five times these, too. */
function splitsOf(low: number, high: number, most: number): number[] {
  const step = [1, 2, 3, 5, 10, 20].find((wide) => (high - low) / wide <= most) ?? 50;
  const first = Math.ceil(low / step) * step;
  const powers = Array.from({ length: Math.max(0, Math.floor((high - first) / step) + 1) }, (_, k) => first + k * step);
  if (3 * (high - low) > most) return powers;
  const steps = [1, 2, 5].map(Math.log10);
  const all = [Math.floor(low), ...powers].flatMap((power) => steps.map((more) => power + more));
  return [...new Set(all)].filter((exponent) => exponent >= low && exponent <= high);
}

/** 10⁻³, or a plain number near to 1. */
function powerOf(exponent: number): string {
  const nearest = Math.round(exponent);
  const isPower = Math.abs(exponent - nearest) < 1e-9;
  if (!isPower || Math.abs(nearest) <= 2) return short(Number((10 ** exponent).toPrecision(2)));
  return `10${[...String(nearest)].map((sign) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(sign)] ?? '⁻').join('')}`;
}

/** ε with as many digits as a pixel is worth. */
export const roundEpsilon = (exponent: number): number => Number((10 ** exponent).toPrecision(3));

/** Between the ε of the curve linearly, in logarithms; NaN where it is not known. */
export function along(curve: EpsilonCurve, column: Float64Array, epsilon: number): number {
  const { epsilons } = curve;
  const last = epsilons.length - 1;
  const above = Math.min(
    last,
    Math.max(
      1,
      epsilons.findIndex((other) => other >= epsilon),
    ),
  );
  const [low, high] = [Math.log(epsilons[above - 1]!), Math.log(epsilons[above]!)];
  const share = Math.min(1, Math.max(0, (Math.log(epsilon) - low) / (high - low)));
  return (1 - share) * column[above - 1]! + share * column[above]!;
}

/** Which names stand in which row, so that each has its own, from left to right. */
export const inRows = (choices: readonly ChosenEpsilon[], placeOf: (epsilon: number) => number): ChosenEpsilon[] =>
  [...choices].sort((a, b) => placeOf(a.epsilon) - placeOf(b.epsilon));

/** Beside x, to the right if there is room. Returns how long it is. */
export function drawName(plot: uPlot, { rule }: ChosenEpsilon, x: number, y: number): number {
  const { ctx, bbox } = plot;
  const ratio = uPlot.pxRatio;
  const { name, color } = RULES[rule];
  ctx.font = `${FONT_SIZE * ratio}px ${FAMILY}`;
  const { width } = ctx.measureText(name);
  const isLeft = x + width + 6 * ratio > bbox.left + bbox.width;
  ctx.textAlign = isLeft ? 'right' : 'left';
  ctx.textBaseline = 'middle';
  ctx.lineWidth = 3 * ratio;
  ctx.strokeStyle = 'rgb(255 255 255 / 85%)';
  const at = x + (isLeft ? -5 : 5) * ratio;
  ctx.strokeText(name, at, y);
  ctx.fillStyle = color;
  ctx.fillText(name, at, y);
  return width + 5 * ratio;
}

export function dot(plot: uPlot, x: number, y: number, color: string, radius: number, filled: boolean): void {
  const { ctx } = plot;
  const ratio = uPlot.pxRatio;
  ctx.beginPath();
  ctx.arc(x, y, radius * ratio, 0, 2 * Math.PI);
  ctx.fillStyle = filled ? color : '#ffffff';
  ctx.fill();
  ctx.lineWidth = (filled ? 1 : 2) * ratio;
  ctx.strokeStyle = filled ? '#ffffff' : color;
  ctx.stroke();
}

export function upright(plot: uPlot, x: number, top: number, color: string, width: number, dash: number[]): void {
  const { ctx, bbox } = plot;
  const ratio = uPlot.pxRatio;
  ctx.strokeStyle = color;
  ctx.lineWidth = width * ratio;
  ctx.setLineDash(dash.map((length) => length * ratio));
  ctx.beginPath();
  ctx.moveTo(x, top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.setLineDash([]);
}

/** Only where it is seen: it is drawn again when its tab is opened. */
export function redraw(plot: uPlot): void {
  if (!plot.root.closest('[hidden]')) plot.redraw(false, false);
}

/** Calls back for what the pointer does over a plot. `find`: the ε at a place in pixels; null where there is none. */
export function listen(plot: uPlot, find: (x: number, y: number) => number | null, events: EpsilonPlotEvents): void {
  const { over } = plot;
  const at = (event: PointerEvent): number | null => find(...pointIn(plot, event));
  const set = (event: PointerEvent): void => {
    const epsilon = at(event);
    if (epsilon !== null) events.epsilon(epsilon);
  };
  over.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    over.setPointerCapture(event.pointerId);
    set(event);
  });
  over.addEventListener('pointermove', (event) => {
    if (over.hasPointerCapture(event.pointerId)) set(event);
    events.hover(at(event));
  });
  over.addEventListener('pointerleave', () => events.hover(null));
}
