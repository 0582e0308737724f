// The panel "Reading the field" and what hangs on it: counts against δ, the persistence diagram, simplification, the Morse
// complex, basins and bands. Numbers are compared with what the package says of the same file in Node.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';
import { meshOfFile } from '../js/mesh-of-file.js';
import { startBrowser } from './driver.js';

const TORUS = readFileSync(fileURLToPath(new URL('../../www/public/examples/torus_irregular.ply', import.meta.url)));
/** How far the diagram goes beyond the range of the field: left and below, right, above. */
const MARGINS = { low: 0.05, right: 0.04, top: 0.16 };

let browser;
let page;
let mesh;
let noisy;
let pairs;
let range;

beforeAll(async () => {
  browser = await startBrowser();
  const file = meshOfFile(TORUS);
  mesh = file.mesh;
  noisy = file.fields.noisy;
  pairs = mesh.persistence(noisy);
  range = [noisy.reduce((a, b) => Math.min(a, b)), noisy.reduce((a, b) => Math.max(a, b))];
});
afterAll(async () => {
  mesh?.free();
  await browser?.close();
});
afterEach(async () => {
  const complaints = page?.complaints ?? [];
  await page?.close();
  page = null;
  expect(complaints, 'errors in the console').toEqual([]);
});

async function openTorus(options) {
  page = await browser.open({ example: 'torus', ...options });
  expect(await page.settled()).toBe('ready');
}

/** Types a number, as a person does. */
const type = (id, number) =>
  page.after(async () => {
    await page.at(id).fill(String(number));
    await page.at(id).press('Tab');
  });

const simplify = () => page.after(() => page.at('method').selectOption('simplify'));

function countsOf(values, options) {
  const { minima, maxima, saddles } = mesh.criticalPoints(values, options).counts;
  return [minima, maxima, saddles];
}

/** The extrema that a relative threshold keeps. */
function kept(threshold) {
  const isAbove = (k) => pairs.persistence[k] > threshold * (range[1] - range[0]);
  const above = [...pairs.kinds].filter((_, k) => isAbove(k));
  const of = (kind, essential) => above.filter((other) => other === kind).length + essential.length;
  return [of(-1, pairs.essentialMinima), of(1, pairs.essentialMaxima)];
}

/** The plotting area of a plot, in pixels of the page. */
const area = (id) => page.at(id).locator('.u-over').boundingBox();

/** Where the dot of a pair is in the diagram, whose plotting area is given. */
function dot(pair, { x, y, width, height }) {
  const span = range[1] - range[0];
  const share = (value) => (value - range[0]) / span + MARGINS.low;
  return {
    x: x + (width * share(pairs.birth[pair])) / (1 + MARGINS.low + MARGINS.right),
    y: y + height - (height * share(pairs.death[pair])) / (1 + MARGINS.low + MARGINS.top),
  };
}

/** The most persistent pair whose dot stands by itself. */
async function lonelyPair() {
  const plot = await area('diagram');
  const dots = Array.from({ length: 300 }, (_, pair) => dot(pair, plot));
  const pair = dots.findIndex(({ x, y }, k) =>
    dots.every((other, j) => j === k || Math.hypot(other.x - x, other.y - y) > 4),
  );
  return { pair, ...dots[pair] };
}

