/** What the colours of both views mean, and the legends that say it. */
import { bandedBytes, basinColours, colormapBytes, differenceBytes, SAMPLES } from './colormap';
import type { ColormapName } from './colormap';
import { element, short, whole } from './dom';
import { Legend } from './legend';
import type { Panel } from './panel';
import type { Colouring, Part, Side } from './protocol';

export class Colours {
  private readonly legend = new Legend();
  private readonly difference = element('#difference', HTMLElement);
  /** Colours by value: the map, in bands between the levels or not, over the range of the field before. */
  private map: ColormapName = 'viridis';
  private banded = false;
  private levels: number[] = [];
  private range: [number, number] = [0, 1];
  /** How many there are on each side. */
  private readonly basins: Record<Side, number> = { before: 0, after: 0 };
  private colouring: Colouring = 'value';
  private hasDifference = false;

  constructor(private readonly panels: Record<Side, Panel>) {
    drawBar(element('#difference-bar', HTMLCanvasElement));
    this.paint();
  }

  setMap(name: ColormapName, banded: boolean): void {
    this.map = name;
    this.banded = banded;
    this.paint();
  }

  /** Another field: what is known of the one after belongs to the last. */
  setField(label: string, range: [number, number]): void {
    this.range = range;
    this.legend.setRange(label, range);
    this.clearDifference();
  }

  setLevels(levels: number[]): void {
    this.levels = levels;
    this.legend.setLevels(levels);
    if (this.banded) this.paint();
  }

  setBasins({ side, count, colours }: Extract<Part, { kind: 'basins' }>): void {
    this.basins[side] = count;
    this.panels[side].viewer?.setBasins(basinColours(colours));
    this.name(this.colouring);
  }

  setDifference(largest: number, shades: Float32Array): void {
    this.panels.after.viewer?.setDifference(shades);
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

  private paint(): void {
    const [low, high] = this.range;
    const smooth = colormapBytes(this.map);
    const bytes = this.banded
      ? bandedBytes(
          smooth,
          this.levels.map((level) => (level - low) / (high - low)),
        )
      : smooth;
    this.legend.setColormap(bytes);
    for (const { viewer } of Object.values(this.panels)) viewer?.setColormap(bytes, this.banded);
  }
}

function drawBar(bar: HTMLCanvasElement): void {
  const context = bar.getContext('2d');
  const bytes = differenceBytes();
  for (let x = 0; context && x < bar.width; x++) {
    const k = 4 * Math.round(((SAMPLES - 1) * x) / (bar.width - 1));
    context.fillStyle = `rgb(${bytes[k]} ${bytes[k + 1]} ${bytes[k + 2]})`;
    context.fillRect(x, 0, 1, bar.height);
  }
}
