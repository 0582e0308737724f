/** Textures of a draw list's colors, and the colors of basins. */
import { BufferAttribute, Color, DataTexture, LinearFilter, NearestFilter, SRGBColorSpace } from 'three';
import type { Material } from 'three';
import { BASIN_COLORS } from './basins';

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

/** The second texture coordinate, where there is a value and where there is none: mixed with this, every place of a triangle is far off. */
const VALUE = 0.5;
const NO_VALUE = 1e6;

/**
 * Texture coordinates that look shades up. The color is looked up for every pixel, not mixed between the corners' colors. Corners
 * without a shade mark their triangles for {@link withGaps}.
 */
export function along(shades: Float32Array): BufferAttribute {
  const uv = new Float32Array(2 * shades.length);
  for (let i = 0; i < shades.length; i++) {
    const shade = shades[i]!;
    uv[2 * i] = Number.isNaN(shade) ? 0 : shade;
    uv[2 * i + 1] = Number.isNaN(shade) ? NO_VALUE : VALUE;
  }
  return new BufferAttribute(uv, 2);
}

/** Makes a material draw triangles with a marked corner in the color of gaps, as a whole: see {@link along}, {@link basinColors}. */
export function withGaps<M extends Material>(material: M, gap: Color): M {
  material.onBeforeCompile = (shader) => {
    shader.uniforms['gap'] = { value: gap };
    shader.fragmentShader = shader.fragmentShader.replace('void main() {', 'uniform vec3 gap;\nvoid main() {').replace(
      '#include <color_fragment>',
      `#include <color_fragment>
        #ifdef USE_MAP
          if (vMapUv.y > 1.0) diffuseColor.rgb = gap;
        #elif defined(USE_COLOR)
          if (vColor.r < 0.0) diffuseColor.rgb = gap;
        #endif`,
    );
  };
  return material;
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
] as const satisfies { length: typeof BASIN_COLORS };
/** A color that there is not: a corner in no basin has no value. */
const NOWHERE = [-NO_VALUE, 0, 0] as const;

/** Linear red, green and blue of each corner, as the graphics card mixes them, from the numbers of the vertices' colors. */
export function basinColors(numbers: Uint8Array, vertices: Uint32Array): Float32Array {
  const palette = [...BASINS.map((text) => new Color().setStyle(text).toArray()), NOWHERE];
  const colors = new Float32Array(3 * vertices.length);
  vertices.forEach((vertex, i) => colors.set(palette[Math.min(numbers[vertex]!, BASINS.length)]!, 3 * i));
  return colors;
}