describe('counts against δ', () => {
  test('are those of the readout, and those of the field', async () => {
    await openTorus();
    for (const delta of [0, 0.004, 0.05, 0.1371, 0.3]) {
      if (delta > 0) await type('delta-number', delta);
      const counts = countsOf(noisy, { delta });
      expect(await page.counts('before'), `δ = ${delta}`).toEqual(counts);
      const said = (await page.text('curve-values'))
        .replaceAll(',', '')
        .match(/: (\d+)\D.* (\d+) → \d+ maxima (\d+) → /);
      expect(said?.slice(1).map(Number), `δ = ${delta}`).toEqual(counts);
    }
  });

  test('the readout of the other reading of links', async () => {
    await openTorus();
    await type('delta-number', 0.05);
    await page.after(() => page.at('link').selectOption('skip'));
    expect(await page.counts('before')).toEqual(countsOf(noisy, { delta: 0.05, link: 'skip' }));
    expect(await page.counts('before')).not.toEqual(countsOf(noisy, { delta: 0.05 }));
  });

  test('a click and a drag on the curve move the slider', async () => {
    await openTorus();
    const { x, y, width, height } = await area('curve');
    const end = Number(await page.at('delta').getAttribute('max'));
    const { mouse } = page.page;
    await page.after(() => mouse.click(x + 0.4 * width, y + 0.5 * height));
    expect(Number(await page.at('delta').inputValue())).toBeCloseTo(0.4 * end, 1);
    const clicked = Number(await page.at('delta-number').inputValue());
    expect(clicked).toBeCloseTo(0.4 * end, 2);
    expect(await page.counts('before')).toEqual(countsOf(noisy, { delta: clicked }));
    await mouse.down();
    await page.after(() => mouse.move(x + 0.1 * width, y + 0.5 * height, { steps: 4 }));
    await mouse.up();
    const dragged = Number(await page.at('delta-number').inputValue());
    expect(dragged).toBeCloseTo(0.1 * end, 2);
    expect(await page.counts('before')).toEqual(countsOf(noisy, { delta: dragged }));
  });

  test('pointing at the curve says its values and moves nothing', async () => {
    await openTorus();
    const text = await page.text('curve-values');
    const { x, y, width, height } = await area('curve');
    await page.page.mouse.move(x + 0.5 * width, y + 0.5 * height);
    expect(await page.text('curve-values')).not.toBe(text);
    expect(await page.at('delta-number').inputValue()).toBe('0');
    await page.page.mouse.move(5, 5);
    expect(await page.text('curve-values')).toBe(text);
  });
});

describe('persistence diagram', () => {
  test('pointing at a dot lights its pair on both surfaces', async () => {
    await openTorus();
    const dark = await Promise.all(['before', 'after'].map((side) => page.picture(side)));
    const { pair, x, y } = await lonelyPair();
    await page.after(() => page.page.mouse.move(x, y));
    const [extremum, saddle] = [pairs.extrema[pair], pairs.saddles[pair]];
    expect(await page.text('pair-values')).toMatch(new RegExp(`^M\\w+mum ${extremum} .* saddle ${saddle} .* kept$`));
    for (const [k, side] of ['before', 'after'].entries()) {
      expect(await page.at(side).getAttribute('data-lit')).toBe(`${extremum} ${saddle}`);
      expect(Number(await page.at(side).getAttribute('data-path'))).toBeGreaterThan(0);
      expect((await page.picture(side)).equals(dark[k])).toBe(false);
    }
    await page.page.mouse.move(5, 5);
    for (const [k, side] of ['before', 'after'].entries()) {
      expect(await page.at(side).getAttribute('data-lit')).toBe(null);
      expect((await page.picture(side)).equals(dark[k])).toBe(true);
    }
  });

  test('clicking a dot drops its pair from the simplified field, and a button takes that back', async () => {
    await openTorus();
    await simplify();
    const all = await page.counts('after');
    const { pair, x, y } = await lonelyPair();
    await page.after(() => page.page.mouse.click(x, y));
    expect(await page.text('pair-values')).toMatch(/dropped by you$/);
    const one = [pairs.kinds[pair] < 0 ? 1 : 0, pairs.kinds[pair] > 0 ? 1 : 0, 1];
    expect(await page.counts('after')).toEqual(all.map((count, k) => count - one[k]));
    expect(await page.at('reset-pairs').isEnabled()).toBe(true);
    await page.after(() => page.at('reset-pairs').click());
    expect(await page.counts('after')).toEqual(all);
    expect(await page.at('reset-pairs').isEnabled()).toBe(false);
  });

  test('a threshold keeps what lies above it', async () => {
    await openTorus();
    await simplify();
    for (const threshold of [0.02, 0.15, 0.4, 1]) {
      await type('persistence-number', threshold);
      const [minima, maxima] = kept(threshold);
      expect(await page.counts('after'), `${threshold}`).toEqual([minima, maxima, minima + maxima]);
      expect(await page.text('pair-values')).toMatch(new RegExp(`^Keeps ${minima} minim\\w+ and ${maxima} maxim`));
      expect(Number(await page.at('persistence').inputValue())).toBeCloseTo(Math.sqrt(threshold), 2);
    }
  });

  test('the line can be dragged', async () => {
    await openTorus();
    await simplify();
    await type('persistence-number', 0.3);
    const { x, y, width, height } = await area('diagram');
    // In the middle of the line, above all dots.
    const middle = { x: x + 0.5 * width, y: 0 };
    const birth = 0.5 * (1 + MARGINS.low + MARGINS.right) - MARGINS.low;
    const at = (threshold) =>
      y + height - (height * (birth + threshold + MARGINS.low)) / (1 + MARGINS.low + MARGINS.top);
    await page.page.mouse.move(middle.x, at(0.3));
    await page.page.mouse.down();
    await page.after(() => page.page.mouse.move(middle.x, at(0.2), { steps: 3 }));
    await page.page.mouse.up();
    const threshold = Number(await page.at('persistence-number').inputValue());
    expect(threshold).toBeCloseTo(0.2, 1);
    expect((await page.counts('after')).slice(0, 2)).toEqual(kept(threshold));
  });

  test('works with the keyboard alone', async () => {
    await openTorus();
    await simplify();
    const all = await page.counts('after');
    await page.at('diagram').focus();
    const { keyboard } = page.page;
    const named = async () => Number((await page.text('pair-values')).match(/^M\w+ (\d+)/)?.[1]);
    await page.after(() => keyboard.press('ArrowRight'));
    expect(await named()).toBe(pairs.extrema[0]);
    await keyboard.press('ArrowRight');
    expect(await named()).toBe(pairs.extrema[1]);
    await keyboard.press('ArrowLeft');
    expect(await named()).toBe(pairs.extrema[0]);
    expect(await page.at('before').getAttribute('data-lit')).toBe(`${pairs.extrema[0]} ${pairs.saddles[0]}`);
    await page.after(() => keyboard.press('Enter'));
    expect(await page.counts('after')).not.toEqual(all);
    await page.after(() => keyboard.press('Enter'));
    expect(await page.counts('after')).toEqual(all);
    await keyboard.press('Escape');
    expect(await page.at('before').getAttribute('data-lit')).toBe(null);
  });

  test('decisions are about one field', async () => {
    await openTorus();
    const { x, y } = await lonelyPair();
    await page.after(() => page.page.mouse.click(x, y));
    expect(await page.at('reset-pairs').isEnabled()).toBe(true);
    await page.after(() => page.at('field').selectOption({ label: 'clean' }));
    expect(await page.at('reset-pairs').isEnabled()).toBe(false);
    expect(await page.text('pair-values')).toBe('Keeps 1 minimum and 1 maximum, drops 0 pairs');
  });
});

