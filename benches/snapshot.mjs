// A picture of 1200 × 900 pixels of a mesh of 100,000 triangles, in WebAssembly and natively, from arrays to the PNG file: times,
// and whether the bytes are equal.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { snapshot } from '../dist/snapshot-node.mjs';
import { noisyTorus } from './lib/noisy-torus.mjs';

const ROUNDS = 5;
const TARGET = 2000;
const quick = process.argv.includes('--quick');

const { positions, triangles, values: noisy } = noisyTorus(...(quick ? [100, 50] : [316, 158]));
const smooth = Float64Array.from(noisy, (_, v) => positions[3 * v] + 0.1 * positions[3 * v + 2]);
const fields = { smooth, noisy };

const folder = mkdtempSync(join(tmpdir(), 'morse-smooth-bench-'));
try {
  for (const [name, values] of Object.entries(fields)) {
    for (const [what, array] of Object.entries({ positions, triangles, values })) {
      writeFileSync(join(folder, `${name}.${what}`), new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    }
  }
  const command = ['bench', '--features', 'render', '--bench', 'snapshot', '--', folder, ...Object.keys(fields)];
  const native = execFileSync('cargo', command, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] });
  const nativeTimes = Object.fromEntries(
    native.trim().split('\n').map((line) => [line.split(' ')[0], line.split(' ').slice(1).map(Number)]), // prettier-ignore
  );
  console.log(`${triangles.length / 3} triangles, ${ROUNDS} rounds`);
  const columns = [10, 14, 14, 14, 10, 12, 12];
  const line = (...cells) =>
    console.log(cells.map((cell, i) => (i ? String(cell).padStart(columns[i]) : cell.padEnd(columns[i]))).join(''));
  line('field', 'wasm, first', 'wasm, median', 'native, median', 'ratio', 'kB', 'bytes');
  for (const [name, values] of Object.entries(fields)) {
    const times = [];
    let png;
    for (let round = 0; round < ROUNDS; round++) {
      const since = performance.now();
      png = snapshot(positions, triangles, values);
      times.push(performance.now() - since);
    }
    const median = (all) => [...all].sort((a, b) => a - b)[all.length >> 1];
    const equal = readFileSync(join(folder, `${name}.png`)).equals(png);
    const ratio = median(times) / median(nativeTimes[name]);
    line(
      name,
      `${times[0].toFixed(0)} ms`,
      `${median(times).toFixed(0)} ms`,
      `${median(nativeTimes[name]).toFixed(0)} ms`,
      ratio.toFixed(2),
      (png.length / 1000).toFixed(0),
      equal ? 'equal' : 'DIFFERENT',
    );
    if (!equal) process.exitCode = 1;
    if (times[0] > TARGET) console.log(`above the target of ${TARGET} ms`);
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}
