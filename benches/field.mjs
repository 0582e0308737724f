// What is read off a field of a million vertices, beside sorting its values: ratios within one run, with what each is to stay below.
import { TriMesh } from '../dist/node.mjs';
import { inChild } from './lib/child.mjs';
import { noisyTorus } from './lib/noisy-torus.mjs';
import { ROWS } from './lib/reading.mjs';

const ROUNDS = 7;
const quick = process.argv.includes('--quick');
const size = quick ? [250, 160] : [1250, 800];

const time = (work) => {
  const since = performance.now();
  work();
  return performance.now() - since;
};
const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

const { positions, triangles, values } = noisyTorus(...size);
const mesh = new TriMesh(positions, triangles);
const count = mesh.vertexCount;
const { minima, saddles, maxima, indexSum } = mesh.criticalPoints(values).counts;
console.log(`${count} vertices; ${minima} minima, ${saddles} saddles, ${maxima} maxima, index sum ${indexSum}`);

// Taking turns, so that what else the machine does meets all alike.
const times = new Map([['sort', []], ...ROWS.map(({ name }) => [name, []])]);
for (let round = 0; round < ROUNDS; round++) {
  const copy = values.slice();
  times.get('sort').push(time(() => copy.sort()));
  for (const { name, run } of ROWS) times.get(name).push(time(() => run(mesh, values)));
}
mesh.free();
const sort = median(times.get('sort'));

const columns = [44, 8, 10, 10, 8, 10];
const line = (...cells) =>
  console.log(cells.map((cell, i) => (i ? String(cell).padStart(columns[i]) : cell.padEnd(columns[i]))).join(''));
line(`median of ${ROUNDS}`, 'ms', 'M/s', '÷ sort', 'target', 'B/vertex');
const bytesPerVertex = async (name) => {
  const { bytes, failure } = await inChild('reading', { name, size });
  if (failure) throw new Error(`${name}: ${failure}`);
  return (bytes / count).toFixed(0);
};
line('Float64Array.sort', sort.toFixed(0), (count / sort / 1000).toFixed(1));
line('the mesh alone', '', '', '', '', await bytesPerVertex('mesh'));
for (const { name, target } of ROWS) {
  const milliseconds = median(times.get(name));
  const ratio = (milliseconds / sort).toFixed(2);
  const rate = (count / milliseconds / 1000).toFixed(1);
  line(name, milliseconds.toFixed(0), rate, ratio, target ? `≤ ${target}` : '', await bytesPerVertex(name));
}