describe('simplifying', () => {
  test('says what it did, without what only smoothing has', async () => {
    await openTorus();
    expect(await page.at('read-pairs').count()).toBe(0);
    await simplify();
    const dropped = pairs.extrema.length - (kept(0.1)[0] + kept(0.1)[1] - 2);
    expect((await page.text('read-pairs')).replaceAll(',', '')).toBe(String(dropped));
    expect(parseFloat(await page.text('read-linf'))).toBeGreaterThan(0);
    expect(parseFloat(await page.text('read-linf'))).toBeLessThanOrEqual(10);
    for (const id of ['read-residual', 'read-solver']) expect(await page.at(id).count()).toBe(0);
    for (const id of ['epsilon', 'epsilon-number', 'metric']) expect(await page.at(id).isVisible()).toBe(false);
    await page.after(() => page.at('method').selectOption('tikhonov'));
    expect(await page.text('read-residual')).toMatch(/e−/);
    expect(await page.at('epsilon').isVisible()).toBe(true);
  });

  test('the simplified field is saved under its own name', async () => {
    await openTorus();
    await simplify();
    expect(await page.text('save')).toContain('simplified');
    const [download] = await Promise.all([page.page.waitForEvent('download'), page.at('save').click()]);
    expect(download.suggestedFilename()).toBe('torus_irregular_simplified.ply');
    const saved = meshOfFile(readFileSync(await download.path()));
    saved.mesh.free();
    expect(countsOf(saved.fields.noisy_simplified)).toEqual(await page.counts('after'));
  });
});

