/** Textures of a draw list's colors, and the colors of basins. */
import { BufferAttribute, Color, DataTexture, LinearFilter, NearestFilter, SRGBColorSpace } from 'three';
import { BASIN_COLOURS } from './basins';

/** `stepped`: colors with steps between them, which must not be blurred. */
export function textureOf(colors: Uint8Array, stepped: boolean): DataTexture {
  const count = colors.length / 3;
  const bytes = new Uint8Array(4 * count).fill(255);
  for (let k = 0; k < count; k++) bytes.set(colors.subarray(3 * k, 3 * k + 3), 4 * k);
  const texture = new DataTexture(bytes, count, 1);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = texture.minFilter = stepped ? NearestFilter : LinearFilter;
  // Shade 0 is the middle of the first texel, 1 that of the last.
  texture.offset.x = 0.5 / count;
  texture.repeat.x = (count - 1) / count;
  texture.needsUpdate = true;
  return texture;
}

/** Texture coordinates that look shades up. The color is looked up for every pixel, not mixed between the corners' colors. */
export function along(shades: Float32Array): BufferAttribute {
  const uv = new Float32Array(2 * shades.length);
  for (let i = 0; i < shades.length; i++) {
    uv[2 * i] = shades[i]!;
    uv[2 * i + 1] = 0.5;
  }
  return new BufferAttribute(uv, 2);
}

/**
 * Pale enough for lines and glyphs to stand out, and no two nearer to each other than 0.1 in Oklab; 0.045 as people without red or
 * green cones see them. Those that are used most often, the first ones, are farthest apart.
 */
const BASINS = [
  '#92a8eb',
  '#fee296',
  '#d3a062',
  '#fed6fa',
  '#7cbd89',
  '#db91b4',
  '#a6d0d8',
  '#a8face',
  '#bfd186',
  '#fab2b0',
  '#dbb5f8',
  '#51bcce',
] as const satisfies { length: typeof BASIN_COLOURS };
const NOWHERE = '#e8ecf3';

/** Linear red, green and blue of each corner, as the graphics card mixes them, from the numbers of the vertices' colors. */
export function basinColors(numbers: Uint8Array, vertices: Uint32Array): Float32Array {
  const palette = [...BASINS, NOWHERE].map((text) => new Color().setStyle(text).toArray());
  const colors = new Float32Array(3 * vertices.length);
  vertices.forEach((vertex, i) => colors.set(palette[Math.min(numbers[vertex]!, BASINS.length)]!, 3 * i));
  return colors;
}
