// The color maps and signs of the pictures, for entries that have no WebAssembly module: what the module draws says what they are.
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { dist } from './paths.mjs';

/** How src/js imports them: `import { maps, gap, line, kinds } from 'looks:'`. */
const NAME = 'looks:';

const MAPS = ['viridis', 'cividis', 'magma', 'inferno', 'plasma', 'coolWarm', 'blueRed', 'purpleGreen'];

/** Of a module's 512 colors so many steps apart are kept: straight lines between them are off by a 255th at most. */
const STEP = 7;

/** A plugin for rolldown. The bundles of the module must be there. */
export const looks = {
  name: 'looks',
  resolveId: (id) => (id === NAME ? `\0${NAME}` : null),
  async load(id) {
    if (id !== `\0${NAME}`) return null;
    const { Scene } = await import(pathToFileURL(join(dist, 'snapshot-node.mjs')).href);
    const scene = new Scene([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0], [0, 1, 2, 1, 3, 2]);
    const kinds = { vertices: [0, 1, 2], kinds: Int8Array.of(-1, 0, 1) };
    const list = (colormap) =>
      scene.drawList([0, 0.5, 1, NaN], { colormap, levels: [0.25], criticalPoints: kinds, missing: 'omit' });
    const maps = Object.fromEntries(MAPS.map((name) => [name, thinned(list(name).colors)]));
    const { gap, lines, solids } = list(MAPS[0]);
    const colorOf = Object.fromEntries(solids.map(({ kind, color }) => [kind, color]));
    scene.free();
    return `/** Red, green and blue at equal steps, as text in base 64. */
export const maps = ${JSON.stringify(maps)};
/** The color of what has no value. */
export const gap = ${gap};
/** The color of level sets. */
export const line = ${lines[0].stroke.color};
/** The colors of minima, saddles and maxima. */
export const kinds = ${JSON.stringify([colorOf.minima, colorOf.saddles, colorOf.maxima])};
`;
  },
};

function thinned(colors) {
  const count = colors.length / 3;
  const kept = Array.from({ length: 1 + (count - 1) / STEP }, (_, k) => [
    ...colors.subarray(3 * STEP * k, 3 * STEP * k + 3),
  ]);
  return Buffer.from(kept.flat()).toString('base64');
}
