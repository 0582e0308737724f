/** The persistence diagram: a dot for each pair, what has no partner at the upper edge, and the threshold as a line. */
import uPlot from 'uplot';
import { short } from '../dom';
import { ACCENT, axis, FAMILY, INK, MAXIMUM, MINIMUM, plotIn, pointIn, SOFT } from './plot';
import type { Pairs } from '../protocol';
import { drawResult } from './result';
import type { Selection } from './selection';

/** More dots than this cover each other, and the least persistent ones lie on the diagonal. */
export const MOST = 3000;
/** Pixels around a dot in which it is meant, and around the line. */
const REACH = 9;
const LINE_REACH = 6;
const RADIUS = 3.5;

/** Corners around the middle: of a triangle that points downwards, and of a square that stands on a corner. */
const TRIANGLE = [[-1.05, -0.65], [1.05, -0.65], [0, 1.1]] as const; // prettier-ignore
const SQUARE = [[0, -1], [1, 0], [0, 1], [-1, 0]] as const; // prettier-ignore

export interface DiagramEvents {
  /** The line is dragged; relative to the range. */
  threshold(value: number): void;
  /** The pair that is pointed at, by pointer or keys; null for none. */
  point(pair: number | null): void;
  toggle(pair: number): void;
}

export class Diagram {
  private readonly plot: uPlot;
  private pointed: number | null = null;
  /** Of the field after. */
  private result: Pairs | null = null;
  /** Whether dots are only looked at. */
  private isIdle = false;

  constructor(
    private readonly box: HTMLElement,
    private readonly selection: Selection,
    private readonly events: DiagramEvents,
  ) {
    const reach = (above: number) => (): [number, number] => {
      const [low] = selection.range;
      const width = selection.width || 1;
      return [low - 0.05 * width, low + above * width];
    };
    const values = (_plot: uPlot, splits: number[]): string[] => splits.map(short);
    this.plot = plotIn(box, {
      scales: { x: { time: false, range: reach(1.04) }, y: { range: reach(1.16) } },
      axes: [
        axis('birth (value)', { size: 24, space: 60, values }),
        axis('death (value)', {
          size: (_plot, texts) => 12 + 7 * Math.max(1, ...(texts ?? []).map((t) => t.length)),
          space: 26,
          values,
        }),
      ],
      // Only the axes are uPlot's: dots are drawn, and found, by what follows.
      series: [{}, { paths: () => null, points: { show: false } }],
      cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
      hooks: { draw: [() => this.draw()] },
    });
    this.listenToPointer();
    this.listenToKeys();
  }

  /** After anything in the selection has changed; `whole` for other pairs. */
  update(whole: boolean): void {
    if (whole) {
      this.point(null);
      this.plot.setData([this.selection.range, [null, null]]);
    } else this.plot.redraw(false, false);
  }

  setResult(pairs: Pairs | null): void {
    if (!pairs && !this.result) return;
    this.result = pairs;
    this.plot.redraw(false, false);
  }

  setIdle(isIdle: boolean): void {
    this.isIdle = isIdle;
    this.plot.redraw(false, false);
  }

  private get drawn(): number {
    return Math.min(MOST, this.selection.pairs?.extrema.length ?? 0);
  }

  private draw(): void {
    const { selection, plot } = this;
    if (!selection.pairs) return;
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    this.drawLines();
    // The least persistent first, so that those that matter lie on top; kept ones above dropped ones.
    for (const kept of [false, true])
      for (let pair = this.drawn - 1; pair >= 0; pair--) if (selection.isKept(pair) === kept) this.drawPair(pair);
    this.drawEssential();
    if (this.result) drawResult(this.plot, selection.pairs, this.result, this.edge);
    if (this.pointed !== null) this.drawPair(this.pointed);
    ctx.restore();
  }

  private drawLines(): void {
    const { ctx } = this.plot;
    const [low, high] = this.selection.range;
    const width = this.selection.width;
    const ratio = uPlot.pxRatio;
    const line = (from: [number, number], to: [number, number], color: string, thick: number, dash: number[]): void => {
      ctx.strokeStyle = color;
      ctx.lineWidth = thick * ratio;
      ctx.setLineDash(dash.map((length) => length * ratio));
      ctx.beginPath();
      ctx.moveTo(this.x(from[0]), this.y(from[1]));
      ctx.lineTo(this.x(to[0]), this.y(to[1]));
      ctx.stroke();
      ctx.setLineDash([]);
    };
    line([low, low], [high, high], '#8592aa', 1, []);
    const step = this.selection.threshold * width;
    line([low - width, low - width + step], [high + width, high + width + step], ACCENT, 1.75, [7, 4]);
    const edge = this.edge;
    line([low, edge], [high + width, edge], '#c3cad8', 1, [2, 3]);
    ctx.fillStyle = SOFT;
    ctx.font = `${14 * ratio}px ${FAMILY}`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    ctx.fillText('∞', this.plot.bbox.left + 2 * ratio, this.y(edge));
  }

  private drawPair(pair: number): void {
    const { kinds, birth, death } = this.selection.pairs!;
    const isPointed = pair === this.pointed;
    this.dot(this.x(birth[pair]!), this.y(death[pair]!), kinds[pair]!, {
      filled: this.selection.isKept(pair) && !this.isIdle,
      ring: this.selection.isDecided(pair),
      halo: isPointed,
    });
  }

  /** Where they are born; they never die. */
  private drawEssential(): void {
    const { essential, essentialKinds, essentialValues } = this.selection.pairs!;
    const { chosen } = this.selection;
    essentialValues.forEach((value, k) =>
      this.dot(this.x(value), this.y(this.edge), essentialKinds[k]!, {
        filled: chosen?.has(essential[k]!) ?? !this.isIdle,
        ring: false,
        halo: false,
      }),
    );
  }