describe('where some extrema cannot be avoided', () => {
  // Two octahedra that share a vertex: the small one must have a minimum or a maximum of its own.
  const octahedron = ([x, y, z], r, ids) => ({
    corners: [
      [x + r, y, z],
      [x - r, y, z],
      [x, y + r, z],
      [x, y - r, z],
      [x, y, z - r],
    ],
    faces: [
      [0, 2, 5],
      [2, 1, 5],
      [1, 3, 5],
      [3, 0, 5],
      [2, 0, 4],
      [1, 2, 4],
      [3, 1, 4],
      [0, 3, 4],
    ].map((face) => face.map((k) => ids[k])),
  });
  const upper = octahedron([0, 0, 1], 1, [1, 2, 3, 4, 0, 5]);
  const lower = octahedron([0, 0, -3], 3, [6, 7, 8, 9, 10, 0]);
  const points = [[0, 0, 0], ...upper.corners.slice(0, 4), [0, 0, 2], ...lower.corners];
  const lines = ['OFF', `${points.length} 16 0`, ...points.map((point) => point.join(' '))];
  const off = [...lines, ...[...upper.faces, ...lower.faces].map((face) => `3 ${face.join(' ')}`), ''].join('\n');

  test('the page removes the others and says so', async () => {
    await openTorus();
    expect(await page.after(() => page.drop('two.off', Buffer.from(off)))).toBe('ready');
    expect(await page.text('facts')).toMatch(/11 vertices.*16 triangles/);
    expect(await simplify()).toBe('ready');
    await page.at('tab-report').click();
    expect(await page.at('read-unavoidable').count()).toBe(0);
    await page.at('tab-plots').click();
    expect(await type('persistence-number', 0.5)).toBe('ready');
    const { mesh } = meshOfFile(Buffer.from(off), { format: 'off' });
    const values = mesh.positions().filter((_, k) => k % 3 === 0);
    const { values: simple, unavoidable } = mesh.simplify(values, { threshold: 0.5 });
    expect(unavoidable).toHaveLength(1);
    await page.at('tab-report').click();
    expect(await page.text('read-unavoidable')).toBe('1');
    const { minima, maxima, saddles } = mesh.criticalPoints(simple).counts;
    expect(await page.counts('after')).toEqual([minima, maxima, saddles]);
    mesh.free();
    expect(await page.at('notice').isVisible()).toBe(false);
  });
});

describe('on the surface', () => {
  for (const [what, on, off] of [
    ['the Morse complex', () => page.at('show-complex').check(), () => page.at('show-complex').uncheck()],
    ['basins of minima', () => colorBy('minima'), () => colorBy('value')],
    ['basins of maxima', () => colorBy('maxima'), () => colorBy('value')],
    ['levels at saddles', () => levelsAt('saddles'), () => levelsAt('even')],
  ]) {
    test(`${what} come and go`, async () => {
      await openTorus();
      const pictures = () => Promise.all(['before', 'after'].map((side) => page.picture(side)));
      const plain = await pictures();
      await page.after(on);
      const drawn = await pictures();
      await page.after(off);
      const again = await pictures();
      for (const k of [0, 1]) {
        expect(drawn[k].equals(plain[k])).toBe(false);
        expect(again[k].equals(plain[k])).toBe(true);
      }
    });
  }

  const colorBy = (value) => page.at('coloring').selectOption(value);
  const levelsAt = (value) => page.at('level-places').selectOption(value);

  test('the threshold decides which basins and separatrices there are', async () => {
    await openTorus();
    await page.after(() => page.at('coloring').selectOption('minima'));
    await page.after(() => page.at('show-complex').check());
    expect(await page.text('legend-what')).toMatch(new RegExp(`^${kept(0.1)[0]} → \\d+ basins of minima`));
    const picture = await page.picture('before');
    await type('persistence-number', 0.3);
    expect(await page.text('legend-what')).toMatch(new RegExp(`^${kept(0.3)[0]} → `));
    expect((await page.picture('before')).equals(picture)).toBe(false);
  });

  test('bands have one color between two levels', async () => {
    await openTorus();
    for (const id of ['show-glyphs', 'show-levels']) await page.at(id).uncheck();
    const smooth = await page.look('after');
    await page.after(() => page.at('show-bands').check());
    const banded = await page.look('after');
    expect(banded.colors).toBeLessThan(0.7 * smooth.colors);
    expect(banded.covered).toBeCloseTo(smooth.covered, 2);
  });
});

describe('on a phone', () => {
  test('everything is there, and nothing sticks out sideways', async () => {
    await openTorus({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    await simplify();
    await page.after(() => page.at('show-complex').check());
    await page.after(() => page.at('coloring').selectOption('minima'));
    expect(await page.overflow()).toEqual([]);
    expect(await page.page.evaluate(() => document.documentElement.scrollWidth)).toBe(390);
    for (const id of ['curve', 'diagram']) expect((await area(id)).width, id).toBeGreaterThan(250);
    await page.at('diagram').scrollIntoViewIfNeeded();
    const { x, y } = await lonelyPair();
    await page.page.touchscreen.tap(x, y);
    expect(await page.text('pair-values')).toMatch(/dropped by you$/);
  });
});
