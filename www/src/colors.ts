/** What the colors of both views mean, and the legends that say it. */
import { element, short, whole } from './dom';
import { drawBar, Legend } from './legend';
import type { Panel } from './panel';
import type { Coloring, Part, Side } from './protocol';

export class Colors {
  private readonly legend = new Legend();
  private readonly difference = element('#difference', HTMLElement);
  private readonly differenceBar = element('#difference-bar', HTMLCanvasElement);
  /** How many there are on each side. */
  private readonly basins: Record<Side, number> = { before: 0, after: 0 };
  private coloring: Coloring = 'value';
  private hasDifference = false;

  constructor(private readonly panels: Record<Side, Panel>) {}

  /** Of the values, on both sides. `stepped`: one color between two levels. */
  setTable(colors: Uint8Array, stepped: boolean): void {
    this.legend.setColors(colors);
    for (const { viewer } of Object.values(this.panels)) viewer?.setColors(colors, stepped);
  }

  /** Another field: what is known of the one after belongs to the last. */
  setField(label: string, range: [number, number], gap: number | null): void {
    this.legend.setRange(label, range);
    this.legend.setGap(gap);
    this.clearDifference();
  }

  setLevels(levels: number[]): void {
    this.legend.setLevels(levels);
  }

  setBasins({ side, count, colors }: Extract<Part, { kind: 'basins' }>): void {
    this.basins[side] = count;
    this.panels[side].viewer?.setBasins(colors);
    this.name(this.coloring);
  }

  setDifference({ largest, shades, colors, gap }: Extract<Part, { kind: 'difference' }>): void {
    this.panels.after.viewer?.setDifference(shades, colors, gap);
    drawBar(this.differenceBar, colors);
    element('#difference-low', HTMLElement).textContent = short(-largest);
    element('#difference-high', HTMLElement).textContent = largest > 0 ? `+${short(largest)}` : '0';
    this.hasDifference = true;
    this.name(this.coloring);
  }

  clearDifference(): void {
    this.hasDifference = false;
    this.name(this.coloring);
  }

  /** What the colors are, where they are not those of the bar. */
  name(coloring: Coloring): void {
    this.coloring = coloring;
    const counts = `${whole(this.basins.before)} → ${whole(this.basins.after)}`;
    const isByBasins = coloring === 'minima' || coloring === 'maxima';
    this.legend.setBasins(isByBasins ? `${counts} basins of ${coloring}` : null);
    this.difference.hidden = coloring !== 'difference' || !this.hasDifference;
  }
}
