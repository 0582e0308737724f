/** The L-curve: how far the smoothed field is from the given one against how rough it is left, for every ε. Only axes are uPlot's. */
import uPlot from 'uplot';
import type { EpsilonCurve } from '../protocol';
import { along, dot, drawName, inRows, listen, powerAxis, redraw, REACH, roundEpsilon, ROW, RULES } from './marks';
import type { EpsilonPlotEvents, EpsilonState } from './marks';
import { ACCENT, INK, plotIn } from './plot';

/** Shares of the range beside the curve, and above it, where the names are. */
const ROOM = 0.06;
const NAMES = 0.36;
/** Places from each ε of the curve to the next, for pointing. */
const FINE = 8;
/** Pixels around the curve in which it is pointed at. */
const NEAR = 40;

interface Place {
  epsilon: number;
  x: number;
  y: number;
}

export class LCurve {
  private readonly plot: uPlot;
  /** Logarithms of both norms. */
  private curve: EpsilonCurve | null = null;
  private places: Place[] = [];
  /** How far the axes reach. */
  private ends: { x: [number, number]; y: [number, number] } = { x: [-3, 0], y: [-3, 0] };
  private state: EpsilonState = { epsilon: 1, hovered: null, choices: [] };

  constructor(box: HTMLElement, events: EpsilonPlotEvents) {
    this.plot = plotIn(box, {
      scales: {
        x: { time: false, range: () => this.ends.x },
        y: { range: () => this.ends.y },
      },
      axes: [
        powerAxis('distance ‖x − f‖', { size: 24, space: 44 }),
        powerAxis('roughness ‖Lx‖', { size: 38, space: 24 }),
      ],
      series: [{}, { paths: () => null, points: { show: false } }],
      cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
      hooks: { draw: [() => this.draw()] },
    });
    listen(this.plot, (x, y) => this.epsilonAt(x, y), events);
  }

  get handle(): HTMLElement {
    return this.plot.over;
  }

  setCurve(curve: EpsilonCurve | null): void {
    this.curve = curve && {
      ...curve,
      distances: curve.distances.map(Math.log10),
      roughness: curve.roughness.map(Math.log10),
    };
    this.places = [];
    const exponents = curve ? Array.from(curve.epsilons, Math.log10) : [];
    exponents.forEach((exponent, k) => {
      const next = exponents[k + 1] ?? exponent;
      for (let part = 0; part < (k + 1 < exponents.length ? FINE : 1); part++) {
        const place = this.placeOf(10 ** (exponent + (part / FINE) * (next - exponent)));
        if (place) this.places.push(place);
      }
    });
    if (this.places.length > 0) {
      this.ends = {
        x: reach(this.places.map(({ x }) => x)),
        y: reach(
          this.places.map(({ y }) => y),
          NAMES,
        ),
      };
    }
    this.plot.setData([this.ends.x, [null, null]]);
  }

  setState(state: EpsilonState): void {
    this.state = state;
    redraw(this.plot);
  }

  private placeOf(epsilon: number): Place | null {
    if (!this.curve) return null;
    const { distances, roughness } = this.curve;
    const x = along(this.curve, distances, epsilon);
    const y = along(this.curve, roughness, epsilon);
    return Number.isFinite(x) && Number.isFinite(y) ? { epsilon, x, y } : null;
  }

  private epsilonAt(x: number, y: number): number | null {
    const distance = (place: Place): number =>
      Math.hypot(this.plot.valToPos(place.x, 'x') - x, this.plot.valToPos(place.y, 'y') - y);
    const chosen = this.state.choices.find(({ epsilon }) => {
      const place = this.placeOf(epsilon);
      return place !== null && distance(place) <= REACH;
    });
    if (chosen) return chosen.epsilon;
    let best: Place | null = null;
    let least = NEAR;
    for (const place of this.places) {
      const far = distance(place);
      if (far < least) [best, least] = [place, far];
    }
    return best && roundEpsilon(Math.log10(best.epsilon));
  }

  private draw(): void {
    if (this.places.length === 0) return;
    const { plot, state } = this;
    const { ctx, bbox } = plot;
    const ratio = uPlot.pxRatio;
    const at = ({ x, y }: Place): [number, number] => [plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true)];
    ctx.save();
    ctx.beginPath();
    for (const place of this.places) ctx.lineTo(...at(place));
    ctx.strokeStyle = INK;
    ctx.lineWidth = 1.75 * ratio;
    ctx.lineJoin = 'round';
    ctx.stroke();
    const points = inRows(state.choices, (epsilon) => -epsilon);
    points.forEach((choice, row) => {
      const place = this.placeOf(choice.epsilon);
      if (!place) return;
      const [x, y] = at(place);
      const { color } = RULES[choice.rule];
      // The curve falls and leaves the upper right to the names: a thin line leads there.
      const [right, top] = [bbox.left + bbox.width, bbox.top + (ROW * (row + 0.5) + 2) * ratio];
      const left = right - drawName(plot, choice, right, top);
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.lineTo(left - 4 * ratio, top);
      ctx.strokeStyle = color;
      ctx.lineWidth = ratio;
      ctx.stroke();
    });
    for (const choice of points) {
      const place = this.placeOf(choice.epsilon);
      if (place) dot(plot, ...at(place), RULES[choice.rule].color, 4.5, true);
    }
    const current = this.placeOf(state.epsilon);
    if (current) dot(plot, ...at(current), ACCENT, 6, false);
    const hovered = state.hovered === null ? null : this.placeOf(state.hovered);
    if (hovered) dot(plot, ...at(hovered), INK, 3.5, false);
    ctx.restore();
  }
}

/** With room on all sides. `above`: a share of the range. */
function reach(values: number[], above = ROOM): [number, number] {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const width = high - low || 1;
  return [low - ROOM * width, high + above * width];
}
