// Fields with prescribed extrema beside smoothed ones: time, memory, what exactness costs. `--help` lists the options.
import { parseArgs } from 'node:util';
import { Problem, heading, main, say, step } from '../scripts/lib/log.mjs';
import { inChild } from './lib/child.mjs';
import { median } from './lib/clock.mjs';
import { oneOf, readSize } from './lib/options.mjs';
import { SETS } from './lib/prescribe.mjs';
import { number, printTable, size as label } from './lib/table.mjs';

const USAGE = `node benches/prescribe.mjs, or npm run bench -- prescribe, with
  --size 10k,100k    numbers of vertices (default 10k,30k,100k; k and M are understood)
  --set smoothed     of ${Object.keys(SETS).join(', ')} (default all)
  --rounds 3         calls of each kind that a median is taken of (default 3)
  --clock cpu        time of the processor instead of the wall's, for a machine that is busy
  --quick            3k vertices: whether all of this works`;

/** What a call may take of the first Tikhonov call's time, and of its memory. */
const TIMES = (size) => (size < 100_000 ? 8 : 10);
const TIMES_OF_PREVIEW = 1.3;
const MEMORY = 1.5;

await main(async () => {
  const { sizes, sets, rounds, clock } = readOptions(process.argv.slice(2));
  for (const size of sizes) {
    heading(
      `prescribed extrema, jittered torus, ${label(size)} vertices, time of the ${clock === 'cpu' ? 'processor' : 'wall'}`,
    );
    const columns = [];
    for (const set of sets) {
      const measure = async (what, only) => {
        const parameters = { size, set, clock, only, rounds: only ? 1 : rounds };
        const result = await step(`${set}: ${what}`, () => inChild('prescribe', parameters));
        if (result.failure) say(`  it failed: ${result.failure}`);
        return result;
      };
      const timed = await measure('times', undefined);
      if (timed.failure) continue;
      const before = await measure('memory of smoothing', 'tikhonov');
      const after = await measure('memory of the whole', 'prescribe');
      columns.push([set, timed, before.facts?.peak, after.facts?.peak]);
    }
    if (columns.length > 0) print(columns, size);
  }
});

function print(columns, size) {
  const lines = columns.map(([set, { samples, facts }, before, after]) => {
    const time = (name) => median(samples[name]);
    const { kept, rise, iterations, solves, gap, leastSlack, exact } = facts.prescribe;
    return [
      set,
      String(facts.epsilon),
      kept.join(' + '),
      number(1000 * time('tikhonov')),
      number(1000 * time('prescribe')),
      number(time('prescribe') / time('tikhonov')),
      number(1000 * time('preview')),
      number(time('preview') / time('tikhonov')),
      String(iterations),
      String(solves),
      `${(100 * rise).toPrecision(2)} %`,
      `${(100 * facts.preview.rise).toPrecision(2)} %`,
      gap.toExponential(1),
      leastSlack.toFixed(2),
      exact && facts.preview.kept.join() === kept.join() ? 'yes' : 'NO',
      (before / 1e6).toFixed(0),
      (after / 1e6).toFixed(0),
      number(after / before),
    ];
  });
  const names = [
    ['kept set', 'target'],
    ['ε', ''],
    ['minima + maxima', ''],
    ['first Tikhonov call, ms', ''],
    ['whole, ms', ''],
    ['whole ÷ Tikhonov', `≤ ${TIMES(size)}`],
    ['preview, ms', ''],
    ['preview ÷ Tikhonov', `≤ ${TIMES_OF_PREVIEW}`],
    ['iterations', ''],
    ['solves', ''],
    ['energy above Tikhonov', ''],
    ['– of the preview', ''],
    ['gap', '≤ 1e-4'],
    ['least slack', '≥ 0.9'],
    ['exact in single precision', 'yes'],
    ['peak memory after Tikhonov, MB', ''],
    ['peak memory after the whole, MB', ''],
    ['their quotient', `≤ ${MEMORY}`],
  ];
  printTable(names.map(([name, target], line) => [name, ...lines.map((column) => column[line]), target]));
}

function readOptions(parameters) {
  const text = { type: 'string' };
  const flag = { type: 'boolean' };
  const known = { size: text, set: text, rounds: text, clock: text, quick: flag, help: flag };
  let values;
  try {
    ({ values } = parseArgs({ args: parameters, options: known }));
  } catch (error) {
    throw new Problem(`${error.message}\n\n${USAGE}`);
  }
  if (values.help) throw new Problem(USAGE);
  const rounds = values.rounds ? Number(values.rounds) : 3;
  if (!(rounds >= 1)) throw new Problem(`--rounds ${values.rounds}: a count is expected`);
  return {
    sizes: values.size?.split(',').map(readSize) ?? (values.quick ? [3_000] : [10_000, 30_000, 100_000]),
    sets: oneOf('set', values.set, Object.keys(SETS)),
    rounds,
    clock: oneOf('clock', values.clock, ['wall', 'cpu'], ['wall'])[0],
  };
}
