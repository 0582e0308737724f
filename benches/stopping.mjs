// How long one waits for the package's long calls to end after saying stop, and whether stopped calls lose memory.
import { inChild } from './lib/child.mjs';
import { CALLS } from './lib/stopping.mjs';
import { printTable } from './lib/table.mjs';

const quick = process.argv.includes('--quick');
const SIZES = quick ? [['40k', [250, 160]]] : [['100k', [400, 250]], ['1M', [1250, 800]]]; // prettier-ignore
/** Loss shows at any size, so 200 stopped calls run where they are short. */
const LOSS = { size: [125, 80], repeats: 200 };
/** What is to hold, in milliseconds. */
const MEDIAN = 50;
const WORST = 200;

const rows = [
  [
    'call',
    'whole, ms',
    'questions',
    `median, ms (≤ ${MEDIAN})`,
    `worst, ms (≤ ${WORST})`,
    'stopped',
    `lost in ${LOSS.repeats} stopped calls at 10k, bytes`,
  ],
];
for (const [index, [label, size]] of SIZES.entries()) {
  for (const [name] of CALLS) {
    console.error(`${label} ${name} …`);
    const result = await inChild('stopping', { name, size, stops: label === '1M' ? 3 : 20, repeats: 0 });
    if (result.failure) {
      rows.push([`${label} ${name}: ${result.failure}`, '', '', '', '', '', '']);
      continue;
    }
    const loss = index === 0 ? await inChild('stopping', { name, stops: 0, ...LOSS }) : undefined;
    const { total, questions, median, worst, stopped } = result;
    rows.push([
      `${label} ${name}`,
      total.toFixed(0),
      String(questions),
      median.toFixed(1),
      worst.toFixed(1),
      String(stopped),
      loss === undefined ? '' : String(loss.failure ?? loss.lost),
    ]);
  }
}
printTable(rows);
