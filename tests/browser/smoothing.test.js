// Every method of smoothing in the page, its controls and its report, and differences. Numbers are compared with what the package
// says of the same file in Node.
import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { meshOfFile } from '../js/mesh-of-file.js';
import { openTorus, page, torus } from './opened.js';
import { countsOf, expectReport, number, PERSISTENT } from './torus.js';

describe('methods', () => {
  const CONTROLS = [
    'epsilon',
    'metric',
    'wavelength',
    'energy',
    'filter',
    'mu',
    'bilateral-radius',
    'weights',
    'bounds',
    'rule',
  ];

  /** `settle`: what is chosen beside the method. */
  async function check({ method, settle = {}, options, controls, suffix }) {
    await page.choose('method', method);
    for (const [id, option] of Object.entries(settle)) await page.choose(id, option);
    expect(await page.state(), suffix).toBe('ready');
    for (const id of CONTROLS) expect(await page.at(id).isVisible(), `${suffix}: ${id}`).toBe(controls.includes(id));
    const expected = torus.smoothed(method, options);
    expect(await page.counts('after')).toEqual(countsOf(expected.report.after));
    await expectReport(page, expected);
    const { solver } = expected.report;
    if (solver.unknowns > 0) {
      expect(await page.text('read-solver')).toBe(solver.route);
      expect(number(await page.text('report-unknowns'))).toBe(solver.unknowns);
      expect(number(await page.text('report-factor'))).toBe(solver.factorNonzeros);
    } else {
      expect(await page.at('read-solver').count()).toBe(0);
      expect(number(await page.text('report-iterations'))).toBe(solver.iterations);
    }
    const [download] = await Promise.all([page.page.waitForEvent('download'), page.at('save').click()]);
    expect(download.suggestedFilename()).toBe(`torus_irregular_${suffix}.ply`);
    const saved = meshOfFile(readFileSync(await download.path()));
    saved.mesh.free();
    expect(saved.fields[`noisy_${suffix}`]).toEqual(expected.values);
  }

  test('with a system to solve do what the package does, with their own controls and report', async () => {
    await openTorus();
    const constraints = PERSISTENT;
    const interpolation = { method: 'interpolate', controls: ['energy', 'weights', 'bounds', 'rule'] };
    await check({ ...interpolation, options: { constraints }, suffix: 'harmonic' });
    await check({
      ...interpolation,
      settle: { energy: 'biharmonic' },
      options: { energy: 'biharmonic', constraints },
      suffix: 'biharmonic',
    });
    await check({
      method: 'leastSquares',
      options: { epsilon: 0.1, constraints },
      controls: ['epsilon', 'weights', 'bounds', 'rule'],
      suffix: 'least_squares',
    });
    await check({
      method: 'tikhonov',
      options: { epsilon: 0.1 },
      controls: ['epsilon', 'metric', 'weights', 'bounds'],
      suffix: 'tikhonov',
    });
  });

  test('that are filters, too', async () => {
    await openTorus();
    const lowPass = { iterations: 20, lambda: 0.5 };
    const controls = ['filter', 'weights', 'bounds'];
    await check({ method: 'lowPass', options: lowPass, controls, suffix: 'diffusion' });
    await check({
      method: 'lowPass',
      settle: { filter: 'taubin' },
      options: { ...lowPass, mu: -0.53 },
      controls: [...controls, 'mu'],
      suffix: 'low_pass',
    });
    const { meanEdge, range } = torus;
    await check({
      method: 'bilateral',
      options: { iterations: 5, radius: 3 * meanEdge, sigmaDistance: 1.5 * meanEdge, sigmaValue: 0.1 * range },
      controls: ['bilateral-radius', 'weights'],
      suffix: 'bilateral',
    });
  });

  test('finite elements take a wavelength for ε', async () => {
    await openTorus();
    await page.choose('metric', 'finiteElements');
    for (const id of ['epsilon', 'weights']) expect(await page.at(id).isVisible(), id).toBe(false);
    const cutoffWavelength = 10 * torus.meanEdge;
    await expectReport(page, torus.smoothed('tikhonov', { cutoffWavelength }, { operator: 'fem' }));
    expect(number(await page.text('wavelength-units'))).toBe(Number(cutoffWavelength.toPrecision(3)));
    await page.choose('method', 'leastSquares');
    for (const id of ['epsilon', 'weights']) expect(await page.at(id).isVisible(), id).toBe(true);
    expect(await page.at('wavelength').isVisible()).toBe(false);
  });

  test('weights are those of the Laplacian', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    for (const weights of ['intrinsicDelaunay', 'meanValue', 'normalizedCotangent', 'uniform', 'cotangent']) {
      expect(await page.choose('weights', weights), weights).toBe('ready');
      await expectReport(page, torus.smoothed('interpolate', { constraints: PERSISTENT }, { weights }));
    }
  });

  test('the maximum principle is said in words', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    const { maximumPrinciple } = torus.smoothed('interpolate', { constraints: PERSISTENT }).report;
    expect(maximumPrinciple.smallestWeight).toBeLessThan(0);
    const words = await page.text('report-principle');
    expect(words).toMatch(/^void: smallest weight −\d/);
    expect(words).toContain(
      maximumPrinciple.extrema === 1 ? '1 free extremum' : `${maximumPrinciple.extrema || 'no'} free`,
    );
    await page.choose('weights', 'intrinsicDelaunay');
    expect(await page.text('report-principle')).toMatch(/^holds: no weight is negative, no free extremum/);
    await page.choose('energy', 'biharmonic');
    expect(await page.at('report-principle').count()).toBe(0);
  });

  test('the error bound is found where it is asked for', async () => {
    await openTorus();
    expect(await page.at('report-bound').count()).toBe(0);
    await page.after(() => page.at('bounds').check());
    const { perturbationFactor } = torus.smoothed('tikhonov', { epsilon: 0.1 }, { bounds: true }).report;
    expect(number(await page.text('report-bound'))).toBeCloseTo(Number(perturbationFactor.toPrecision(3)), 6);
  });

  test('the filters’ numbers are kept within range, and lengths are in units of the mesh', async () => {
    await openTorus();
    await page.choose('method', 'bilateral');
    const units = (await page.text('bilateral-units')).match(/[\d.]+/g).map(Number);
    expect(units[0]).toBeCloseTo(3 * torus.meanEdge, 2);
    expect(units[1]).toBeCloseTo(1.5 * torus.meanEdge, 2);
    expect(units[2]).toBeCloseTo(0.1 * torus.range, 2);
    await page.type('bilateral-radius', 1e9);
    expect(await page.at('bilateral-radius').inputValue()).toBe('20');
    await page.choose('method', 'lowPass');
    await page.type('low-pass-iterations', 2.4);
    expect(await page.at('low-pass-iterations').inputValue()).toBe('2');
    await expectReport(page, torus.smoothed('lowPass', { iterations: 2 }));
    await page.type('lambda', -3);
    expect(await page.at('lambda').inputValue()).toBe('0.01');
  });
});

