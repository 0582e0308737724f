// The README shows the examples that are there, and they run; so does the other one.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { meshOfFile } from '../js/mesh-of-file.js';

const root = fileURLToPath(new URL('../..', import.meta.url));
const run = (name, ...more) =>
  execFileSync(process.execPath, [join('examples', name), ...more], { cwd: root, encoding: 'utf8' });
const read = (...parts) => readFileSync(join(root, ...parts), 'utf8').replaceAll('\r\n', '\n');

let folder;
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'morse-smooth-examples-'));
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

it('shows ten lines of JavaScript that run', () => {
  const example = read('examples', 'smooth.mjs');
  const blocksOf = (...page) => [...read(...page).matchAll(/^```js\n([^]*?)^```/gm)].map((match) => match[1]);
  const [first, ...more] = blocksOf('README.md');
  expect(more).toEqual([example]);
  expect(read('examples', 'prescribe.mjs')).toContain(first);
  // The other pages show parts of other examples.
  const others = ['constraints', 'prescribe', 'sheet', 'worker', 'vtk', 'deck']
    .map((name) => read('examples', `${name}.mjs`))
    .concat(read('examples', 'three.html').replace(/^ {2}/gm, ''))
    .join('');
  const blocks = ['methods', 'pictures', 'files', 'loading', 'worker', 'viewers'].flatMap((page) =>
    blocksOf('docs', `${page}.md`),
  );
  expect(blocks.length).toBeGreaterThan(1);
  for (const block of blocks) expect(others).toContain(block);
  expect(example.trimEnd().split('\n')).toHaveLength(10);

  expect(run('smooth.mjs')).toMatch(/^minima 571 → 2, maxima 574 → 1, of \d+\n/);
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

it('smooths in a worker', () => {
  expect(run('worker.mjs').trimEnd().split('\n')).toEqual([
    'AbortError',
    'minima 571 → 2, maxima 574 → 1',
    'ε = 0.1: 4301 values',
  ]);
});

it('chooses an ε that is nearly the best', () => {
  const lines = run('choose-epsilon.mjs').trimEnd().split('\n');
  expect(lines).toHaveLength(17);
  expect(lines[0]).toMatch(/^Generalised cross-validation is least at ε = 0\.08\d*, /);
  expect(Number(/^error ([\d.]+) times/.exec(lines[1])[1])).toBeLessThan(1.05);
  expect(lines[2]).toBe('ε = 1e-6: 1 minima, 2 saddles, 1 maxima');
  expect(lines[12]).toMatch(/^ε = 1e\+4: 5\d\d minima, 11\d\d saddles, 5\d\d maxima$/);
  // The torus has these two whatever the ε.
  expect(lines.slice(13, 15).map((line) => line.split(',')[0]).sort()).toEqual(['maximum from ε = 1e-6 on', 'minimum from ε = 1e-6 on']); // prettier-ignore
});

it('prints the critical points of a file', () => {
  const lines = run('critical-points.mjs').trimEnd().split('\n');
  // The clean field of the torus is a height: the textbook's four points.
  expect(lines).toHaveLength(5);
  expect(lines.slice(0, 4).map((line) => line.split(' ')[0]).sort()).toEqual(['maximum', 'minimum', 'saddle', 'saddle']); // prettier-ignore
  expect(lines[4]).toBe('1 − 2 + 1 = 0: 0');
});

it('writes a field that has kept its persistent critical points', () => {
  const path = join(folder, 'kept.ply');
  const kept = /: kept (\d+) of (\d+) critical points\n/.exec(run('keep.mjs', path));
  expect(kept[1]).toBe(kept[2]);
  const { mesh, fields } = meshOfFile(readFileSync(path));
  const [before, after] = Object.values(fields);
  const rule = { from: 'persistence', threshold: 0.1, stars: false };
  const features = mesh.constrainedVertices(before, rule);
  expect(features).toHaveLength(Number(kept[2]));
  const kindsOf = (field) => {
    const { vertices, kinds } = mesh.criticalPoints(field);
    return new Map([...vertices].map((vertex, k) => [vertex, kinds[k]]));
  };
  const [was, is] = [kindsOf(before), kindsOf(after)];
  for (const v of features) {
    expect(after[v]).toBe(before[v]);
    expect(is.get(v)).toBe(was.get(v));
  }
  mesh.free();
});

it('prescribes the extrema of a terrain', () => {
  const path = join(folder, 'exact.png');
  const lines = run('prescribe.mjs', path).trimEnd().split('\n');
  expect(lines[0]).toBe('minima 570 → 5, maxima 529 → 8, saddles 1091 → 12');
  expect(Number(/^energy ([\d.]+) % above/.exec(lines[1])[1])).toBeLessThan(1);
  expect(readFileSync(path).equals(readFileSync(join(root, 'docs', 'exact.png')))).toBe(true);
});

it("draws the README's picture", () => {
  const path = join(folder, 'sheet.png');
  run('sheet.mjs', path);
  expect(readFileSync(path).equals(readFileSync(join(root, 'docs', 'sheet.png')))).toBe(true);
});
