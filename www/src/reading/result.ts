/** What the diagram shows of the field after: a cross for each of its pairs, and how far each has come from its dot. */
import uPlot from 'uplot';
import type { Pairs } from '../protocol';
import { FAMILY, INK, SOFT } from './plot';

/** More crosses than this cover each other, and the least persistent ones lie on the diagonal. */
const MOST = 3000;
const ARM = 4.5;
const DARK = { minimum: '#123a9e', maximum: '#8f0f22' };

interface Place {
  vertex: number;
  kind: number;
  x: number;
  y: number;
}

/** `edge`: the height at which stands what never dies. */
export function drawResult(plot: uPlot, before: Pairs, after: Pairs, edge: number): void {
  const { ctx } = plot;
  const ratio = uPlot.pxRatio;
  const dots = new Map(placesOf(plot, before, edge).map((place) => [place.vertex, place]));
  const crosses = placesOf(plot, after, edge).slice(0, MOST);
  ctx.lineCap = 'round';
  // Where the same vertex is an extremum of both.
  ctx.strokeStyle = 'rgb(22 32 46 / 35%)';
  ctx.lineWidth = ratio;
  ctx.beginPath();
  for (const { vertex, kind, x, y } of crosses) {
    const dot = dots.get(vertex);
    if (dot?.kind !== kind) continue;
    ctx.moveTo(dot.x, dot.y);
    ctx.lineTo(x, y);
  }
  ctx.stroke();
  for (const { kind, x, y } of crosses) drawCross(ctx, x, y, kind, ratio);
  ctx.lineCap = 'butt';
  drawKey(plot);
}

function placesOf(plot: uPlot, pairs: Pairs, edge: number): Place[] {
  const at = (x: number, y: number): [number, number] => [plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true)];
  const alone = Array.from(pairs.essential, (vertex, k): Place => {
    const [x, y] = at(pairs.essentialValues[k]!, edge);
    return { vertex, kind: pairs.essentialKinds[k]!, x, y };
  });
  const paired = Array.from(pairs.extrema, (vertex, k): Place => {
    const [x, y] = at(pairs.birth[k]!, pairs.death[k]!);
    return { vertex, kind: pairs.kinds[k]!, x, y };
  });
  return [...alone.filter(({ kind }) => kind !== 0), ...paired];
}

function drawCross(ctx: CanvasRenderingContext2D, x: number, y: number, kind: number, ratio: number): void {
  const arm = ARM * ratio;
  ctx.beginPath();
  for (const [dx, dy] of [
    [arm, arm],
    [arm, -arm],
  ] as const) {
    // prettier-ignore
    ctx.moveTo(x - dx, y - dy);
    ctx.lineTo(x + dx, y + dy);
  }
  ctx.strokeStyle = 'rgb(255 255 255 / 90%)';
  ctx.lineWidth = 4 * ratio;
  ctx.stroke();
  ctx.strokeStyle = kind < 0 ? DARK.minimum : DARK.maximum;
  ctx.lineWidth = 1.75 * ratio;
  ctx.stroke();
}

/** Below the diagonal, where no pair can be. */
function drawKey(plot: uPlot): void {
  const { ctx, bbox } = plot;
  const ratio = uPlot.pxRatio;
  const right = bbox.left + bbox.width - 8 * ratio;
  const bottom = bbox.top + bbox.height - 10 * ratio;
  ctx.font = `${11.5 * ratio}px ${FAMILY}`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'middle';
  const name = 'after';
  const other = 'before';
  const left = right - ctx.measureText(name).width;
  drawCross(ctx, left - 10 * ratio, bottom, -1, ratio);
  ctx.fillStyle = SOFT;
  ctx.fillText(name, left, bottom);
  const further = left - 30 * ratio - ctx.measureText(other).width;
  ctx.fillText(other, further, bottom);
  ctx.beginPath();
  ctx.arc(further - 9 * ratio, bottom, 3.5 * ratio, 0, 2 * Math.PI);
  ctx.lineWidth = ratio;
  ctx.strokeStyle = INK;
  ctx.stroke();
}
