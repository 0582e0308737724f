import { chooseField, readInput } from '../input.js';
import { misuse } from '../failures.js';
import { api, own, take } from '../options.js';
import { counted, rangeOf, reportTarget, writeReport } from '../report.js';
import { pick } from './critical.js';

const OPTIONS = take(api.core.persistence);

export const persistence = {
  name: 'persistence',
  summary: 'which extrema matter: pairs of extrema and saddles, the most persistent first',
  options: {
    ...own.field,
    ...take('column', api.files.readMesh, api.files.weld, 'threshold thresholdIs'),
    ...OPTIONS,
    ...own.report,
    ...own.json,
    ...own.common,
  },
  examples: [
    'morse-smooth persistence torus.ply --field noisy --threshold 0.1',
    'morse-smooth persistence torus.ply --field noisy -o pairs.csv',
  ],
  async run({ input, given, notes }) {
    const target = reportTarget(given);
    const { threshold = 0, thresholdIs = 'relative' } = given;
    if (given.thresholdIs !== undefined && given.threshold === undefined)
      throw misuse('--threshold-is goes with --threshold');
    if (threshold < 0) throw misuse('--threshold takes a number that is not negative');
    if (!['relative', 'absolute'].includes(thresholdIs)) throw misuse('--threshold-is takes relative or absolute');
    const file = await readInput(input, given, notes);
    const { name, values } = chooseField(file, given, input);
    const mesh = file.make();
    notes.warn(input, mesh.warnings);
    const found = mesh.persistence(values, { ...pick(given, OPTIONS), ...notes.progress });
    const { min, max } = rangeOf(values);
    const least = thresholdIs === 'relative' ? threshold * (max - min) : threshold;
    const pairs = [];
    found.persistence.forEach((size, k) => {
      if (given.threshold !== undefined && !(size > least)) return;
      const kind = found.kinds[k] < 0 ? 'minimum' : 'maximum';
      const [extremum, saddle] = [found.extrema[k], found.saddles[k]];
      pairs.push({ kind, extremum, saddle, birth: found.birth[k], death: found.death[k], persistence: size });
    });
    const { essentialMinima, essentialMaxima, essentialSaddles } = found;
    const paired = (kind) => pairs.filter((pair) => pair.kind === kind).length;
    const limit =
      given.threshold === undefined
        ? ''
        : ` of persistence above ${threshold}${thresholdIs === 'relative' ? ' of the range' : ''}`;
    const all = (kind, essential) => counted(paired(kind) + essential.length, kind, kind.replace('um', 'a'));
    return writeReport(target, {
      json: { file: input, field: name, pairs, essentialMinima, essentialMaxima, essentialSaddles },
      lines: [
        `${name}: ${all('minimum', essentialMinima)} and ${all('maximum', essentialMaxima)}${limit}, those that are never paired included`,
        `never paired: minima ${listed(essentialMinima)}; maxima ${listed(essentialMaxima)}; saddles ${listed(essentialSaddles)}`,
      ],
      columns: ['kind', 'extremum', 'saddle', 'birth', 'death', 'persistence'],
      rows: pairs.map((pair) => Object.values(pair)),
    });
  },
};

const SHOWN = 10;
const listed = (vertices) =>
  vertices.length === 0 ? 'none' : `${vertices.slice(0, SHOWN).join(', ')}${vertices.length > SHOWN ? ', …' : ''}`;
