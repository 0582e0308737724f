/** What both plots share: a uPlot without data of its own that fills its box, in the page's colors. */
import uPlot from 'uplot';

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
