import { misuse } from '../failures.js';
import { chooseField, readInput } from '../input.js';
import { api, own, take } from '../options.js';
import { checkPlace, write } from '../output.js';
import { pick } from './critical.js';

const SHEET = take('titles differenceColormap largestDifference');
const OPTIONS = { ...take(api.pictures.snapshot, 'count persistence', api.pictures.camera), ...SHEET };

export const draw = {
  name: 'draw',
  summary: 'a picture of a field on its mesh, or of two and their difference, as PNG',
  options: {
    ...own.field,
    ...take('column', api.files.readMesh, api.files.weld),
    after: { kind: 'text', value: 'NAME', help: 'another field: draws the two and their difference' },
    size: { kind: 'size', value: 'WxH', help: 'width and height at once' },
    ...OPTIONS,
    output: { ...own.result.output, help: 'where the picture goes; - is the standard output' },
    ...own.common,
  },
  examples: [
    'morse-smooth draw torus.ply --field noisy -o torus.png',
    'morse-smooth draw torus.ply --field clean --size 800x600 --colormap cool-warm --range -1,1 --bands -o torus.png',
    'morse-smooth draw smooth.ply --field noisy --after noisy_smoothed -o sheet.png',
  ],
  async run({ input, given, notes }) {
    const path = given.output ?? '-';
    if (path === '-' && process.stdout.isTTY) throw misuse('a picture does not go to a terminal', 'name a file by -o');
    if (path !== '-' && !/\.png$/i.test(path)) throw misuse(`pictures are PNG files, and ${path} is named otherwise`);
    checkPlace(given.output);
    const options = settingsOf(given);
    const file = await readInput(input, given, notes);
    const { values } = chooseField(file, given, input);
    const { sheet, snapshot } = await import('morse-smooth/snapshot');
    const { positions, triangles } = file;
    if (given.after === undefined) return write(path, snapshot(positions, triangles, values, options));
    const after = chooseField({ ...file, chosen: null }, { field: given.after }, input);
    return write(path, sheet(positions, triangles, values, after.values, options));
  },
};

/** The options as the API takes them. */
function settingsOf(given) {
  const { size, width, height, count, levels, persistence, morseComplex, direction, up } = given;
  if (size && (width ?? height) !== undefined) throw misuse('--size says width and height already');
  if (levels && count !== undefined) throw misuse('--levels and --count exclude each other');
  const foreign = given.after === undefined && Object.keys(pick(given, SHEET))[0];
  if (foreign) throw misuse('titles and differences are for two fields', 'name the other one by --after');
  const parts = ['count', 'persistence', 'direction', 'up'];
  const plain = Object.fromEntries(Object.entries(pick(given, OPTIONS)).filter(([name]) => !parts.includes(name)));
  const camera = { ...(direction && { direction }), ...(up && { up }) };
  return {
    ...plain,
    ...(size && { width: size[0], height: size[1] }),
    ...(count !== undefined && { levels: { count } }),
    ...(persistence !== undefined && { morseComplex: { persistence } }),
    ...(morseComplex && persistence === undefined && { morseComplex }),
    ...(Object.keys(camera).length > 0 && { camera }),
  };
}
