import { chooseField, readInput } from '../input.js';
import { api, own, take } from '../options.js';
import { targetOf } from '../output.js';
import { counted, rangeOf, shown } from '../report.js';
import { pick } from './critical.js';
import { countsTable, deliver, needed, refuseFieldless } from './result.js';

const OPTIONS = take(api.core.simplify);

export const simplify = {
  name: 'simplify',
  summary: 'removes extrema of little persistence, or all but chosen ones, with small changes',
  about:
    'Writes the mesh with one field more, and prints what was done. No value changes by more than the threshold. The result has no other extrema, but it is flat where they were: ‘prescribe’ makes it smooth.',
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
    'morse-smooth simplify torus.ply --field noisy --threshold 0.1 -o simple.ply',
    'morse-smooth simplify torus.ply --field noisy --keep 599,26 -o simple.ply',
  ],
  async run({ input, given, notes }) {
    needed(given, ['threshold', 'keep'], 'such as --threshold 0.05, relative to the range of the field');
    const target = await targetOf(given);
    refuseFieldless(target);
    const file = await readInput(input, given, notes);
    const field = chooseField(file, given, input);
    const mesh = file.make();
    notes.warn(input, mesh.warnings);
    const { values, unavoidable } = mesh.simplify(field.values, { ...pick(given, OPTIONS), ...notes.progress });
    const missing = given.missing === undefined ? {} : { missing: given.missing };
    const [before, after] = [field.values, values].map((each) => mesh.criticalPoints(each, missing).counts);
    const largestChange = values.reduce((most, value, v) => Math.max(most, Math.abs(value - field.values[v]) || 0), 0);
    const { min, max } = rangeOf(field.values);
    const lines = [
      ...countsTable(before, after),
      '',
      `largest change ${shown((100 * largestChange) / (max - min))} % of the range`,
      ...(unavoidable.length > 0
        ? [`${counted(unavoidable.length, 'extremum', 'extrema')} that no field on this mesh can do without`]
        : []),
    ];
    const name = given.name ?? `${field.name}_simplified`;
    const result = { name, values, json: { before, after, largestChange, unavoidable }, lines };
    return deliver(target, result, { input, file, field, given, notes });
  },
};
