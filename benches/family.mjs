// The smoothed fields for every ε beside single calls, and how well ε is chosen. `--help` lists the options.
import { parseArgs } from 'node:util';
import { Problem, heading, main, say, step } from '../scripts/lib/log.mjs';
import { inChild } from './lib/child.mjs';
import { median } from './lib/clock.mjs';
import { MESHES, RULES } from './lib/family-choice.mjs';
import { CALLS, SYSTEMS } from './lib/family.mjs';
import { oneOf, readSize } from './lib/options.mjs';
import { number, printTable, size as label } from './lib/table.mjs';

const PARTS = ['speed', 'choice'];
const USAGE = `node benches/family.mjs, or npm run bench -- family, with
  --size 10k,100k    numbers of vertices (default 10k,100k for speed, 3500,35k for choice; k and M are understood)
  --system mass      of ${Object.keys(SYSTEMS).join(', ')} (default all)
  --part speed       of ${PARTS.join(', ')} (default all)
  --rounds 3         families that a median is taken of (default 3; 1 above 100k)
  --clock cpu        time of the processor instead of the wall's, for a machine that is busy
  --quick            5k vertices: whether all of this works`;

/** Within this factor of the best ε's error, and this far from the truth, is near enough. */
const NEAR = 1.3;
const NOISE = 0.15;
/** In how many of the 30 cases on two meshes. */
const WANTED = { gcv: 24, lCurve: 18, discrepancy: 22 };

/** What the table of times tells, and the targets; `column` gives the figures in this order. */
const LINES = [
  ['one call with another ε, ms', ''],
  ['whole family, ms', ''],
  ['whole family ÷ call', '≤ 16'],
  ['factorisations', '≤ 14'],
  ['dimension', ''],
  ['estimated error', '≤ 1e-6'],
  ['largest true error at 9 ε', '≤ 1e-6'],
  ['of these, with the same counts', '9'],
  ['one factorisation ÷ call', '≤ 3'],
  ['its largest error over 3 decades', '≤ 1e-2'],
  ['its estimated error there', ''],
  ['values, ms', '≤ 16'],
  ['values and critical points, ms', '≤ 30'],
  ['at, ms', ''],
  ['sweep of 200 ε, ms', '≤ 1000'],
  ['choose gcv, ms', ''],
  ['choose lCurve, ms', ''],
  ['choose discrepancy, ms', ''],
  ['choose atMostCriticalPoints, ms', ''],
  ['peak memory after a call, MB', ''],
  ['peak memory after a family, MB', ''],
];

await main(async () => {
  const options = readOptions(process.argv.slice(2));
  if (options.parts.includes('speed')) for (const size of options.speedSizes) await speed(size, options);
  if (options.parts.includes('choice')) for (const size of options.choiceSizes) await choice(size);
});

function readOptions(parameters) {
  const text = { type: 'string' };
  const flag = { type: 'boolean' };
  const known = { size: text, system: text, part: text, rounds: text, clock: text, quick: flag, help: flag };
  let values;
  try {
    ({ values } = parseArgs({ args: parameters, options: known }));
  } catch (error) {
    throw new Problem(`${error.message}\n\n${USAGE}`);
  }
  if (values.help) throw new Problem(USAGE);
  const sizes = values.size?.split(',').map(readSize) ?? (values.quick ? [5_000] : null);
  const rounds = values.rounds ? Number(values.rounds) : null;
  if (rounds !== null && !(rounds >= 1 && rounds <= CALLS))
    throw new Problem(`--rounds ${values.rounds}: 1 to ${CALLS} is expected`);
  return {
    speedSizes: sizes ?? [10_000, 100_000],
    choiceSizes: sizes ?? [3_500, 35_000],
    systems: oneOf('system', values.system, Object.keys(SYSTEMS)),
    parts: oneOf('part', values.part, PARTS),
    rounds: (size) => rounds ?? (size > 100_000 ? 1 : 3),
    clock: oneOf('clock', values.clock, ['wall', 'cpu'], ['wall'])[0],
  };
}

/** Measures in a child process, with a sentence if that fails. */
async function measure(what, task, parameters) {
  const result = await step(what, () => inChild(task, parameters));
  if (result.failure) say(`  it failed: ${result.failure}`);
  return result;
}

/** One column for each system. */
async function speed(size, { systems, rounds, clock }) {
  heading(`families, jittered torus, ${label(size)} vertices, time of the ${clock === 'cpu' ? 'processor' : 'wall'}`);
  const rows = [['', ...systems, 'target']];
  const columns = [];
  for (const system of systems) {
    const parameters = { system, size, clock, rounds: rounds(size) };
    const result = await measure(system, 'family', parameters);
    columns.push(result.failure ? [] : column(result));
  }
  LINES.forEach(([name, target], line) => rows.push([name, ...columns.map((found) => found[line] ?? '–'), target]));
  printTable(rows);
}

function column({ samples, facts }) {
  const time = (name) => median(samples[name]);
  const milliseconds = (name) => number(1000 * time(name));
  const worst = (errors) => Math.max(...errors.map(([, error]) => error)).toExponential(1);
  return [
    milliseconds('call'),
    milliseconds('family'),
    number(time('family') / time('call')),
    `${facts.factorizations}${facts.complete ? '' : ', incomplete'}`,
    String(facts.dimension),
    facts.errorEstimate.toExponential(1),
    worst(facts.errors),
    String(facts.errors.filter(([, , , equal]) => equal).length),
    number(time('first') / time('call')),
    worst(facts.firstErrors),
    facts.firstEstimate.toExponential(1),
    milliseconds('values'),
    number(1000 * facts.valuesAndPoints),
    milliseconds('at'),
    milliseconds('sweep'),
    ...[...RULES, 'atMostCriticalPoints'].map(milliseconds),
    ...[facts.peakOfCall, facts.peakOfFamily].map((bytes) => (bytes / 1e6).toFixed(0)),
  ];
}

async function choice(size) {
  heading(`rules beside the best ε, meshes of ${label(size)} vertices`);
  const rows = [['mesh, field, noise', ...RULES, 'noise ÷ truth', 'confidence']];
  const near = Object.fromEntries([...RULES, 'noise'].map((name) => [name, 0]));
  let count = 0;
  for (const kind of Object.keys(MESHES)) {
    const result = await measure(`the ${kind} mesh`, 'family-choice', { kind, size });
    for (const { field, sigma, quotients, noise, confidence } of result.rows ?? []) {
      const found = RULES.map((rule) => quotients[rule].toFixed(3));
      rows.push([`${kind}, ${field}, ${100 * sigma} %`, ...found, noise.toFixed(3), confidence]);
      for (const rule of RULES) near[rule] += quotients[rule] <= NEAR;
      near.noise += Math.abs(noise - 1) <= NOISE;
      count++;
    }
  }
  rows.push([`near enough, of ${count}`, ...RULES.map((rule) => String(near[rule])), String(near.noise), '']);
  rows.push(['target, of 30', ...RULES.map((rule) => `≥ ${WANTED[rule]}`), '30', '']);
  printTable(rows);
}
