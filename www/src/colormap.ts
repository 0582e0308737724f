/** Colour maps, as bytes: 256 sRGB colours from the low end of the range to the high end. */
import { interpolateCividis, interpolateRdYlBu, interpolateViridis } from 'd3-scale-chromatic';
import { Color } from 'three';

export const COLORMAPS = ['viridis', 'cividis', 'blueRed'] as const;
export type ColormapName = (typeof COLORMAPS)[number];

const SAMPLES = 256;

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
