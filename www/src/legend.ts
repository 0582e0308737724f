/** The color bar: the colors from low to high, the level sets as ticks in it, numbers under it. */
import { element, short } from './dom';

const LABELS = 5;
/** The ends carry the exact range; a round number nearer to them than this many pixels would touch them. */
const ROOM = 66;

/** Where there is nothing to say, or nothing yet. */
const PLAIN = Uint8Array.of(0xe8, 0xec, 0xf3);

export class Legend {
  private readonly bar = element('#legend-bar', HTMLCanvasElement);
  private readonly ticks = element('#legend-ticks', HTMLElement);
  private readonly name = element('#legend-field', HTMLElement);
  private readonly what = element('#legend-what', HTMLElement);
  private readonly gap = element('#legend-gap', HTMLElement);
  private range: [number, number] = [0, 1];
  private levels: number[] = [];
  private plain = false;
  private colors: Uint8Array = PLAIN;

  constructor() {
    new ResizeObserver(() => this.write()).observe(this.ticks);
  }

  /** Red, green and blue at equal steps. */
  setColors(colors: Uint8Array): void {
    this.colors = colors;
    this.draw();
  }

  setRange(label: string, range: [number, number]): void {
    this.range = range;
    this.name.textContent = label;
    this.write();
    this.draw();
  }

  /** What colors the surface where it is not the values; the bar is then about the levels alone. */
  setBasins(what: string | null): void {
    this.what.textContent = what === null ? 'Colors and levels of' : `${what}; bar: levels`;
    this.name.hidden = what !== null;
    this.plain = what !== null;
    this.draw();
  }

  /** The color of what has no value; null where there are no gaps. */
  setGap(color: number | null): void {
    this.gap.hidden = color === null;
    this.gap.style.setProperty('--gap', `#${(color ?? 0).toString(16).padStart(6, '0')}`);
  }

  setLevels(levels: number[]): void {
    this.levels = levels;
    this.draw();
  }

  /** Again whenever the bar's width changes. */
  private write(): void {
    const [low, high] = this.range;
    const width = this.ticks.clientWidth;
    const along = (value: number): number => (high > low ? (value - low) / (high - low) : 0);
    const inner = roundNumbers(low, high).filter(
      (value) => width * along(value) > ROOM && width * (1 - along(value)) > ROOM,
    );
    const marks: [number, string][] =
      high > low ? [low, ...inner, high].map((value) => [value, short(value)]) : [[low, `${short(low)} everywhere`]];
    this.ticks.replaceChildren(
      ...marks.map(([value, text]) => {
        const mark = document.createElement('span');
        mark.textContent = text;
        mark.style.left = `${100 * along(value)}%`;
        return mark;
      }),
    );
  }

  private draw(): void {
    const { width, height } = this.bar;
    drawBar(this.bar, this.plain ? PLAIN : this.colors);
    const context = this.bar.getContext('2d');
    if (!context) return;
    const [low, high] = this.range;
    context.fillStyle = 'rgb(13 19 32 / 85%)';
    for (const level of this.levels) context.fillRect(Math.round(((level - low) / (high - low)) * width), 0, 1, height);
  }
}

export function drawBar(bar: HTMLCanvasElement, colors: Uint8Array): void {
  const context = bar.getContext('2d');
  const last = colors.length / 3 - 1;
  for (let x = 0; context && x < bar.width; x++) {
    const k = 3 * Math.round((last * x) / (bar.width - 1));
    context.fillStyle = `rgb(${colors[k]} ${colors[k + 1]} ${colors[k + 2]})`;
    context.fillRect(x, 0, 1, bar.height);
  }
}

/** Multiples of 1, 2 or 5 times a power of ten inside the range, about LABELS of them. */
function roundNumbers(low: number, high: number): number[] {
  const width = high - low;
  if (!(width > 0) || !Number.isFinite(width)) return [];
  const rough = width / LABELS;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= rough) ?? 10);
  const first = Math.ceil(low / step);
  const last = Math.floor(high / step);
  // Multiplying whole numbers keeps 0.30000000000000004 out of the labels.
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}
