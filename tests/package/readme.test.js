// The README shows the example that is there, and it runs.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';

const root = fileURLToPath(new URL('../..', import.meta.url));
const read = (...parts) => readFileSync(join(root, ...parts), 'utf8').replaceAll('\r\n', '\n');

it('shows twelve lines of JavaScript that run', () => {
  const example = read('examples', 'smooth.mjs');
  const blocks = [...read('README.md').matchAll(/^```js\n([^]*?)^```/gm)].map((match) => match[1]);
  expect(blocks).toEqual([example]);
  expect(example.trimEnd().split('\n')).toHaveLength(12);

  const output = execFileSync(process.execPath, [join('examples', 'smooth.mjs')], { cwd: root, encoding: 'utf8' });
  expect(output).toMatch(/^minima 571 → 2, maxima 574 → 1\n/);
});
