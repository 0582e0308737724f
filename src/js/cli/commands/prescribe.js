import { misuse } from '../failures.js';
import { chooseField, readInput } from '../input.js';
import { api, own, take } from '../options.js';
import { targetOf } from '../output.js';
import { shown } from '../report.js';
import { pick } from './critical.js';
import { deliver, refuseFieldless, smoothLines } from './result.js';
import { constraintsOf, epsilonOf, extremaOf } from './rules.js';

const SYSTEMS = take(api.core['new Smoother']);
/** In this command they are about the extrema, not about constraints. */
const OF_EXTREMA = ['threshold', 'thresholdIs'];
/** Parts of others. */
const PART_NAMES = ['noise count epsilon constraints extrema', api.core.constraints, api.core.extrema];
const PARTS = take(...PART_NAMES);
const OPTIONS = {
  ...take(api.core.prescribe, api.core['new Smoother'], ...PART_NAMES),
  count: { ...take('count').count, help: 'the most critical points, for --epsilon atMostCriticalPoints' },
  range: { kind: 'choice', value: 'NAME', help: 'free (default); input: no value leaves the range of the input' },
};

export const prescribe = {
  name: 'prescribe',
  summary: 'the smoothest field that has exactly the chosen extrema',
  about:
    'Writes the mesh with one field more, and prints what was done. Without a choice it has the extrema of persistence above 0.05 of the range in the smoothed field.',
  options: {
    ...own.field,
    ...take('column', api.files.readMesh, api.files.weld),
    ...OPTIONS,
    keepValues: { kind: 'flag', help: 'the chosen extrema keep their values' },
    ...own.result,
    ...take('binary'),
    ...own.json,
    ...own.common,
  },
  examples: [
    'morse-smooth prescribe terrain.ply --epsilon 0.02 --threshold 0.05 -o exact.ply',
    'morse-smooth prescribe terrain.ply --epsilon 0.02 --minima 5 --maxima 8 -o exact.ply',
    'morse-smooth prescribe torus.ply --field noisy --extrema named --minima 599 --maxima 26 -o exact.ply',
  ],
  async run({ input, given, notes }) {
    const target = await targetOf(given);
    refuseFieldless(target);
    const options = settingsOf(given);
    const file = await readInput(input, given, notes);
    const field = chooseField(file, given, input);
    const { Smoother } = await import('morse-smooth');
    const mesh = file.make();
    notes.warn(input, mesh.warnings);
    const smoother = new Smoother(mesh, { ...pick(given, SYSTEMS), ...notes.progress });
    const { values, report, reports, ...about } = smoother.prescribe(field.values, options);
    const { energy, unconstrainedEnergy, leastSlack, gap, minima, maxima } = about;
    const excess = 100 * (energy / unconstrainedEnergy - 1);
    const lines = [
      ...smoothLines(report),
      `energy ${shown(energy)}, ${excess.toFixed(2)} % above that of the smoothed field; gap ${gap.toExponential(1)}, least slack ${shown(leastSlack)}`,
      `minima ${listed(minima)}`,
      `maxima ${listed(maxima)}`,
    ];
    const name = given.name ?? `${field.name}_prescribed`;
    const result = { name, values, json: { report, ...about }, lines };
    return deliver(target, result, { input, file, field, given, notes });
  },
};

const SHOWN = 20;
const listed = (vertices) => `${vertices.slice(0, SHOWN).join(', ')}${vertices.length > SHOWN ? ', …' : ''}`;

function settingsOf(given) {
  if (given.cutoffWavelength !== undefined && given.epsilon !== undefined) {
    throw misuse('--epsilon and --cutoff-wavelength say the same thing', 'give one of them');
  }
  const isRuled = (name) => name in PARTS || name in SYSTEMS;
  const plain = Object.fromEntries(Object.entries(pick(given, OPTIONS)).filter(([name]) => !isRuled(name)));
  const extrema = extremaOf(given);
  const constraints = constraintsOf(given, OF_EXTREMA);
  return {
    ...plain,
    ...(given.cutoffWavelength === undefined && { epsilon: epsilonOf(given) }),
    ...(extrema !== undefined && { extrema }),
    ...(constraints !== undefined && { constraints }),
    ...(given.keepValues && { values: 'keep' }),
  };
}
