import { misuse } from '../failures.js';
import { chooseField, readInput } from '../input.js';
import { targetOf } from '../output.js';
import { api, own, take, written } from '../options.js';
import { pick } from './critical.js';
import { constraintsOf, epsilonOf } from './rules.js';
import { deliver, refuseFieldless, smoothLines } from './result.js';

const METHODS = ['tikhonov', 'leastSquares', 'interpolate', 'lowPass', 'bilateral'];
const SYSTEMS = take(api.core['new Smoother']);
const RULES = take('noise count', api.core.constraints);
const NAMES = METHODS.map((name) => api.core[name]);
const OPTIONS = {
  ...take('method noise count', ...NAMES, api.core['new Smoother'], api.core.constraints),
  count: { ...RULES.count, help: 'the most critical points, for --epsilon atMostCriticalPoints' },
  missing: { ...take('missing').missing, help: 'values that are missing (NaN): error (default), omit, fill' },
};

export const smooth = {
  name: 'smooth',
  summary: 'smooths a field, with or without constraints',
  about:
    'Writes the mesh with one field more, and prints what smoothing did. Without -o and --to it only prints; where the mesh goes to the standard output, the report goes to the standard error output.',
  options: {
    ...own.field,
    ...take('column', api.files.readMesh, api.files.weld),
    ...OPTIONS,
    ...own.result,
    ...take('binary'),
    ...own.json,
    ...own.common,
  },
  examples: [
    'morse-smooth smooth torus.ply --field noisy --epsilon 0.05 -o smooth.ply',
    'morse-smooth smooth torus.ply --field noisy --constraints persistence --threshold 0.1 --epsilon 0.05 -o kept.vtk',
    'morse-smooth smooth shape.obj --values heat.csv --column T --epsilon auto --to csv > smooth.csv',
    'morse-smooth smooth torus.ply --field noisy --method low-pass --iterations 50 --lambda 0.5 --mu -0.53',
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
    const { method, ...settings } = options;
    const { values, report } = smoother[method](field.values, settings);
    const name = given.name ?? `${field.name}_smoothed`;
    const result = { name, values, json: { report }, lines: smoothLines(report) };
    return deliver(target, result, { input, file, field, given, notes });
  },
};

/** The method and its options, as the API takes them; it refuses those that are for other methods. */
function settingsOf(given) {
  const { method = given.constraints === undefined ? 'tikhonov' : 'leastSquares' } = given;
  if (method === 'prescribe')
    throw misuse('--method prescribe is a command of its own', 'see ‘morse-smooth prescribe --help’');
  if (!METHODS.includes(method)) throw misuse(`--method takes ${METHODS.join(', ')}, and not ‘${method}’`);
  const isOf = (name) => api.core[method].split(' ').includes(name);
  const needsEpsilon = isOf('epsilon') && given.cutoffWavelength === undefined;
  if (isOf('constraints') && given.constraints === undefined) {
    throw misuse(`--method ${method} needs --constraints`, 'critical-points, persistence --threshold 0.1, or vertices');
  }
  // These are parts of others, or of the smoother.
  const ruled = { ...RULES, ...SYSTEMS, epsilon: null, constraints: null };
  const plain = Object.fromEntries(Object.entries(pick(given, OPTIONS)).filter(([name]) => !(name in ruled)));
  for (const name of ['epsilon', 'constraints']) {
    if (!isOf(name) && given[name] !== undefined) throw misuse(`--${name} is not for --method ${method}`);
  }
  const foreign = Object.keys(plain).find((name) => name !== 'method' && !isOf(name));
  if (foreign !== undefined) throw misuse(`${written(foreign, OPTIONS[foreign])} is not for --method ${method}`);
  const epsilon = epsilonOf(given);
  const constraints = constraintsOf(given);
  return {
    ...plain,
    method,
    ...(given.epsilon !== undefined || needsEpsilon ? { epsilon } : {}),
    ...(constraints === undefined ? {} : { constraints }),
  };
}
