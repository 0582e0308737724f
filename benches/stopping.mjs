// How long one waits for the package's long calls to end after saying stop, and whether stopped calls lose memory.
import { inChild } from './lib/child.mjs';
import { CALLS } from './lib/stopping.mjs';
import { printTable } from './lib/table.mjs';

const quick = process.argv.includes('--quick');
const SIZES = quick ? [['40k', [250, 160]]] : [['100k', [400, 250]], ['1M', [1250, 800]]]; // prettier-ignore
/** What is to hold, in milliseconds. */
const MEDIAN = 50;
const WORST = 200;

const rows = [
  ['call', 'whole, ms', 'questions', `median, ms (≤ ${MEDIAN})`, `worst, ms (≤ ${WORST})`, 'stopped', 'lost, bytes'],
];
for (const [label, size] of SIZES) {
  for (const [name] of CALLS) {
    const large = label === '1M';
    const result = await inChild('stopping', { name, size, stops: large ? 5 : 20, repeats: large ? 0 : 200 });
    if (result.failure) rows.push([`${label} ${name}: ${result.failure}`, '', '', '', '', '', '']);
    else {
      const { total, questions, median, worst, stopped, lost } = result;
      const lostBytes = large ? '' : String(lost);
      rows.push([
        `${label} ${name}`,
        total.toFixed(0),
        String(questions),
        median.toFixed(1),
        worst.toFixed(1),
        String(stopped),
        lostBytes,
      ]);
    }
  }
}
printTable(rows);