  private dot(x: number, y: number, kind: number, how: { filled: boolean; ring: boolean; halo: boolean }): void {
    const { ctx } = this.plot;
    const ratio = uPlot.pxRatio;
    const radius = (how.halo ? 1.6 : 1) * RADIUS * ratio;
    const color = kind < 0 ? MINIMUM : MAXIMUM;
    const circle = (size: number): void => {
      ctx.beginPath();
      ctx.arc(x, y, size, 0, 2 * Math.PI);
    };
    if (how.halo) {
      ctx.fillStyle = '#ffd21f';
      circle(radius + 4 * ratio);
      ctx.fill();
    }
    // The shapes of the glyphs on the surface.
    ctx.beginPath();
    if (kind > 0) ctx.arc(x, y, radius, 0, 2 * Math.PI);
    else {
      const reach = 1.25 * radius;
      const corners = kind < 0 ? TRIANGLE : SQUARE;
      for (const [dx, dy] of corners) ctx.lineTo(x + reach * dx, y + reach * dy);
      ctx.closePath();
    }
    ctx.lineWidth = ratio;
    ctx.fillStyle = how.filled && kind !== 0 ? color : 'rgb(255 255 255 / 70%)';
    ctx.fill();
    ctx.strokeStyle = kind === 0 || how.filled ? INK : color;
    // Where crosses are what counts, what is dropped stands back further.
    ctx.globalAlpha = how.filled || how.halo ? 1 : this.result ? 0.35 : 0.6;
    ctx.stroke();
    ctx.globalAlpha = 1;
    if (how.ring) {
      ctx.lineWidth = 1.75 * ratio;
      ctx.strokeStyle = INK;
      circle(radius + 3.5 * ratio);
      ctx.stroke();
    }
  }

  /** The height at which stands what never dies. */
  private get edge(): number {
    const [low] = this.selection.range;
    return low + 1.08 * (this.selection.width || 1);
  }

  private x(value: number): number {
    return this.plot.valToPos(value, 'x', true);
  }

  private y(value: number): number {
    return this.plot.valToPos(value, 'y', true);
  }

  // ---------------------------------------------------------------- pointer and keys

  private listenToPointer(): void {
    const { over } = this.plot;
    let dragging = false;
    over.addEventListener('pointerdown', (event) => {
      const [x, y] = pointIn(this.plot, event);
      const pair = this.nearest(x, y);
      if (event.button !== 0 || !this.selection.pairs) return;
      if (pair !== null) {
        this.point(pair);
        return this.events.toggle(pair);
      }
      this.point(null);
      if (!this.isOnLine(x, y)) return;
      dragging = true;
      over.setPointerCapture(event.pointerId);
    });
    over.addEventListener('pointermove', (event) => {
      const [x, y] = pointIn(this.plot, event);
      if (dragging) return this.events.threshold(this.thresholdAt(x, y));
      const pair = this.nearest(x, y);
      this.point(pair);
      over.style.cursor = pair !== null && !this.isIdle ? 'pointer' : this.isOnLine(x, y) ? 'move' : 'default';
    });
    over.addEventListener('pointerup', () => {
      dragging = false;
    });
    over.addEventListener('pointercancel', () => {
      dragging = false;
    });
    over.addEventListener('pointerleave', ({ pointerType }) => {
      // A finger leaves with every tap; what it has tapped stays lit until it taps elsewhere.
      if (!dragging && pointerType !== 'touch') this.point(null);
    });
  }

  /** From pair to pair by persistence. */
  private listenToKeys(): void {
    this.box.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || this.drawn === 0) return;
      const last = this.drawn - 1;
      const goals: Record<string, number> = {
        ArrowRight: (this.pointed ?? -1) + 1,
        ArrowDown: (this.pointed ?? -1) + 1,
        ArrowLeft: (this.pointed ?? 1) - 1,
        ArrowUp: (this.pointed ?? 1) - 1,
        Home: 0,
        End: last,
      };
      const goal = goals[event.key];
      if (goal !== undefined) this.point(Math.max(0, Math.min(last, goal)));
      else if (event.key === 'Escape') this.point(null);
      else if ((event.key === 'Enter' || event.key === ' ') && this.pointed !== null) this.events.toggle(this.pointed);
      else return;
      event.preventDefault();
    });
    this.box.addEventListener('blur', () => this.point(null));
  }

  private point(pair: number | null): void {
    if (pair === this.pointed) return;
    this.pointed = pair;
    this.plot.redraw(false, false);
    this.events.point(pair);
  }

  /** Of dots at the same distance the more persistent one. */
  private nearest(x: number, y: number): number | null {
    const { pairs } = this.selection;
    let best: number | null = null;
    let least = REACH ** 2;
    for (let pair = 0; pair < this.drawn; pair++) {
      const dx = this.plot.valToPos(pairs!.birth[pair]!, 'x') - x;
      const dy = this.plot.valToPos(pairs!.death[pair]!, 'y') - y;
      const distance = dx * dx + dy * dy;
      if (distance < least) {
        least = distance;
        best = pair;
      }
    }
    return best;
  }

  private thresholdAt(x: number, y: number): number {
    const step = this.plot.posToVal(y, 'y') - this.plot.posToVal(x, 'x');
    const share = step / (this.selection.width || 1);
    return Math.round(1e4 * Math.min(1, Math.max(0, share))) / 1e4;
  }

  private isOnLine(x: number, y: number): boolean {
    const line = this.plot.posToVal(x, 'x') + this.selection.threshold * this.selection.width;
    return Math.abs(this.plot.valToPos(line, 'y') - y) <= LINE_REACH;
  }
}
