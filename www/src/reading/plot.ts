/** What all plots share: a uPlot without data of its own that fills its box, in the page's colors. */
import uPlot from 'uplot';
import { whole } from '../dom';

/** Kept equal to the colors in style.css; saddles are white there, which no line on white can be. */
export const INK = '#16202e';
export const SOFT = '#53617a';
export const MINIMUM = '#2f6bff';
export const MAXIMUM = '#e5263c';
export const SADDLE = '#5b6678';
export const ACCENT = '#1f4fc4';
export const GRID = '#e8ecf3';
export const FAMILY =
  "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', 'Noto Sans', 'DejaVu Sans', sans-serif";
const FONT = `12px ${FAMILY}`;

export function axis(label: string, more: uPlot.Axis): uPlot.Axis {
  return {
    label,
    stroke: SOFT,
    font: FONT,
    labelFont: FONT,
    labelSize: 16,
    labelGap: 0,
    gap: 3,
    grid: { stroke: GRID, width: 1 },
    ticks: { stroke: GRID, width: 1, size: 4 },
    ...more,
  };
}

/** Like a logarithm for large numbers, and has a 0; with room above for what is written there. */
export const COUNT_SCALE: uPlot.Scale = {
  distr: 4,
  range: (_plot, _low, high) => [0, Math.max(4, 1.4 * (high ?? 0))],
};

/** Of numbers of critical points, on the scale {@link COUNT_SCALE}. */
export function countAxis(): uPlot.Axis {
  return axis('critical points', {
    size: widthOf,
    space: 22,
    filter: powers,
    grid: { stroke: GRID, width: 1, filter: powers },
    ticks: { show: false },
    values: (plot, splits) => splits.map((value) => labelOf(plot, value)),
  });
}

/** Follows the size of its box, which the page's layout decides. */
export function plotIn(box: HTMLElement, options: Omit<uPlot.Options, 'width' | 'height'>): uPlot {
  const size = (): { width: number; height: number } => ({
    width: Math.max(120, box.clientWidth),
    height: Math.max(90, box.clientHeight),
  });
  const plot = new uPlot(
    { legend: { show: false }, padding: [8, 10, 0, 0], ...options, ...size() },
    [[], ...options.series.slice(1).map(() => [])],
    box,
  );
  new ResizeObserver(() => plot.setSize(size())).observe(box);
  return plot;
}

/** Where the pointer is, in pixels of the plotting area. */
export function pointIn(plot: uPlot, { clientX, clientY }: PointerEvent): [number, number] {
  const { left, top } = plot.over.getBoundingClientRect();
  return [clientX - left, clientY - top];
}

/** Room for the widest number. */
function widthOf(_plot: uPlot, values: string[] | null): number {
  return 12 + 7 * Math.max(1, ...(values ?? []).map((text) => text.length));
}

/** 1, 10, 100: what lies between them would be more lines than the curves are. */
function powers(_plot: uPlot, splits: number[]): (number | null)[] {
  return splits.map((value) => (value === 0 || Number.isInteger(Math.log10(value)) ? value : null));
}

/** Where there is no room between 0 and 1, the 0 goes before. */
function labelOf(plot: uPlot, value: number | null): string {
  if (value === null || (value === 1 && plot.valToPos(0, 'y') - plot.valToPos(1, 'y') < 14)) return '';
  return whole(value);
}
