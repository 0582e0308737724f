/** What the colours of both views mean, and the legends that say it. */
import { element, short, whole } from './dom';
import { drawBar, Legend } from './legend';
import type { Panel } from './panel';
import type { Colouring, Part, Side } from './protocol';

export class Colours {
  private readonly legend = new Legend();
  private readonly difference = element('#difference', HTMLElement);
  private readonly differenceBar = element('#difference-bar', HTMLCanvasElement);
  /** How many there are on each side. */
  private readonly basins: Record<Side, number> = { before: 0, after: 0 };
  private colouring: Colouring = 'value';
  private hasDifference = false;

  constructor(private readonly panels: Record<Side, Panel>) {}

  /** Of the values, on both sides. `stepped`: one colour between two levels. */
  setTable(colours: Uint8Array, stepped: boolean): void {
    this.legend.setColours(colours);
    for (const { viewer } of Object.values(this.panels)) viewer?.setColours(colours, stepped);
  }

  /** Another field: what is known of the one after belongs to the last. */
  setField(label: string, range: [number, number]): void {
    this.legend.setRange(label, range);
    this.clearDifference();
  }

  setLevels(levels: number[]): void {
    this.legend.setLevels(levels);
  }

  setBasins({ side, count, colours }: Extract<Part, { kind: 'basins' }>): void {
    this.basins[side] = count;
    this.panels[side].viewer?.setBasins(colours);
    this.name(this.colouring);
  }

  setDifference({ largest, shades, colours }: Extract<Part, { kind: 'difference' }>): void {
    this.panels.after.viewer?.setDifference(shades, colours);
    drawBar(this.differenceBar, colours);
    element('#difference-low', HTMLElement).textContent = short(-largest);
    element('#difference-high', HTMLElement).textContent = largest > 0 ? `+${short(largest)}` : '0';
    this.hasDifference = true;
    this.name(this.colouring);
  }

  clearDifference(): void {
    this.hasDifference = false;
    this.name(this.colouring);
  }

  /** What the colours are, where they are not those of the bar. */
  name(colouring: Colouring): void {
    this.colouring = colouring;
    const counts = `${whole(this.basins.before)} → ${whole(this.basins.after)}`;
    const isByBasins = colouring === 'minima' || colouring === 'maxima';
    this.legend.setBasins(isByBasins ? `${counts} basins of ${colouring}` : null);
    this.difference.hidden = colouring !== 'difference' || !this.hasDifference;
  }
}
