// Exact extrema in the page: chosen in the persistence diagram, on the surface and in the table, previewed while the choice moves, and
// solved for when it rests. Results are compared with the persistence of the input and with what the package says of the same file.
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { openTorus, page, torus } from './opened.js';
import { countsOf, expectReport, number } from './torus.js';
import { meshOfFile } from '../js/mesh-of-file.js';

const THRESHOLD = 0.1;

/** The pairs of the input that the threshold keeps, by the extremum, and all that stays because it has no partner. */
function keptBy(threshold, except = []) {
  const { extrema, kinds, persistence, essentialMinima, essentialMaxima } = torus.mesh.persistence(torus.noisy);
  const of = (kind, essential) =>
    [...essential, ...extrema.filter((v, k) => kinds[k] === kind && persistence[k] > threshold * torus.range !== except.includes(v))].sort((a, b) => a - b); // prettier-ignore
  return { minima: of(-1, essentialMinima), maxima: of(1, essentialMaxima) };
}

/** On a torus there are as many saddles as extrema. */
const countsFor = ({ minima, maxima }) => [minima.length, maxima.length, minima.length + maxima.length];
const vertices = ({ minima, maxima }) => [...minima, ...maxima].sort((a, b) => a - b);

/** The extrema of the field that the page saves, by a classification. */
async function saved() {
  const [download] = await Promise.all([page.page.waitForEvent('download'), page.at('save').click()]);
  const { mesh, fields } = meshOfFile(readFileSync(await download.path()));
  const values = fields.noisy_exact;
  const { vertices, kinds, counts } = mesh.criticalPoints(values);
  const of = (kind) => [...vertices.filter((_, k) => kinds[k] === kind)].sort((a, b) => a - b);
  mesh.free();
  return { name: download.suggestedFilename(), values, counts, extrema: { minima: of(-1), maxima: of(1) } };
}

/** `glyphs`: whether critical points are drawn, thousands of which take most of the time. */
async function openExact({ glyphs = false, ...options } = {}) {
  await openTorus(options);
  await page.at('show-glyphs').setChecked(glyphs);
  expect(await page.choose('method', 'prescribe')).toBe('ready');
}

/** Notes whatever the page shows until `stop` gives it back: whether it was a preview, and the counts after. */
async function watch() {
  await page.page.evaluate(() => {
    window.seen = [];
    const note = () => {
      const counts = ['minima', 'maxima', 'saddles'].map((kind) =>
        Number(document.querySelector(`[data-testid="after-${kind}"]`).textContent.replaceAll(',', '')),
      );
      const isPreview = document.documentElement.hasAttribute('data-preview');
      window.seen.push({ isPreview, counts, status: document.getElementById('status').textContent });
    };
    window.watching = new MutationObserver(note);
    window.watching.observe(document.documentElement, { attributes: true, childList: true, subtree: true });
  });
  return () => page.page.evaluate(() => (window.watching.disconnect(), window.seen));
}

test('the method gives exactly as many extrema as the diagram keeps, and where', async () => {
  await openExact();
  const kept = keptBy(THRESHOLD);
  expect(await page.counts('after')).toEqual(countsFor(kept));
  expect(await page.text('pair-values')).toMatch(
    new RegExp(`^Keeps ${kept.minima.length} minima and ${kept.maxima.length} maxima`),
  );
  expect(await page.text('after-euler')).toMatch(/✓$/);
  expect(await page.ringed()).toEqual(vertices(kept));

  const result = torus.smoothed('prescribe', {
    epsilon: 0.1,
    extrema: { from: 'persistence', threshold: THRESHOLD, of: 'input' },
  });
  await expectReport(page, result);
  expect(await page.text('report-chosen')).toBe(
    `exactly the chosen ${kept.minima.length} minima and ${kept.maxima.length} maxima`,
  );
  const surplus = 100 * (result.energy / result.unconstrainedEnergy - 1);
  expect(surplus).toBeGreaterThan(0);
  for (const id of ['report-energy', 'read-energy'])
    expect(number(await page.text(id))).toBe(Number(surplus.toPrecision(3)));
  expect(await page.text('report-certificate')).toMatch(/proves that there are no other extrema$/);
  expect(number(await page.text('report-exact-iterations'))).toBe(result.iterations);

  const file = await saved();
  expect(file.name).toBe('torus_irregular_exact.ply');
  expect(file.extrema).toEqual(kept);
  const [picture] = await Promise.all([page.page.waitForEvent('download'), page.at('save-picture').click()]);
  expect([...readFileSync(await picture.path()).subarray(1, 4)]).toEqual([...Buffer.from('PNG')]);

  // None of that is there with other methods.
  await page.choose('method', 'tikhonov');
  expect(await page.ringed()).toEqual([]);
  expect(await page.at('read-energy').isVisible()).toBe(false);
  expect(await page.at('report-chosen').count()).toBe(0);
});