describe('differences', () => {
  test('color the right side alone, with a legend of their own', async () => {
    await openTorus();
    expect(await page.at('difference').isVisible()).toBe(false);
    const [before, after] = [await page.picture('before'), await page.picture('after')];
    await page.choose('coloring', 'difference');
    expect((await page.picture('before')).equals(before)).toBe(true);
    expect((await page.picture('after')).equals(after)).toBe(false);
    const { values } = torus.smoothed('tikhonov', { epsilon: 0.1 });
    const largest = values.reduce((most, value, i) => Math.max(most, Math.abs(value - torus.noisy[i])), 0);
    const text = String(Number(largest.toPrecision(3)));
    expect((await page.text('difference-ticks')).replaceAll(/\s+/g, '')).toBe(`−${text}0+${text}`);
    await page.type('epsilon-number', 100);
    const closer = number(await page.at('difference').locator('#difference-high').textContent());
    expect(closer).toBeLessThan(largest);
    await page.type('epsilon-number', 0.1);
    await page.choose('coloring', 'value');
    expect(await page.at('difference').isVisible()).toBe(false);
    expect((await page.picture('after')).equals(after)).toBe(true);
  });

  test('are not computed anew, and nor is the field, for what has no part in them', async () => {
    await openTorus();
    await page.choose('coloring', 'difference');
    // A smoothing that was repeated would have written the report again.
    await page.at('report').evaluate((report) => report.firstElementChild.classList.add('same'));
    await page.after(() => page.slide('delta', [0.05]));
    await page.after(() => page.slide('persistence', [0.5]));
    await page.choose('coloring', 'minima');
    expect(await page.at('report').locator('.same').count()).toBe(1);
    await page.choose('metric', 'lumped');
    expect(await page.at('report').locator('.same').count()).toBe(0);
  });
});

describe('at any width', () => {
  test('the tabs are tabs for the keyboard', async () => {
    await openTorus();
    await page.at('tab-plots').focus();
    await page.page.keyboard.press('ArrowRight');
    expect(await page.at('tab-choosing').getAttribute('aria-selected')).toBe('true');
    expect(await page.at('l-curve').isVisible()).toBe(true);
    await page.page.keyboard.press('ArrowRight');
    expect(await page.at('tab-points').getAttribute('aria-selected')).toBe('true');
    expect(await page.at('points-box').isVisible()).toBe(true);
    expect(await page.at('diagram').isVisible()).toBe(false);
    await page.page.keyboard.press('ArrowRight');
    expect(await page.at('report').isVisible()).toBe(true);
    await page.page.keyboard.press('ArrowRight');
    expect(await page.at('diagram').isVisible()).toBe(true);
  });

  for (const [what, options] of [
    ['a phone', { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }],
    ['a small laptop', { viewport: { width: 1280, height: 720 } }],
  ]) {
    test(`on ${what} nothing sticks out`, async () => {
      await openTorus(options);
      await page.choose('coloring', 'difference');
      for (const method of ['interpolate', 'lowPass', 'bilateral', 'leastSquares']) {
        await page.choose('method', method);
        for (const tab of ['tab-choosing', 'tab-points', 'tab-report', 'tab-plots']) {
          await page.at(tab).click();
          expect(await page.overflow(), `${method} ${tab}`).toEqual([]);
        }
      }
      expect(await page.page.evaluate(() => document.documentElement.scrollWidth)).toBe(options.viewport.width);
    });
  }

  test('a finger picks and constrains', async () => {
    await openTorus({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
    await page.choose('method', 'interpolate');
    await page.after(() => page.at('clear-picked').click());
    const canvas = page.at('before-canvas');
    await canvas.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await canvas.boundingBox();
    await page.after(() => page.page.touchscreen.tap(x + 0.5 * width, y + 0.75 * height));
    expect((await page.ringed()).length).toBe(1);
  });
});
