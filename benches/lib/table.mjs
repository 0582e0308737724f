// Tables as text.
import { CHANNELS, EQUATIONS } from './calls.mjs';
import { median } from './clock.mjs';

/** Prints rows of texts, the first one as the head; all but the first column to the right. */
export function printTable(rows) {
  const widths = rows[0].map((_, column) => Math.max(...rows.map((row) => row[column].length)));
  const pad = (text, column) => (column === 0 ? text.padEnd(widths[column]) : text.padStart(widths[column]));
  for (const row of rows) console.log(row.map(pad).join('  ').trimEnd());
}

export const number = (value, digits = 3) =>
  Number.isFinite(value) ? value.toPrecision(digits) : value === Infinity ? '∞' : '–';
export const size = (count) => (count % 1e6 === 0 ? `${count / 1e6}M` : `${count / 1e3}k`);
const millions = (value) => (value === undefined ? '–' : (value / 1e6).toFixed(2));

const SOLVERS = {
  ours: 'morse-smooth',
  'ours-single': 'morse-smooth, single precision',
  faer: 'faer, same order',
  'faer-simd': 'faer with SIMD asked for, same order',
  'faer-amd': 'faer, its own AMD',
  csc: 'nalgebra-sparse, same order',
  cholmod: 'CHOLMOD with METIS, native',
};

/** Times in seconds of the stages on one mesh. */
export function printSpeed({ samples, facts }, systems) {
  const rows = [['seconds', 'order', 'analyse', 'numeric', 'again', 'solve 1', 'solve 8', 'entries, M']];
  for (const system of systems) {
    rows.push([`${system}: ${facts[`${system}/unknowns`]} unknowns`, '', '', '', '', '', '', '']);
    for (const [solver, name] of Object.entries(SOLVERS)) {
      const time = (stage) => number(median(samples[`${system}/${solver}/${stage}`]));
      const nonzeros = facts[`${system}/${solver}/nonzeros`];
      if (samples[`${system}/${solver}/factor`]) {
        const stages = ['order', 'analyse', 'factor', 'refactor', 'solve1', 'solve8'].map(time);
        rows.push([`  ${name}`, ...stages, millions(nonzeros)]);
      }
    }
  }
  printTable(rows);
}

export function printCalls({ samples }) {
  const rows = [
    ['seconds', 'first round', 'first call', 'CHOLMOD', 'next ε', 'CHOLMOD', `${CHANNELS} channels`, '÷ one'],
  ];
  for (const { system, name, next } of EQUATIONS) {
    const time = (kind) => median(samples[`${system}/${kind}`]);
    const again = next ? [number(time('next')), number(time('cholmod-next'))] : ['', ''];
    const several = [number(time('channels')), number(time('channels') / time('first'))];
    const first = [samples[`${system}/first`][0], time('first'), time('cholmod-first')].map((value) => number(value));
    rows.push([name, ...first, ...again, ...several]);
  }
  printTable(rows);
}

export function printAccuracy({ rows: measured }) {
  const head = ['relative error after refinement steps', '0', '1', '2', '3', '4', 'at the stop'];
  const rows = measured
    .filter(({ errors }) => errors)
    .map(({ route, metric, epsilon, bits, errors, steps, refined }) => {
      const precision = bits === 64 ? 'double' : 'single';
      const stop = steps === undefined ? '' : `${refined.toExponential(1)} (${steps})`;
      const name = `${route}, ${metric}, ε = ${epsilon}, ${precision}`;
      return [name, ...errors.map((error) => error.toExponential(1)), stop];
    });
  printTable([head, ...rows]);
}

/** `runs`: by size, system and precision. */
export function printMemory(runs) {
  const rows = [['fresh instance', 'order', 'analyse', 'numeric', 'solve 1', 'entries, M', 'before, MB', 'peak, MB']];
  for (const { vertices, system, bits, result } of runs) {
    const name = `${size(vertices)} ${system} ${bits === 64 ? 'double' : 'single'}`;
    const { samples, facts } = result;
    if (!samples) rows.push([`${name}: ${result.failure}`, '', '', '', '', '', '', '']);
    else {
      const times = ['order', 'analyse', 'factor', 'solve1'].map((stage) => number(median(samples[stage])));
      const megabytes = [facts.before, facts.peak].map((bytes) => (bytes / 1e6).toFixed(0));
      rows.push([name, ...times, millions(facts.nonzeros), ...megabytes]);
    }
  }
  printTable(rows);
}
