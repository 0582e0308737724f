import { misuse } from '../failures.js';
import { chooseField, readInput } from '../input.js';
import { api, own, take } from '../options.js';
import { checkPlace, tableText, write } from '../output.js';
import { counted, jsonText, writeReport } from '../report.js';
import { pick } from './critical.js';

const OPTIONS = take(api.core.levelSets);
const LINES = { csv: csvText, json: (report) => jsonText(report), obj: objText };
const DEFAULT_COUNT = 15;

export const levels = {
  name: 'levels',
  summary: 'level sets of a field, as lines',
  about: `Without --levels, --count or --saddles there are ${DEFAULT_COUNT} levels. Without -o and --to it prints how many lines each level has. Lines are written as csv (a row for each point), json or obj.`,
  options: {
    ...own.field,
    ...take('column', api.files.readMesh, api.files.weld, 'levels count saddles offset'),
    ...OPTIONS,
    output: { ...own.report.output, help: 'where the lines go; - is the standard output' },
    to: {
      ...own.report.to,
      help: `what is written: ${Object.keys(LINES).join(', ')}; default: by the ending of the file`,
    },
    ...own.json,
    ...own.common,
  },
  examples: [
    'morse-smooth levels torus.ply --field clean --count 10 -o lines.obj',
    'morse-smooth levels torus.ply --field clean --levels 0,0.5 --to csv > lines.csv',
    'morse-smooth levels torus.ply --field clean --saddles --json',
  ],
  async run({ input, given, notes }) {
    const format = formatOf(given);
    const wanted = wantedOf(given);
    const file = await readInput(input, given, notes);
    const { name, values } = chooseField(file, given, input);
    const mesh = file.make();
    notes.warn(input, mesh.warnings);
    const found = mesh.levelSets(values, wanted, { ...pick(given, OPTIONS), ...notes.progress });
    notes.clear();
    const lines = linesOf(found);
    const report = { file: input, field: name, lines };
    if (format !== null) return write(given.output ?? '-', LINES[format](report));
    const byLevel = new Map();
    for (const { level, closed, points } of lines) {
      const row = byLevel.get(level) ?? [level, 0, 0, 0];
      byLevel.set(level, [level, row[1] + 1, row[2] + (closed ? 1 : 0), row[3] + points.length]);
    }
    return writeReport(
      { path: '-', format: 'text' },
      {
        lines: [`${name}: ${counted(lines.length, 'line')} on ${counted(byLevel.size, 'level')}`],
        columns: ['level', 'lines', 'closed', 'points'],
        rows: [...byLevel.values()].sort(([one], [other]) => one - other),
      },
    );
  },
};

/** As what lines are written, or null where they are counted alone. */
function formatOf({ output, to, json }) {
  if (json && to !== undefined && to !== 'json') throw misuse('--json and --to say different things');
  const ending = output === undefined || output === '-' ? undefined : /\.(\w+)$/.exec(output)?.[1].toLowerCase();
  const format = to ?? (json ? 'json' : ending);
  if (format === undefined && output === undefined) return null;
  if (!Object.hasOwn(LINES, format ?? '')) {
    throw misuse(
      `lines are written as ${Object.keys(LINES).join(', ')}`,
      'choose one by --to or the ending of the file',
    );
  }
  checkPlace(output);
  return format;
}

/** The levels, as the API takes them. */
function wantedOf({ levels: values, count, saddles, offset }) {
  const given = Object.entries({ levels: values, count, saddles }).filter(([, value]) => value !== undefined);
  if (given.length > 1) throw misuse(`${given.map(([name]) => `--${name}`).join(' and ')} exclude each other`);
  if (offset !== undefined && !saddles) throw misuse('--offset goes with --saddles');
  if (saddles) return { saddles: true, ...(offset !== undefined && { offset }) };
  return values ?? { count: count ?? DEFAULT_COUNT };
}

/** Lines one by one. */
function linesOf({ points, offsets, levels: ofLines, closed }) {
  return Array.from(ofLines, (level, k) => ({
    level,
    closed: closed[k] === 1,
    points: Array.from({ length: offsets[k + 1] - offsets[k] }, (_, i) => {
      const start = 3 * (offsets[k] + i);
      return Array.from(points.subarray(start, start + 3));
    }),
  }));
}

function csvText({ lines }) {
  const rows = lines.flatMap(({ level, closed, points }, line) =>
    points.map((point) => [line, level, closed ? 1 : 0, ...point]),
  );
  return tableText(['line', 'level', 'closed', 'x', 'y', 'z'], rows);
}

/** Polylines of OBJ; those that close name their first point again. */
function objText({ lines }) {
  const parts = [];
  let next = 1;
  for (const { level, closed, points } of lines) {
    parts.push(`# level ${level}`, ...points.map((point) => `v ${point.join(' ')}`));
    const ids = points.map((_, i) => next + i);
    parts.push(`l ${[...ids, ...(closed ? [next] : [])].join(' ')}`);
    next += points.length;
  }
  return `${parts.join('\n')}\n`;
}
