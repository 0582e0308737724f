// What people bring: tables with several columns, values on triangles, the formats that the page offers.
import { describe, expect, test } from 'vitest';
import { formats, writeMesh } from 'morse-smooth/files';
import { openTorus, page, torus } from './opened.js';

const options = () => page.at('field').locator('option').allTextContents();

describe('a table with several columns', () => {
  test('asks which is the field, and offers all', async () => {
    await openTorus();
    const before = await page.counts('before');
    const rows = Array.from(torus.noisy, (value, v) => `${v},${-value},${2 * value}`);
    const table = Buffer.from(['id,down,up', ...rows].join('\n'));
    expect(await page.after(() => page.drop('run.csv', table))).toBe('error');
    expect(await page.text('notice-code')).toBe('AmbiguousColumn');
    expect(await page.text('notice-message')).toMatch(/run\.csv.*run\.csv: id, run\.csv: down, run\.csv: up/);
    expect(await page.counts('before')).toEqual(before);
    expect(await options()).toEqual(expect.arrayContaining(['run.csv: id', 'run.csv: down', 'run.csv: up']));
    expect(await page.choose('field', { label: 'run.csv: down' })).toBe('ready');
    expect(await page.counts('before')).toEqual([before[1], before[0], before[2]]);
  });
});

describe('files', () => {
  test('with values on triangles have them on vertices', async () => {
    await openTorus();
    const positions = torus.mesh.positions();
    const triangles = torus.mesh.triangles();
    const points = Array.from({ length: positions.length / 3 }, (_, v) => positions.slice(3 * v, 3 * v + 3).join(' '));
    const cells = Array.from(
      { length: triangles.length / 3 },
      (_, t) => `3 ${triangles.slice(3 * t, 3 * t + 3).join(' ')}`,
    );
    const height = cells.map((_, t) => positions[3 * triangles[3 * t] + 2]);
    const vtk = [
      '# vtk DataFile Version 3.0\ntorus\nASCII\nDATASET POLYDATA',
      `POINTS ${points.length} double`,
      ...points,
      `POLYGONS ${cells.length} ${4 * cells.length}`,
      ...cells,
      `CELL_DATA ${cells.length}\nSCALARS height double 1\nLOOKUP_TABLE default`,
      ...height,
    ];
    expect(await page.after(() => page.drop('cells.vtk', Buffer.from(vtk.join('\n'))))).toBe('ready');
    expect(await page.at('field').locator('option:checked').textContent()).toBe('height');
    expect(await page.text('facts')).toContain('4,301 vertices');
  });

  test('of every format that can be read are offered, and open', async () => {
    await openTorus();
    const offered = await Promise.all(['open-mesh', 'open-field'].map((id) => page.at(id).getAttribute('accept')));
    for (const { extensions, reads } of formats()) {
      for (const extension of reads ? extensions : []) expect(offered.join().split(',')).toContain(`.${extension}`);
    }
    const mesh = { positions: torus.mesh.positions(), triangles: torus.mesh.triangles() };
    for (const format of ['stl', 'vtp', 'glb']) {
      expect(await page.after(() => page.drop(`torus.${format}`, writeMesh(mesh, { format }))), format).toBe('ready');
      expect(await page.text('facts'), format).toContain('4,301 vertices');
    }
  });
});
