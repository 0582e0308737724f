// The README shows the examples that are there, and they run; so does the other one.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';

const root = fileURLToPath(new URL('../..', import.meta.url));
const run = (name) => execFileSync(process.execPath, [join('examples', name)], { cwd: root, encoding: 'utf8' });
const read = (...parts) => readFileSync(join(root, ...parts), 'utf8').replaceAll('\r\n', '\n');

it('shows twelve lines of JavaScript that run', () => {
  const example = read('examples', 'smooth.mjs');
  const blocks = [...read('README.md').matchAll(/^```js\n([^]*?)^```/gm)].map((match) => match[1]);
  expect(blocks[0]).toBe(example);
  // The rest are parts of the other one.
  for (const block of blocks.slice(1)) expect(read('examples', 'constraints.mjs')).toContain(block);
  expect(example.trimEnd().split('\n')).toHaveLength(12);

  expect(run('smooth.mjs')).toMatch(/^minima 571 → 2, maxima 574 → 1\n/);
});

it('simplifies a torus with noise to that of the textbook', () => {
  const lines = run('simplify.mjs').trimEnd().split('\n');
  expect(lines[0]).toBe('571 minima, 574 maxima, 1145 saddles');
  expect(lines[2]).toBe('1 minimum, 1 maximum, 2 saddles');
  expect(lines.at(-1)).toBe('8 lines of the Morse complex');
});

it('keeps the critical points that are constrained', () => {
  expect(run('constraints.mjs').trimEnd().split('\n')).toEqual([
    'kept 4 of 4 critical points',
    'extrema elsewhere: 0',
    'fixed at 28 vertices: true',
    'interpolated: 571, 574, 1145 → 3, 5, 8, changed by at most 30.8 %',
    'pulled: 571, 574, 1145 → 2, 1, 3, changed by at most 15.1 %',
  ]);
});