test('a threshold that moves is previewed, and solved for when it rests', async () => {
  await openExact();
  const report = await page.text('report-energy');
  const stop = await watch();
  await page.after(() => page.slide('persistence', [0.33, 0.36, 0.38, 0.4]));
  const seen = await stop();
  const kept = keptBy(0.16);
  const first = seen.findIndex(({ isPreview, counts }) => isPreview && counts.join() === countsFor(kept).join());
  expect(first).toBeGreaterThanOrEqual(0);
  expect(seen.some(({ status }) => status.startsWith('Preview'))).toBe(true);
  expect(seen.at(-1)).toMatchObject({ isPreview: false, counts: countsFor(kept) });
  expect(await page.text('report-energy')).not.toBe(report);
  await expectReport(
    page,
    torus.smoothed('prescribe', { epsilon: 0.1, extrema: { from: 'persistence', threshold: 0.16, of: 'input' } }),
  );
});

test('ε that moves is previewed with the same extrema', async () => {
  await openExact();
  const kept = countsFor(keptBy(THRESHOLD));
  const stop = await watch();
  await page.after(() => page.slide('epsilon', [0, 0.5, 1]));
  const seen = await stop();
  expect(seen.some(({ isPreview }) => isPreview)).toBe(true);
  for (const { isPreview, counts } of seen) if (isPreview) expect(counts).toEqual(kept);
  const extrema = { from: 'persistence', threshold: THRESHOLD, of: 'input' };
  await expectReport(page, torus.smoothed('prescribe', { epsilon: 10, extrema }));
});

test('a dot that is clicked changes the result by exactly that extremum', async () => {
  await openExact();
  const { extrema } = torus.mesh.persistence(torus.noisy);
  const kept = vertices(keptBy(THRESHOLD));
  // The most persistent pair is dropped, by keys as by the pointer.
  await page.at('diagram').focus();
  await page.page.keyboard.press('Home');
  await page.after(() => page.page.keyboard.press('Enter'));
  const without = keptBy(THRESHOLD, [extrema[0]]);
  expect(vertices(without)).toEqual(kept.filter((vertex) => vertex !== extrema[0]));
  expect(await page.counts('after')).toEqual(countsFor(without));
  expect(await page.ringed()).toEqual(vertices(without));
  expect((await saved()).extrema).toEqual(without);
  await page.after(() => page.at('reset-pairs').click());
  expect(await page.counts('after')).toEqual(countsFor(keptBy(THRESHOLD)));
});

test('the table and the surface choose, too', async () => {
  await openExact({ glyphs: true });
  const { extrema, essentialMinima } = torus.mesh.persistence(torus.noisy);
  const kept = vertices(keptBy(THRESHOLD));
  await page.at('tab-points').click();
  const label = (vertex) => page.page.getByLabel(`Constrain vertex ${vertex}`, { exact: true });
  await page.after(() => label(extrema[1]).click());
  expect(await page.ringed()).toEqual(kept.filter((vertex) => vertex !== extrema[1]));
  // What has no partner stays, which is said.
  await label(essentialMinima[0]).click();
  expect(await page.text('pair-values')).toBe(`Vertex ${essentialMinima[0]} has no partner, so it always stays.`);
  expect(await page.ringed()).toContain(essentialMinima[0]);

  // A click into the noise meets some critical point: its pair is kept from then on, or dropped.
  const before = await page.ringed();
  const { x, y, width, height } = await page.at('before-canvas').boundingBox();
  await page.after(() => page.page.mouse.click(x + 0.74 * width, y + 0.5 * height));
  const after = await page.ringed();
  expect(Math.abs(after.length - before.length)).toBe(1);
  const counts = await page.counts('after');
  expect(counts[0] + counts[1]).toBe(after.length);
  expect(vertices((await saved()).extrema)).toEqual(after);
});

