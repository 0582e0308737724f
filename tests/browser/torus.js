// What the package says, in Node, of the torus that the page's tests open; and the page's report compared with it.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect } from 'vitest';
import { Smoother } from 'morse-smooth';
import { meshOfFile } from '../js/mesh-of-file.js';

const FILE = fileURLToPath(new URL('../../www/public/examples/torus_irregular.ply', import.meta.url));

/** What the page constrains at first. */
export const PERSISTENT = { from: 'persistence', threshold: 0.1 };

export function readTorus() {
  const { mesh, fields } = meshOfFile(readFileSync(FILE));
  const { noisy } = fields;
  const [positions, triangles] = [mesh.positions(), mesh.triangles()];
  const sides = Array.from(triangles, (a, k) => {
    const b = triangles[k % 3 === 2 ? k - 2 : k + 1];
    return Math.hypot(...[0, 1, 2].map((axis) => positions[3 * a + axis] - positions[3 * b + axis]));
  });
  return {
    mesh,
    noisy,
    range: noisy.reduce((a, b) => Math.max(a, b)) - noisy.reduce((a, b) => Math.min(a, b)),
    meanEdge: sides.reduce((a, b) => a + b) / sides.length,
    smoothed(method, options, smootherOptions) {
      const smoother = new Smoother(mesh, smootherOptions);
      try {
        return smoother[method](noisy, options);
      } finally {
        smoother.free();
      }
    },
  };
}

/** The first number of a text, as people write it. */
export const number = (text) => parseFloat(text.replaceAll(',', '').replaceAll('−', '-').replace('≤ ', ''));

export const countsOf = ({ minima, maxima, saddles }) => [minima, maxima, saddles];

/** The numbers of the report against those of the package, which have more digits. */
export async function expectReport(page, { report }) {
  for (const kind of ['minima', 'maxima', 'saddles'])
    for (const side of ['before', 'after'])
      expect(number(await page.text(`report-${kind}-${side}`)), `${kind} ${side}`).toBe(report[side][kind]);
  const shown = (text, value) => expect(number(text)).toBe(Number(value.toPrecision(Math.abs(value) < 1e-3 ? 2 : 3)));
  shown(await page.text('report-linf'), 100 * report.lInfinity);
  shown(await page.text('report-metric'), report.metricNorm);
  shown(await page.text('report-laplacian'), report.laplacianNorm);
  const [before, after] = (await page.text('report-sobolev')).split(' → ');
  shown(before, report.sobolevBefore);
  shown(after, report.sobolevAfter);
}
