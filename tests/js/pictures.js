// What the tests of pictures have in common: the field that they draw, and the first bytes of PNG files.
import { heights, torus } from './meshes.js';

/** A torus that stands upright, and a field with a few more critical points than its height. */
export const shape = torus(40, 20);
export const field = heights(shape).map((z, vertex) => z + 0.4 * Math.sin(3 * shape.positions[3 * vertex + 1]));

/** Small and quick to draw. */
export const small = { width: 120, height: 90 };

/** Width, height, bits and color type that a PNG file says it has. */
export function header(png) {
  const view = new DataView(png.buffer, png.byteOffset, png.byteLength);
  const [signature, rest, length, type] = [0, 4, 8, 12].map((offset) => view.getUint32(offset));
  if (signature !== 0x89504e47 || rest !== 0x0d0a1a0a) throw new Error('no PNG file');
  if (length !== 13 || type !== 0x49484452) throw new Error('its first chunk is not the header');
  return { width: view.getUint32(16), height: view.getUint32(20), bits: png[24], colorType: png[25] };
}
