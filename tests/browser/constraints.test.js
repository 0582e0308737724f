// Constraints in the page: by rule and by hand, on the surface, in the table and in the persistence diagram; what is said where
// nothing holds the field. Numbers are compared with what the package says of the same file in Node.
import { describe, expect, test } from 'vitest';
import { openTorus, page, torus } from './opened.js';
import { countsOf, expectReport, number, PERSISTENT } from './torus.js';

describe('constraints by rule', () => {
  const rules = {
    critical: () => ({ from: 'criticalPoints' }),
    delta: () => ({ from: 'criticalPoints', delta: 0.2 }),
    persistence: () => PERSISTENT,
    kMeans: () => ({ from: 'kMeans', clusters: 7 }),
  };

  test('each comes to the package’s vertices, with and without stars', async () => {
    await openTorus();
    // Thousands of them take most of the time.
    await page.at('show-glyphs').uncheck();
    await page.choose('method', 'leastSquares');
    await page.type('delta-number', 0.2);
    for (const [rule, make] of Object.entries(rules)) {
      if ((await page.at('rule').inputValue()) !== rule) await page.choose('rule', rule);
      if (rule === 'kMeans') await page.type('clusters', 7);
      const features = torus.mesh.constrainedVertices(torus.noisy, { ...make(), stars: false });
      const all = torus.mesh.constrainedVertices(torus.noisy, make());
      expect(await page.ringed(), rule).toEqual([...features]);
      expect(await page.constrained(), rule).toEqual({ all: all.length, features: features.length });
      await page.after(() => page.at('stars').uncheck());
      expect(await page.constrained(), rule).toEqual({ all: features.length, features: features.length });
      await page.after(() => page.at('stars').check());
    }
    const constraints = { from: 'kMeans', clusters: 7 };
    await expectReport(page, torus.smoothed('leastSquares', { epsilon: 0.1, constraints }));
  });

  test('the report says what became of the constrained critical points', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    const { report } = torus.smoothed('interpolate', { constraints: PERSISTENT });
    const features = torus.mesh.constrainedVertices(torus.noisy, { ...PERSISTENT, stars: false }).length;
    expect(number(await page.text('report-constrained'))).toBe(report.constraintCount);
    expect(number(await page.text('report-features'))).toBe(features);
    expect(await page.text('report-kept')).toBe(
      `${report.preserved} of ${report.constrainedCriticalPoints} critical points`,
    );
    expect(report.preserved).toBe(report.constrainedCriticalPoints);
    expect(number(await page.text('report-free'))).toBe(report.freeExtrema);
  });

  test('a δ at which no critical point is left is said, and no error', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    await page.choose('rule', 'delta');
    expect(await page.at('others').isVisible()).toBe(false);
    expect(await page.type('delta-number', 0.5)).toBe('ready');
    expect(await page.at('notice').isVisible()).toBe(false);
    expect(await page.text('after')).toMatch(/No critical point is left at δ = 0\.5.*Lower δ/);
    expect(await page.text('report')).toMatch(/No critical point is left/);
    expect(await page.constrained()).toEqual({ all: 0, features: 0 });
    expect(await page.at('save').isDisabled()).toBe(true);
    expect(await page.at('delta-number').inputValue()).toBe('0.5');
    expect(await page.choose('unconstrained', 'keep')).toBe('ready');
    expect(await page.counts('after')).toEqual([0, 0, 0]);
    expect(number(await page.text('report-linf'))).toBe(0);
    await page.choose('unconstrained', 'error');
    expect(await page.text('after')).toMatch(/No critical point is left/);
    expect(await page.type('delta-number', 0.3)).toBe('ready');
    expect((await page.constrained()).features).toBe(torus.mesh.constrainedVertices(torus.noisy, { from: 'criticalPoints', delta: 0.3, stars: false }).length); // prettier-ignore
    expect(number(await page.text('report-linf'))).toBeGreaterThan(0);
    expect(await page.at('others').isVisible()).toBe(false);
  });

  // Two tetrahedra apart; the field is x.
  const corners = ['0 0 0', '1 0 0', '0 1 0', '0 0 1'];
  const points = [0, 5].flatMap((shift) => corners.map((text) => `v ${Number(text[0]) + shift}${text.slice(1)}`));
  const faces = [0, 4].flatMap((first) => ['1 3 2', '1 2 4', '1 4 3', '2 3 4'].map((face) => `f ${face.replace(/\d/g, (k) => Number(k) + first)}`)); // prettier-ignore
  const two = [...points, ...faces, ''].join('\n');

  test('a component without a constraint is named, with what can be done', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    expect(await page.after(() => page.drop('two.obj', Buffer.from(two)))).toBe('ready');
    expect(await page.text('facts')).toContain('2 components');
    expect(await page.at('others').isVisible()).toBe(true);
    await page.after(() => page.at('stars').uncheck());
    await page.choose('rule', 'picked');
    expect(await page.text('after')).toMatch(/No vertex is picked yet\. Click on the surface/);
    await page.at('tab-points').click();
    await page.after(() => page.page.getByLabel('Constrain vertex 1', { exact: true }).click());
    expect(await page.settled()).toBe('ready');
    expect(await page.text('after')).toMatch(
      /Component 2 of 2 of the mesh has no constrained vertex \(vertex 4 lies in it\).*Constrain one of its vertices.*“Components without constraints”/,
    );
    expect(await page.choose('unconstrained', 'keep')).toBe('ready');
    expect(number(await page.text('report-constrained'))).toBe(1);
    expect(await page.choose('unconstrained', 'mean')).toBe('ready');
    await page.choose('unconstrained', 'error');
    expect(await page.text('after')).toMatch(/Component 2 of 2/);
    await page.after(() => page.page.getByLabel('Constrain vertex 5', { exact: true }).click());
    expect(await page.ringed()).toEqual([1, 5]);
    expect(number(await page.text('report-linf'))).toBeGreaterThan(0);
  });
});

