// Fields with gaps on the page: grey where there is no value, everything else as on the part that has values, holes left or filled.
import { describe, expect, test } from 'vitest';
import { Smoother } from 'morse-smooth';
import { meshOfFile } from '../js/mesh-of-file.js';
import { openTorus, page, torus } from './opened.js';
import { countsOf } from './torus.js';

/** The torus' own field without values in a ball. */
function gappy() {
  const positions = torus.mesh.positions();
  const [cx, cy, cz] = positions;
  return torus.noisy.map((value, v) => {
    const [x, y, z] = positions.subarray(3 * v, 3 * v + 3);
    return Math.hypot(x - cx, y - cy, z - cz) < 0.5 ? NaN : value;
  });
}

/** As a file, with `nan` where there is no value. */
const textOf = (values) => Buffer.from(Array.from(values, (x) => (Number.isNaN(x) ? 'nan' : x)).join('\n'));

async function openGappy() {
  await openTorus();
  const values = gappy();
  expect(await page.after(() => page.drop('gaps.txt', textOf(values)))).toBe('ready');
  expect(await page.at('field').locator('option:checked').textContent()).toBe('gaps.txt');
  return values;
}

/** What part of a view is grey: no color of the map is. */
async function greyIn(side) {
  const picture = await page.picture(side);
  return page.page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let grey = 0;
    for (let k = 0; k < data.length; k += 4) {
      const [low, high] = [Math.min(...data.subarray(k, k + 3)), Math.max(...data.subarray(k, k + 3))];
      if (high - low < 3 && low > 100 && high < 235) grey += 4 / data.length;
    }
    return grey;
  }, picture.toString('base64'));
}

describe('gaps in a field', () => {
  test('are grey, and the counts are those of the part with values', async () => {
    await openTorus();
    const without = await greyIn('before');
    expect(await page.at('gaps').isVisible()).toBe(false);
    expect(await page.at('legend-gap').isVisible()).toBe(false);
    const values = gappy();
    expect(await page.after(() => page.drop('gaps.txt', textOf(values)))).toBe('ready');
    expect(await greyIn('before')).toBeGreaterThan(without + 0.004);
    expect(await page.at('legend-gap').isVisible()).toBe(true);

    const { mesh: part, vertices } = torus.mesh.withoutMissing(values);
    const known = Float64Array.from(vertices, (v) => values[v]);
    expect(await page.counts('before')).toEqual(countsOf(part.criticalPoints(known).counts));
    // Against the part's own Euler characteristic.
    expect(await page.text('before-euler')).toMatch(/= χ ✓$/);
    part.free();

    // Another field has none.
    await page.choose('field', 'file:noisy');
    expect(await page.at('legend-gap').isVisible()).toBe(false);
    expect(await page.at('gaps').isVisible()).toBe(false);
  });

  test('stay holes, or are filled smoothly, as the package does it', async () => {
    const values = await openGappy();
    expect(await page.at('gaps').isVisible()).toBe(true);
    const smoother = new Smoother(torus.mesh);
    const epsilon = Number(await page.at('epsilon-number').inputValue());
    for (const missing of ['omit', 'fill']) {
      if (missing === 'fill') expect(await page.choose('missing', 'fill')).toBe('ready');
      const { report } = smoother.tikhonov(values, { epsilon, missing });
      expect(await page.counts('after'), missing).toEqual(countsOf(report.after));
      expect(await page.text('after-euler'), missing).toMatch(/= χ ✓$/);
    }
    smoother.free();
    await page.choose('missing', 'omit');
    const holes = await greyIn('after');
    await page.choose('missing', 'fill');
    expect(await greyIn('after')).toBeLessThan(holes - 0.004);
  });

  test('are what every method and color works around', async () => {
    await openGappy();
    for (const method of ['interpolate', 'leastSquares']) {
      expect(await page.choose('method', method), method).toBe('ready');
      expect(await page.at('gaps').isVisible(), method).toBe(true);
      expect(await page.choose('missing', 'fill'), method).toBe('ready');
      expect(await page.choose('missing', 'omit'), method).toBe('ready');
    }
    for (const method of ['lowPass', 'bilateral', 'simplify']) {
      expect(await page.choose('method', method), method).toBe('ready');
      expect(await page.at('gaps').isVisible(), method).toBe(false);
      expect(await greyIn('after'), method).toBeGreaterThan(0.004);
    }
    for (const coloring of ['minima', 'maxima', 'difference']) {
      expect(await page.choose('coloring', coloring), coloring).toBe('ready');
      expect(await greyIn('after'), coloring).toBeGreaterThan(0.004);
    }
    await page.choose('coloring', 'value');
    expect(await page.after(() => page.at('show-complex').click())).toBe('ready');
  });

  test('come back as gaps in the files that are saved', async () => {
    const values = await openGappy();
    for (const missing of ['omit', 'fill']) {
      if (missing === 'fill') await page.choose('missing', 'fill');
      const [download] = await Promise.all([page.page.waitForEvent('download'), page.at('save').click()]);
      const chunks = [];
      for await (const chunk of await download.createReadStream()) chunks.push(chunk);
      const { mesh, fields } = meshOfFile(Buffer.concat(chunks));
      mesh.free();
      const [before, after] = Object.values(fields);
      expect(before).toEqual(values);
      expect(after.some(Number.isNaN), missing).toBe(missing === 'omit');
    }
    const [picture] = await Promise.all([page.page.waitForEvent('download'), page.at('save-picture').click()]);
    expect(picture.suggestedFilename()).toMatch(/\.png$/);
  });
});