test('values are kept to the last bit, and heights as asked for', async () => {
  await openExact();
  const kept = vertices(keptBy(THRESHOLD));
  const free = (await saved()).values;
  expect(kept.some((v) => free[v] !== torus.noisy[v])).toBe(true);
  await page.after(() => page.at('keep-values').check());
  const { values, extrema } = await saved();
  expect(vertices(extrema)).toEqual(kept);
  for (const v of kept) expect(values[v]).toBe(torus.noisy[v]);

  await page.after(() => page.at('keep-values').uncheck());
  await page.type('prominence', 8);
  const high = await saved();
  expect(vertices(high.extrema)).toEqual(kept);
  const { persistence } = torus.mesh.persistence(high.values);
  expect(Math.min(...persistence) / torus.range).toBeGreaterThan(0.08 - 1e-6);
});

test('extrema of the smoothed field are those that smoothing leaves', async () => {
  await openExact();
  await page.type('persistence-number', 0.01);
  await page.choose('exact-of', 'smoothed');
  const extrema = { from: 'persistence', threshold: 0.01 };
  const result = torus.smoothed('prescribe', { epsilon: 0.1, extrema });
  expect(await page.counts('after')).toEqual(countsOf(result.report.after));
  expect(await page.ringed()).toEqual(vertices(result));
  await expectReport(page, result);
  // Dots of the input are looked at only: their pairs are lit.
  const counts = await page.counts('after');
  await page.at('diagram').focus();
  await page.page.keyboard.press('Home');
  await page.page.keyboard.press('Enter');
  expect(await page.settled()).toBe('ready');
  expect(await page.counts('after')).toEqual(counts);
  expect(await page.at('reset-pairs').isDisabled()).toBe(true);
});

test('a contradictory choice is explained, and the page goes on with what it had', async () => {
  await openExact();
  await page.after(() => page.at('keep-values').check());
  const counts = await page.counts('after');
  const energy = await page.text('report-energy');
  expect(await page.type('prominence', 90)).toBe('error');
  expect(await page.text('notice-code')).toBe('Infeasible');
  expect(await page.text('notice-message')).toMatch(/no room .* from vertex \d+ up to vertex \d+.*Keep their values/);
  expect(await page.at('prominence').inputValue()).toBe('0');
  expect(await page.counts('after')).toEqual(counts);
  expect(await page.text('report-energy')).toBe(energy);
  expect(await page.page.evaluate(() => document.documentElement.hasAttribute('data-preview'))).toBe(false);
  expect(await page.after(() => page.at('keep-values').uncheck())).toBe('ready');
  expect(await page.at('notice').isVisible()).toBe(false);
});

test('finite elements have a wavelength, and every control fits into a narrow window', async () => {
  await openExact({ viewport: { width: 390, height: 844 } });
  expect(await page.overflow()).toEqual([]);
  await page.choose('metric', 'finiteElements');
  expect(await page.at('epsilon').isVisible()).toBe(false);
  expect(await page.at('wavelength').isVisible()).toBe(true);
  expect(await page.counts('after')).toEqual(countsFor(keptBy(THRESHOLD)));
  const extrema = { from: 'persistence', threshold: THRESHOLD, of: 'input' };
  const options = { cutoffWavelength: 10 * torus.meanEdge, extrema };
  const { report } = torus.smoothed('prescribe', options, { operator: 'fem' });
  expect(await page.counts('after')).toEqual(countsOf(report.after));
  expect(await page.overflow()).toEqual([]);
});

test('another mesh is opened with its own choice', async () => {
  await openExact();
  await page.at('diagram').focus();
  await page.page.keyboard.press('Home');
  await page.after(() => page.page.keyboard.press('Enter'));
  await page.choose('example', 'terrain');
  expect(await page.at('reset-pairs').isDisabled()).toBe(true);
  const [minima, maxima] = (await page.text('pair-values')).match(/\d+/g).map(Number);
  expect((await page.counts('after')).slice(0, 2)).toEqual([minima, maxima]);
});
