import { chooseField, readInput } from '../input.js';
import { api, own, take } from '../options.js';
import { KINDS, countsLine, reportTarget, writeReport } from '../report.js';

const OPTIONS = take(api.core.criticalPoints);

export const critical = {
  name: 'critical',
  summary: 'the minima, saddles and maxima of a field',
  options: {
    ...own.field,
    ...take('column', api.files.readMesh, api.files.weld),
    ...OPTIONS,
    ...own.report,
    ...own.json,
    ...own.common,
  },
  examples: [
    'morse-smooth critical torus.ply --field clean',
    'morse-smooth critical torus.ply --field noisy --delta 0.05 --link skip --json',
    'morse-smooth critical torus.ply --field noisy -o critical.csv',
  ],
  async run({ input, given, notes }) {
    const target = reportTarget(given);
    const file = await readInput(input, given, notes);
    const { name, values } = chooseField(file, given, input);
    const mesh = file.make();
    notes.warn(input, mesh.warnings);
    const found = mesh.criticalPoints(values, { ...pick(given, OPTIONS), ...notes.progress });
    const { vertices, kinds, multiplicities, onBoundary, counts } = found;
    const points = Array.from(vertices, (vertex, k) => ({
      vertex,
      kind: KINDS[kinds[k]],
      value: values[vertex],
      multiplicity: multiplicities[k],
      onBoundary: onBoundary[k] === 1,
    }));
    const sum = counts.indexSum === null ? '' : `, index sum ${counts.indexSum}`;
    return writeReport(target, {
      json: { file: input, field: name, counts, criticalPoints: points },
      lines: [`${name}: ${countsLine(counts)}${sum}`],
      columns: ['vertex', 'kind', 'value', 'multiplicity', 'boundary'],
      rows: points.map((point) => [
        point.vertex,
        point.kind,
        point.value,
        point.multiplicity,
        point.onBoundary ? 'yes' : 'no',
      ]),
    });
  },
};

/** Those of the given options that are among some. */
export function pick(given, options) {
  return Object.fromEntries(Object.entries(given).filter(([name]) => name in options));
}