describe('constraints by hand', () => {
  const persistent = () => [...torus.mesh.constrainedVertices(torus.noisy, { ...PERSISTENT, stars: false })];
  /** On the surface in front. */
  const spot = async (side = 'before') => {
    const { x, y, width, height } = await page.at(`${side}-canvas`).boundingBox();
    return [x + 0.5 * width, y + 0.8 * height];
  };

  test('a click on either surface picks a vertex, another one frees it, and a drag does neither', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    await page.after(() => page.at('clear-picked').click());
    expect(await page.at('rule').inputValue()).toBe('picked');
    expect(await page.text('after')).toMatch(/No vertex is picked yet/);
    const { mouse } = page.page;
    const [x, y] = await spot();
    await page.after(() => mouse.click(x, y));
    const [vertex, ...others] = await page.ringed();
    expect(others).toEqual([]);
    expect((await page.constrained()).features).toBe(1);
    expect((await page.constrained()).all).toBe(
      torus.mesh.constrainedVertices(torus.noisy, { from: 'vertices', vertices: [vertex] }).length,
    );
    await page.after(() => mouse.click(x + 60, y));
    expect((await page.ringed()).length).toBe(2);
    const [x2, y2] = await spot('after');
    await page.after(() => mouse.click(x2, y2));
    expect((await page.ringed()).includes(vertex)).toBe(false);
    const picked = await page.ringed();
    await mouse.move(x, y);
    await mouse.down();
    await mouse.move(x + 40, y + 5, { steps: 4 });
    await mouse.up();
    expect(await page.ringed()).toEqual(picked);
    // Beside the surface there is nothing to pick.
    await mouse.click(x - 200, y);
    expect(await page.ringed()).toEqual(picked);
    // Vertices that are no critical points are listed, too.
    await page.at('tab-points').click();
    await page.at('point-constrained').check();
    expect(await page.text('points-text')).toBe('1 point, 1 constrained');
    await expectReport(page, torus.smoothed('interpolate', { constraints: { from: 'vertices', vertices: picked } }));
  });

  test('a click means nothing to methods without constraints', async () => {
    await openTorus();
    const [x, y] = await spot();
    await page.page.mouse.click(x, y);
    expect(await page.ringed()).toEqual([]);
    expect(await page.settled()).toBe('ready');
  });

  test('rings are drawn on both surfaces', async () => {
    await openTorus();
    await page.at('show-glyphs').uncheck();
    const plain = await page.picture('before');
    await page.choose('method', 'interpolate');
    expect((await page.picture('before')).equals(plain)).toBe(false);
    await page.choose('method', 'tikhonov');
    expect((await page.picture('before')).equals(plain)).toBe(true);
  });

  test('the table constrains and frees critical points, with the pointer and with keys', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    await page.at('tab-points').click();
    const row = (k) => page.at('points-rows').locator(`[data-row="${k}"]`);
    const vertexOf = async (k) => Number((await row(k).getAttribute('id')).replace('point-', ''));
    // The most persistent first: those without a partner, and then by pairs.
    const first = await vertexOf(0);
    expect(await row(0).textContent()).toContain('∞');
    await page.after(() => row(0).getByRole('checkbox').click());
    expect(await page.at('rule').inputValue()).toBe('picked');
    expect(await page.ringed()).toEqual(persistent().filter((vertex) => vertex !== first));
    await row(1).hover();
    for (const side of ['before', 'after'])
      expect(await page.at(side).getAttribute('data-lit')).toBe(String(await vertexOf(1)));
    await page.page.mouse.move(5, 5);
    expect(await page.at('before').getAttribute('data-lit')).toBe(null);

    const box = page.at('points-box');
    const { keyboard } = page.page;
    await box.focus();
    await keyboard.press('Home');
    expect(await box.getAttribute('aria-activedescendant')).toBe(`point-${first}`);
    await page.after(() => keyboard.press('Space'));
    expect(await page.ringed()).toEqual(persistent());
    await keyboard.press('End');
    const last = Number((await box.getAttribute('aria-activedescendant')).replace('point-', ''));
    expect(await page.at('before').getAttribute('data-lit')).toBe(String(last));
    await page.after(() => keyboard.press('Enter'));
    expect(await page.ringed()).toEqual([...persistent(), last].sort((a, b) => a - b));
  });

  test('the table is sorted and filtered', async () => {
    await openTorus();
    await page.at('tab-points').click();
    const { vertices, kinds } = torus.mesh.criticalPoints(torus.noisy);
    const top = () => page.at('points-rows').locator('[data-row="0"]').getAttribute('id');
    const best = (of, sign) => of.reduce((a, b) => (sign * torus.noisy[b] > sign * torus.noisy[a] ? b : a));
    await page.at('sort-value').click();
    expect(await top()).toBe(`point-${best([...vertices], 1)}`);
    await page.at('sort-value').click();
    expect(await top()).toBe(`point-${best([...vertices], -1)}`);
    await page.at('point-kinds').selectOption('1');
    const maxima = [...vertices].filter((_, k) => kinds[k] === 1);
    expect(await top()).toBe(`point-${best(maxima, -1)}`);
    expect(number(await page.text('points-text'))).toBe(maxima.length);
    const { vertices: critical, vanishesAt } = torus.mesh.deltaHierarchy(torus.noisy);
    await page.at('point-kinds').selectOption('all');
    await page.at('sort-vanishes').click();
    const longest = critical[vanishesAt.reduce((a, b, k) => (b > vanishesAt[a] ? k : a), 0)];
    expect(await top()).toBe(`point-${longest}`);
    // Only rows in sight are there.
    expect(await page.at('points-rows').locator('[data-row]').count()).toBeLessThan(40);
  });

  test('the persistence diagram drops a pair’s two ends from the set, or adds them', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    const pairs = torus.mesh.persistence(torus.noisy);
    const ends = [pairs.extrema[0], pairs.saddles[0]];
    await page.at('diagram').focus();
    const { keyboard } = page.page;
    await keyboard.press('Home');
    expect(await page.text('pair-values')).toMatch(/, kept$/);
    await page.after(() => keyboard.press('Enter'));
    expect(await page.at('rule').inputValue()).toBe('persistence');
    expect(await page.ringed()).toEqual(persistent().filter((vertex) => !ends.includes(vertex)));
    await page.after(() => keyboard.press('Enter'));
    expect(await page.ringed()).toEqual(persistent());

    await page.after(() => page.at('clear-picked').click());
    await page.at('diagram').focus();
    await keyboard.press('Home');
    expect(await page.text('pair-values')).toMatch(/, not constrained$/);
    await page.after(() => keyboard.press('Enter'));
    expect(await page.text('pair-values')).toMatch(/, constrained$/);
    expect(await page.ringed()).toEqual(ends.sort((a, b) => a - b));
    await keyboard.press('Escape');
    expect(await page.text('pair-values')).toMatch(/^Both ends of 1 of \d/);
    await page.after(() => page.at('rule').selectOption('persistence'));
    expect(await page.text('pair-values')).toMatch(/^Keeps 9 minima/);
  });

  test('a rule’s vertices can be taken over, and all cleared', async () => {
    await openTorus();
    await page.choose('method', 'leastSquares');
    const { report } = torus.smoothed('leastSquares', { epsilon: 0.1, constraints: PERSISTENT });
    await page.after(() => page.at('take-over').click());
    expect(await page.at('rule').inputValue()).toBe('picked');
    expect(await page.at('take-over').isDisabled()).toBe(true);
    expect(await page.ringed()).toEqual(persistent());
    // What is picked does not depend on the threshold.
    await page.type('persistence-number', 0.3);
    expect(await page.ringed()).toEqual(persistent());
    await page.after(() => page.at('clear-picked').click());
    expect(await page.ringed()).toEqual([]);
    expect(await page.at('clear-picked').isDisabled()).toBe(true);
    // Another mesh has other vertices.
    await page.choose('rule', 'persistence');
    await page.after(() => page.at('take-over').click());
    await page.after(() => page.at('example').selectOption('terrain'));
    expect(await page.ringed()).toEqual([]);
  });

  test('stopping leaves what is picked', async () => {
    await openTorus();
    await page.choose('method', 'interpolate');
    await page.after(() => page.at('take-over').click());
    const counts = await page.counts('after');
    await page.after(() =>
      page.page.evaluate(() => {
        const chooser = document.getElementById('energy');
        chooser.value = 'biharmonic';
        chooser.dispatchEvent(new Event('change'));
        document.getElementById('stop').click();
      }),
    );
    expect(await page.at('energy').inputValue()).toBe('harmonic');
    expect(await page.at('rule').inputValue()).toBe('picked');
    expect(await page.ringed()).toEqual(persistent());
    expect(await page.counts('after')).toEqual(counts);
  });
});
