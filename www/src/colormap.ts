/** Colour maps, as bytes: sRGB colours from the low end of the range to the high end; and the colours of basins. */
import { interpolateCividis, interpolateRdYlBu, interpolateViridis, schemeSet3 } from 'd3-scale-chromatic';
import { Color } from 'three';

export const COLORMAPS = ['viridis', 'cividis', 'blueRed'] as const;
export type ColormapName = (typeof COLORMAPS)[number];

/**
 * As wide as any WebGL 2 can have a texture. The bands of a filled contour plot begin at a sample: that is nearer to the level
 * than the line drawn there is wide.
 */
export const SAMPLES = 2048;

const MAPS: Record<ColormapName, (t: number) => string> = {
  viridis: interpolateViridis,
  cividis: interpolateCividis,
  blueRed: (t) => interpolateRdYlBu(1 - t),
};

/** RGBA, four bytes a colour. */
export function colormapBytes(name: ColormapName): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(4 * SAMPLES);
  const colour = new Color();
  for (let k = 0; k < SAMPLES; k++) {
    const hex = colour.setStyle(MAPS[name](k / (SAMPLES - 1))).getHex();
    bytes.set([hex >> 16, (hex >> 8) & 255, hex & 255, 255], 4 * k);
  }
  return bytes;
}

/**
 * From decrease over no change to increase: Kenneth Moreland's cool-warm map, grey in the middle and so seen on white.
 * See "Diverging Color Maps for Scientific Visualization" (2009).
 */
const DIVERGING: readonly [number, number, number][] = [
  [59, 76, 192],
  [98, 130, 234],
  [141, 176, 254],
  [184, 208, 249],
  [221, 221, 221],
  [245, 196, 173],
  [244, 154, 123],
  [222, 96, 77],
  [180, 4, 38],
];

/** RGBA, four bytes a colour; zero is in the middle. */
export function differenceBytes(): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(4 * SAMPLES);
  for (let k = 0; k < SAMPLES; k++) {
    const place = (k / (SAMPLES - 1)) * (DIVERGING.length - 1);
    const from = Math.min(DIVERGING.length - 2, Math.floor(place));
    for (let c = 0; c < 3; c++) {
      const [low, high] = [DIVERGING[from]![c]!, DIVERGING[from + 1]![c]!];
      bytes[4 * k + c] = Math.round(low + (place - from) * (high - low));
    }
    bytes[4 * k + 3] = 255;
  }
  return bytes;
}

/**
 * One colour between two levels: that of the middle of the band. `levels` are shares of the range, ascending. The texture is
 * read for every pixel, so that the bands' edges do not follow those of the mesh.
 */
export function bandedBytes(smooth: Uint8Array, levels: readonly number[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(smooth.length);
  const ends = [0, ...levels.filter((level) => level > 0 && level < 1), 1];
  for (let band = 0; band + 1 < ends.length; band++) {
    const [low, high] = [ends[band]!, ends[band + 1]!];
    const middle = 4 * Math.round(((low + high) / 2) * (SAMPLES - 1));
    const colour = smooth.subarray(middle, middle + 4);
    for (let k = Math.round(low * (SAMPLES - 1)); k <= Math.round(high * (SAMPLES - 1)); k++) bytes.set(colour, 4 * k);
  }
  return bytes;
}

/** Pale enough for lines and glyphs to stand out. As many as basins.ts has colours. */
const BASINS: readonly string[] = schemeSet3;
const NOWHERE = '#e8ecf3';

/** Linear red, green and blue of each vertex, as the graphics card mixes them. */
export function basinColours(numbers: Uint8Array): Float32Array<ArrayBuffer> {
  const palette = [...BASINS, NOWHERE].map((text) => new Color().setStyle(text).toArray());
  const colours = new Float32Array(3 * numbers.length);
  numbers.forEach((number, i) => colours.set(palette[Math.min(number, BASINS.length)]!, 3 * i));
  return colours;
}
