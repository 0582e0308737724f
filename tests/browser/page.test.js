// The built page, driven in a real browser as a person would: what it shows on opening, what its controls and dropped files
// do, and what it says when something goes wrong.
import { mkdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';
import { meshOfFile } from '../js/mesh-of-file.js';
import { startBrowser } from './driver.js';

const inRoot = (path) => fileURLToPath(new URL(`../../${path}`, import.meta.url));
const example = (name) => readFileSync(inRoot(`www/public/examples/${name}`));

const TORUS_NOISY = [571, 574, 1145];
const GENUS22_NOISY = [1445, 1466, 2953];

let browser;
let page;

beforeAll(async () => {
  mkdirSync(inRoot('artifacts'), { recursive: true });
  browser = await startBrowser();
});
afterAll(() => browser?.close());
afterEach(async () => {
  const complaints = page?.complaints ?? [];
  await page?.close();
  page = null;
  expect(complaints, 'errors in the console').toEqual([]);
});

async function open(options) {
  page = await browser.open(options);
  return page.settled();
}

/** The small one of the examples: most tests need only some mesh. */
const openTorus = () => open({ example: 'torus' });

const sum = (counts) => counts.reduce((total, count) => total + count, 0);

describe('opening', () => {
  test('shows an example, classified and smoothed', async () => {
    expect(await open()).toBe('ready');
    expect(await page.counts('before')).toEqual(GENUS22_NOISY);
    const after = await page.counts('after');
    expect(sum(after)).toBeLessThan(0.05 * sum(GENUS22_NOISY));
    expect(after[0] + after[1] - after[2]).toBe(-42);
    for (const side of ['before', 'after']) {
      expect(await page.text(`${side}-euler`)).toBe('m + M − s = −42 = χ ✓');
    }
    expect(await page.text('facts')).toMatch(/11,610 vertices.*23,304 triangles.*χ = −42.*genus 22/);
    expect(await page.text('read-residual')).toMatch(/e−1\d$/);
    expect(await page.text('legend-ticks')).toMatch(/^−3\.65.*5\.52$/);
    await page.page.screenshot({ path: inRoot('artifacts/page.png') });
  });

  test('paints both views', async () => {
    await openTorus();
    for (const side of ['before', 'after']) {
      const { colors, covered } = await page.look(side);
      expect(colors).toBeGreaterThan(500);
      expect(covered).toBeGreaterThan(0.2);
    }
  });

  test('fits a phone', async () => {
    expect(await open({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true })).toBe('ready');
    expect(await page.overflow()).toEqual([]);
    for (const side of ['before', 'after']) expect((await page.look(side)).colors).toBeGreaterThan(500);
    await page.page.screenshot({ path: inRoot('artifacts/page-narrow.png'), fullPage: true });
  });

  test('fits a small laptop without scrolling', async () => {
    await open();
    expect(await page.overflow()).toEqual([]);
    expect(await page.page.evaluate(() => document.documentElement.scrollHeight <= innerHeight)).toBe(true);
    expect(await page.page.locator('aside').evaluate((aside) => aside.scrollHeight <= aside.clientHeight)).toBe(true);
  });

  test('nothing is cut off at any width', async () => {
    await openTorus();
    for (const width of [320, 500, 768, 920, 1000, 1100, 1280, 1600, 1920]) {
      await page.page.setViewportSize({ width, height: 800 });
      expect(await page.overflow(), `${width} wide`).toEqual([]);
    }
  });

  test('every example opens, and its indices sum to its Euler characteristic', async () => {
    await open();
    const ids = await page
      .at('example')
      .locator('option')
      .evaluateAll((options) => options.map(({ value }) => value));
    expect(ids.length).toBeGreaterThanOrEqual(5);
    for (const id of ids.toReversed()) {
      expect(await page.after(() => page.at('example').selectOption(id)), id).toBe('ready');
      for (const side of ['before', 'after']) expect(await page.text(`${side}-euler`), id).toMatch(/✓$/);
      expect(sum(await page.counts('after')), id).toBeLessThan(sum(await page.counts('before')));
    }
  });
});

describe('controls', () => {
  test('ε changes what is left after smoothing, and nothing before', async () => {
    await openTorus();
    const at = [];
    for (const [position, epsilon] of [
      [-4, '0.0001'],
      [0, '1'],
      [3, '1000'],
    ]) {
      await page.after(() => page.slide('epsilon', [position]));
      expect(await page.at('epsilon-number').inputValue()).toBe(epsilon);
      expect(await page.counts('before')).toEqual(TORUS_NOISY);
      at.push(sum(await page.counts('after')));
    }
    expect(at[0]).toBeLessThan(at[1]);
    expect(at[1]).toBeLessThan(at[2]);
  });

  test('while a slider is dragged only its latest position counts', async () => {
    await openTorus();
    const work = await page.page.evaluateHandle(() => {
      const seen = [];
      new MutationObserver(() => seen.push(document.querySelector('[data-testid="read-linf"]').textContent)).observe(
        document.querySelector('[data-testid="readout"]'),
        { subtree: true, childList: true, characterData: true },
      );
      return seen;
    });
    const drag = Array.from({ length: 150 }, (_, k) => -5 + 0.05 * k);
    await page.after(() => page.slide('epsilon', [...drag, 2]));
    const end = await page.counts('after');
    // The first position was already under way; all between it and the last were dropped.
    expect(new Set(await work.jsonValue()).size).toBeLessThanOrEqual(3);
    await page.after(() => page.slide('epsilon', [-1]));
    await page.after(() => page.slide('epsilon', [2]));
    expect(await page.counts('after')).toEqual(end);
  });

  test('δ recounts at once', async () => {
    await openTorus();
    await page.after(() => page.slide('delta', [0.05]));
    const some = await page.counts('before');
    expect(sum(some)).toBeLessThan(sum(TORUS_NOISY));
    expect(await page.text('before-euler')).toContain('checked at δ = 0');
    await page.after(() => page.at('link').selectOption('skip'));
    const skip = await page.counts('before');
    expect(skip.slice(0, 2)).toEqual(some.slice(0, 2));
    expect(skip[2]).toBeGreaterThanOrEqual(some[2]);
    await page.after(() => page.slide('delta', [0]));
    expect(await page.counts('before')).toEqual(TORUS_NOISY);
  });

  test('stopping ends the work and goes back to what was shown', async () => {
    await openTorus();
    const shown = await page.counts('after');
    await page.after(() =>
      page.page.evaluate(() => {
        const slider = document.getElementById('epsilon');
        slider.value = '-6';
        slider.dispatchEvent(new Event('input'));
        // It shows itself only when work takes long.
        document.getElementById('stop').click();
      }),
    );
    expect(await page.at('epsilon-number').inputValue()).toBe('0.1');
    expect(await page.counts('before')).toEqual(TORUS_NOISY);
    expect(await page.counts('after')).toEqual(shown);
    expect(await page.after(() => page.slide('epsilon', [2]))).toBe('ready');
    expect(sum(await page.counts('after'))).toBeGreaterThan(sum(shown));
  });

  test('the known result for the identity metric', async () => {
    await open();
    await page.after(() => page.at('metric').selectOption('identity'));
    expect(await page.counts('after')).toEqual([22, 14, 78]);
  });

  test('another field, and coordinates as fields', async () => {
    await openTorus();
    await page.after(() => page.at('field').selectOption({ label: 'clean' }));
    expect(await page.counts('before')).toEqual([1, 1, 2]);
    await page.after(() => page.at('field').selectOption({ label: 'z coordinate' }));
    const [minima, maxima, saddles] = await page.counts('before');
    expect(minima + maxima - saddles).toBe(0);
    expect(await page.text('before')).toContain('z coordinate');
  });

  test('glyphs, level sets and edges come and go', async () => {
    await openTorus();
    const all = await page.look('before');
    await page.at('show-glyphs').uncheck();
    await page.at('show-levels').uncheck();
    const bare = await page.look('before');
    expect(bare.colors).toBeLessThan(all.colors);
    await page.at('show-edges').check();
    expect((await page.look('before')).colors).not.toBe(bare.colors);
  });

  test('numbers typed in are kept within range', async () => {
    await openTorus();
    const box = page.at('epsilon-number');
    for (const [typed, kept] of [
      ['1e9', '10000'],
      ['-3', '0.000001'],
      ['', '0.1'],
      ['0.25', '0.25'],
    ]) {
      await page.after(async () => {
        await box.fill(typed);
        await box.press('Tab');
      });
      expect(Number(await box.inputValue())).toBe(Number(kept));
    }
  });

  test('the keyboard turns both views', async () => {
    await openTorus();
    const pictures = () => Promise.all(['before', 'after'].map((side) => page.at(`${side}-canvas`).screenshot()));
    const before = await pictures();
    await page.at('before-canvas').focus();
    for (let k = 0; k < 4; k++) await page.page.keyboard.press('ArrowLeft');
    await page.look('after');
    const turned = await pictures();
    for (const k of [0, 1]) expect(turned[k].equals(before[k])).toBe(false);
  });

  test('every control can be reached and has a name', async () => {
    await openTorus();
    const nameless = await page.page.locator('input, select, button').evaluateAll((controls) =>
      controls
        .filter((control) => !control.closest('[hidden]'))
        .filter((control) => !(control.labels?.length || control.ariaLabel || control.textContent.trim()))
        .map((control) => control.id),
    );
    expect(nameless).toEqual([]);
  });

  test('the smoothed field is saved as PLY', async () => {
    await openTorus();
    const [download] = await Promise.all([page.page.waitForEvent('download'), page.at('save').click()]);
    expect(download.suggestedFilename()).toBe('torus_irregular_tikhonov.ply');
    const { mesh, fields } = meshOfFile(readFileSync(await download.path()));
    expect(Object.keys(fields)).toEqual(['noisy', 'noisy_tikhonov']);
    const { minima, maxima, saddles } = mesh.criticalPoints(fields.noisy_tikhonov).counts;
    expect([minima, maxima, saddles]).toEqual(await page.counts('after'));
    mesh.free();
  });
});

describe('files', () => {
  test('a dropped mesh takes the place of the example', async () => {
    await open({ example: 'terrain' });
    expect(await page.after(() => page.drop('mine.ply', example('torus_irregular.ply')))).toBe('ready');
    expect(await page.counts('before')).toEqual([1, 1, 2]);
    expect(await page.at('example').locator('option:checked').textContent()).toBe('mine.ply');
    await page.after(() => page.at('field').selectOption({ label: 'noisy' }));
    expect(await page.counts('before')).toEqual(TORUS_NOISY);
  });

  test('the file picker does the same; a mesh without fields shows its coordinates', async () => {
    await openTorus();
    const octahedron =
      'OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n';
    const file = { name: 'octahedron.off', mimeType: 'text/plain', buffer: Buffer.from(octahedron) };
    expect(await page.after(() => page.at('open-mesh').setInputFiles(file))).toBe('ready');
    expect(await page.at('field').locator('option:checked').textContent()).toBe('x coordinate');
    expect(await page.text('facts')).toMatch(/6 vertices.*8 triangles/);
    expect((await page.look('before')).colors).toBeGreaterThan(100);
  });

  test('a dropped field is added to the mesh, one of the wrong length is refused with both numbers', async () => {
    await openTorus();
    const { mesh, fields } = meshOfFile(example('torus_irregular.ply'));
    mesh.free();
    const negated = Array.from(fields.noisy, (value) => -value).join('\n');
    expect(await page.after(() => page.drop('negated.txt', Buffer.from(negated)))).toBe('ready');
    expect(await page.at('field').locator('option:checked').textContent()).toBe('negated.txt');
    expect(await page.counts('before')).toEqual([574, 571, 1145]);

    expect(await page.after(() => page.drop('short.csv', Buffer.from('1\n2\n3\n')))).toBe('error');
    expect(await page.text('notice-code')).toBe('WrongRowCount');
    expect(await page.text('notice-message')).toMatch(/short\.csv.*\b3\b.*\b4301\b/);
    expect(await page.at('field').locator('option:checked').textContent()).toBe('negated.txt');
    expect(await page.counts('before')).toEqual([574, 571, 1145]);
  });

  test('a broken mesh is refused with its code, and the page goes on with what it had', async () => {
    await openTorus();
    const whole = example('genus22.ply');
    const broken = [
      ['truncated.ply', whole.subarray(0, 100_000), /^(Truncated|UnexpectedEnd)$/],
      [
        'noise.ply',
        Buffer.from(Array.from({ length: 500 }, (_, k) => (k * 97) % 256)),
        /^(UnknownFormat|InvalidSyntax)$/,
      ],
      ['empty.obj', Buffer.alloc(0), /^EmptyFile$/],
    ];
    for (const [name, bytes, code] of broken) {
      expect(await page.after(() => page.drop(name, bytes)), name).toBe('error');
      expect(await page.text('notice-code'), name).toMatch(code);
      expect((await page.text('notice-message')).length, name).toBeGreaterThan(10);
      expect(await page.at('example').inputValue(), name).toBe('torus');
      expect(await page.counts('before'), name).toEqual(TORUS_NOISY);
    }
    expect(await page.after(() => page.slide('epsilon', [1]))).toBe('ready');
    expect(await page.at('notice').isVisible()).toBe(false);
    expect(sum(await page.counts('after'))).toBeGreaterThan(0);
  });

  test('a mesh whose first field has an infinite value opens with its next one, and says why', async () => {
    await openTorus();
    const vertices = ['0 0 0 inf 1', '1 0 0 2 5', '0 1 0 3 2', '0 0 1 4 4'];
    const properties = ['float x', 'float y', 'float z', 'double endless', 'double whole'].map(
      (text) => `property ${text}`,
    );
    const faces = ['3 0 2 1', '3 0 1 3', '3 0 3 2', '3 1 2 3'];
    const header = ['ply', 'format ascii 1.0', 'element vertex 4', ...properties, 'element face 4'];
    const lines = [...header, 'property list uchar int vertex_indices', 'end_header', ...vertices, ...faces, ''];
    expect(await page.after(() => page.drop('endless.ply', Buffer.from(lines.join('\n'))))).toBe('error');
    expect(await page.text('notice-code')).toBe('NonFiniteValue');
    expect(await page.at('field').inputValue()).toBe('file:whole');
    expect(await page.counts('before')).toEqual([1, 1, 0]);
    expect(await page.counts('after')).toEqual([1, 1, 0]);
  });

  test('a field with an infinite value is refused, and the choice goes back', async () => {
    await openTorus();
    const endless = Array.from({ length: 4301 }, (_, k) => (k === 7 ? 'inf' : k)).join('\n');
    expect(await page.after(() => page.drop('endless.txt', Buffer.from(endless)))).toBe('error');
    expect(await page.text('notice-code')).toMatch(/NonFiniteValue|InvalidNumber/);
    expect(await page.at('field').locator('option:checked').textContent()).toBe('noisy');
  });
});

describe('where something is missing', () => {
  test('without WebGL 2 the numbers are there, and a sentence in place of the pictures', async () => {
    const prepare = (tab) =>
      tab.addInitScript(() => {
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
          return kind.startsWith('webgl') ? null : original.call(this, kind, ...more);
        };
      });
    expect(await open({ prepare })).toBe('ready');
    expect(await page.counts('before')).toEqual(GENUS22_NOISY);
    expect(await page.text('before')).toContain('no WebGL 2');
    page.complaints = page.complaints.filter((text) => !text.includes('WebGL'));
  });

  test('once what was missing is there, the page can be tried again', async () => {
    let offline = true;
    const prepare = (tab) => tab.route('**/*.wasm', (route) => (offline ? route.abort() : route.continue()));
    expect(await open({ prepare })).toBe('error');
    expect(await page.text('notice-code')).toBe('LoadFailed');
    offline = false;
    expect(await page.after(() => page.at('example').selectOption('torus'))).toBe('ready');
    expect(await page.counts('before')).toEqual(TORUS_NOISY);
    page.complaints = page.complaints.filter((text) => !text.includes('ERR_FAILED'));
  });

  for (const [what, pattern] of [
    ['the wasm file', '**/*.wasm'],
    ["the worker's script", '**/worker-*.js'],
    ['the example', '**/*.ply'],
  ]) {
    test(`without ${what} the page says so`, async () => {
      expect(await open({ prepare: (tab) => tab.route(pattern, (route) => route.abort()) })).toBe('error');
      expect((await page.text('notice')).trim().length).toBeGreaterThan(30);
      expect(await page.at('notice').isVisible()).toBe(true);
      page.complaints = page.complaints.filter((text) => !text.includes('ERR_FAILED'));
    });
  }
});
