// ε in the page: while it moves, the fields come from a family, at rest from a solve; the plots along ε and the rules that choose it.
// Numbers are compared with what the package says of the same file in Node.
import { Smoother } from 'morse-smooth';
import { describe, expect, test } from 'vitest';
import { open, openTorus, page, torus } from './opened.js';
import { countsOf, expectReport, number, PERSISTENT } from './torus.js';

/** Until the family is as good as it gets. */
async function complete() {
  await page.page.waitForFunction(() => document.getElementById('choosing').dataset.family === 'complete');
}

/** The page's family, in Node. */
function withFamily(use, values = torus.noisy, options = {}) {
  const smoother = new Smoother(torus.mesh);
  const family = smoother.family(values, { epsilon: 0.1, ...options });
  try {
    return use(family);
  } finally {
    family.free();
    smoother.free();
  }
}

const countsAt = (family, epsilon) => countsOf(torus.mesh.criticalPoints(family.values(epsilon)).counts);
const shownEpsilon = async () => Number(await page.at('epsilon-number').inputValue());
const isPreview = () => page.page.evaluate(() => document.documentElement.hasAttribute('data-preview'));
/** A solve would have written the report again. */
const markReport = () => page.at('report').evaluate((report) => report.firstElementChild.classList.add('same'));
const isReportMarked = async () => (await page.at('report').locator('.same').count()) === 1;

/** Takes the slider with the mouse and drags it there; it is held until `mouse.up`. */
async function drag(...shares) {
  const { x, y, width, height } = await page.at('epsilon').boundingBox();
  const { mouse } = page.page;
  const at = async (share) => mouse.move(x + 8 + share * (width - 16), y + height / 2);
  const exponent = Number(await page.at('epsilon').inputValue());
  await at((exponent + 6) / 10);
  await mouse.down();
  for (const share of shares) {
    await at(share);
    await shownAs(await shownEpsilon());
  }
}

/** Until the After view shows that ε without a solve. */
async function shownAs(epsilon) {
  const expected = withFamily((family) => countsAt(family, epsilon)).map((count) => count.toLocaleString('en'));
  await page.page.waitForFunction((texts) => {
    const shown = ['minima', 'maxima', 'saddles'].map(
      (kind) => document.querySelector(`[data-testid="after-${kind}"]`).textContent,
    );
    return document.documentElement.hasAttribute('data-preview') && texts.every((text, k) => text === shown[k]);
  }, expected);
}

async function over(id) {
  return page.at(id).locator('.u-over').boundingBox();
}

describe('while ε moves', () => {
  test('the family answers, and nothing is solved for until it is let go', async () => {
    await openTorus();
    await complete();
    await markReport();
    const [before, pictures] = [await page.text('read-linf'), [await page.picture('after')]];
    await drag(0.2, 0.75, 0.6);
    pictures.push(await page.picture('after'));
    expect(pictures[1].equals(pictures[0])).toBe(false);
    expect(await isReportMarked()).toBe(true);
    expect(await page.text('read-linf')).toBe(before);
    expect(await page.text('status')).toMatch(/^\s*Preview, error (about|below) /);
    expect(await page.text('after-euler')).toMatch(/✓$/);
    // Held still, it stays one.
    await page.page.waitForTimeout(600);
    expect(await isPreview()).toBe(true);
    expect(await isReportMarked()).toBe(true);

    const epsilon = await shownEpsilon();
    expect(epsilon).not.toBe(0.1);
    await page.page.mouse.up();
    await page.page.waitForFunction(() => !document.documentElement.hasAttribute('data-preview'));
    expect(await page.settled()).toBe('ready');
    expect(await isReportMarked()).toBe(false);
    const exact = torus.smoothed('tikhonov', { epsilon });
    await expectReport(page, exact);
    expect(await page.counts('after')).toEqual(countsOf(exact.report.after));
    expect(await page.text('read-solver')).toBe(exact.report.solver.route);
  });

  test('by the keyboard, the solve follows when no key is pressed any more', async () => {
    await openTorus();
    await complete();
    await markReport();
    await page.at('epsilon').focus();
    for (let k = 0; k < 4; k++) await page.page.keyboard.press('ArrowRight');
    expect(await page.settled()).toBe('ready');
    expect(await isReportMarked()).toBe(false);
    await expectReport(page, torus.smoothed('tikhonov', { epsilon: await shownEpsilon() }));
  });

  test('what is saved is the solved field all the same', async () => {
    await openTorus();
    await complete();
    const [download] = await Promise.all([
      page.page.waitForEvent('download'),
      page.page.evaluate(() => {
        const slider = document.getElementById('epsilon');
        slider.value = '1';
        slider.dispatchEvent(new Event('input'));
        document.getElementById('save').click();
      }),
    ]);
    await download.path();
    expect(await page.settled()).toBe('ready');
    await expectReport(page, torus.smoothed('tikhonov', { epsilon: 10 }));
  });

  test('on a larger mesh only colors and points follow; lines are back at rest', async () => {
    expect(await open({ example: 'lysozyme' })).toBe('ready');
    await complete();
    await markReport();
    const slider = page.at('epsilon');
    await slider.dispatchEvent('pointerdown', { button: 0 });
    const before = await page.counts('after');
    await page.slide('epsilon', [3]);
    await page.page.waitForFunction(() => document.documentElement.hasAttribute('data-preview'));
    await expect.poll(() => page.counts('after')).not.toEqual(before);
    expect(await page.text('after-euler')).toMatch(/✓$/);
    const moving = await page.counts('after');
    expect(await isReportMarked()).toBe(true);
    await page.after(() => page.page.evaluate(() => window.dispatchEvent(new PointerEvent('pointerup'))));
    expect(await isReportMarked()).toBe(false);
    // The family is within a millionth of the field: some very flat point may differ.
    const rest = await page.counts('after');
    rest.forEach((count, k) => expect(Math.abs(count - moving[k])).toBeLessThanOrEqual(4));
  });

  test('another field has a family of its own, and so have least squares', async () => {
    await openTorus();
    await complete();
    const clean = withFamily((family) => Array.from(family.values(1e-3)));
    await page.drop('smoother.txt', clean.join('\n'));
    await page.page.waitForFunction(() => document.getElementById('field').value === 'added:smoother.txt');
    expect(await page.settled()).toBe('ready');
    // Whatever answers now, it is not the family of the last field.
    await page.after(() => page.slide('epsilon', [-2]));
    await expectReport(page, torusOf(Float64Array.from(clean), { epsilon: 0.01 }));
    await complete();
    const choice = withFamily((family) => family.choose({ rule: 'lCurve' }), Float64Array.from(clean));
    expect(await page.text('choices-text')).toContain(`L-curve corner ε = ${Number(choice.epsilon.toPrecision(3))}`);

    await page.choose('field', 'file:noisy');
    await page.choose('method', 'leastSquares');
    await complete();
    const constraints = PERSISTENT;
    const { method } = torus.smoothed('leastSquares', { constraints, epsilon: 0.01 }).report;
    expect(method).toBe('leastSquares');
    const fitted = withFamily((family) => family.choose({ rule: 'lCurve' }), torus.noisy, {
      constraints,
      epsilon: 0.01,
    });
    await page.at('open-choosing').click();
    await page.at('epsilon-rule').selectOption('lCurve');
    await page.after(() => page.at('choose').click());
    expect(await shownEpsilon()).toBe(Number(fitted.epsilon.toPrecision(4)));
  });
});

function torusOf(values, options) {
  const smoother = new Smoother(torus.mesh);
  try {
    return smoother.tikhonov(values, options);
  } finally {
    smoother.free();
  }
}

describe('the plots along ε', () => {
  test('show the same ε, and set it', async () => {
    await openTorus();
    await complete();
    await page.at('tab-choosing').click();
    const box = await over('epsilon-counts');
    // The axis goes from 1e-6 to 1e4.
    const point = async (exponent, act = 'move') =>
      page.page.mouse[act](box.x + (box.width * (exponent + 6)) / 10, box.y + box.height / 2);
    await point(1);
    await expect.poll(() => page.text('epsilon-counts-values')).toMatch(/^ε = (9\.\d+|10(\.\d)?): /);
    const epsilon = number((await page.text('epsilon-counts-values')).split('ε = ')[1]);
    const norms = await page.text('norms-values');
    expect(norms).toContain(`ε = ${epsilon}: ‖x − f‖ = `);
    const { metricNorm, laplacianNorm } = withFamily((family) => family.sweep({ epsilons: [epsilon] }));
    for (const [name, expected] of [
      ['‖x − f‖ = ', metricNorm[0]],
      ['‖Lx‖ = ', laplacianNorm[0]],
    ])
      expect(number(norms.split(name)[1]) / expected, name).toBeCloseTo(1, 2);
    // Pointing changes nothing.
    expect(await shownEpsilon()).toBe(0.1);

    await markReport();
    await page.after(() => point(1, 'click'));
    expect(await shownEpsilon()).toBe(epsilon);
    expect(await isReportMarked()).toBe(false);
    await expectReport(page, torus.smoothed('tikhonov', { epsilon }));

    // From left to right along the L-curve, until the pointer is near it.
    const plot = await over('l-curve');
    await page.page.mouse.move(plot.x + 0.2 * plot.width, plot.y + plot.height - 2);
    let shown = null;
    for (let share = 1; share > 0 && shown === null; share -= 0.02) {
      await page.page.mouse.move(plot.x + 0.2 * plot.width, plot.y + share * plot.height);
      const text = await page.text('norms-values');
      if (!text.startsWith(`ε = ${epsilon}:`)) shown = text.match(/^ε = ([^:]+):/)[1].replace('e−', 'e-');
    }
    expect(shown).not.toBeNull();
    expect(await page.text('epsilon-counts-values')).toContain(`ε = ${shown.replace('e-', 'e−')}:`);
    await page.after(async () => {
      await page.page.mouse.down();
      await page.page.mouse.up();
    });
    expect(await shownEpsilon()).toBe(Number(shown));
    await expectReport(page, torus.smoothed('tikhonov', { epsilon: Number(shown) }));
  });

  test('count what the fields have', async () => {
    await openTorus();
    await complete();
    const { epsilons, ...columns } = withFamily((family) =>
      family.sweep({ epsilons: [1e-4, 1e-2, 1, 100], counts: true }),
    );
    for (const [k, epsilon] of [...epsilons].entries()) {
      await page.type('epsilon-number', epsilon);
      const counts = ['minima', 'maxima', 'saddles'].map((kind) => `${columns[kind][k].toLocaleString('en')} ${kind}`);
      await expect.poll(() => page.text('epsilon-counts-values')).toContain(`: ${counts.join(', ')}`);
    }
  });

  test('mark what the rules choose', async () => {
    await openTorus();
    await complete();
    await page.at('tab-choosing').click();
    await page.type('epsilon-number', 5);
    for (const [rule, name] of [
      ['gcv', 'cross-validation'],
      ['lCurve', 'L-curve corner'],
      ['discrepancy', 'discrepancy'],
    ]) {
      const { epsilon, reason } = withFamily((family) => family.choose({ rule }));
      await expect.poll(() => page.text('choices-text')).toContain(`${name} ε = ${Number(epsilon.toPrecision(3))}`);
      // Near to the mark, the pointer means it.
      const box = await over('epsilon-counts');
      await page.page.mouse.move(box.x + (box.width * (Math.log10(epsilon) + 6)) / 10 + 3, box.y + box.height / 2);
      if (rule !== 'discrepancy') expect(await page.text('choices-text')).toContain(reason);
      await page.page.mouse.move(0, 0);
    }
  });

  test('give way to a sentence where there is no ε', async () => {
    await openTorus();
    await complete();
    await page.at('tab-choosing').click();
    expect(await page.at('l-curve').isVisible()).toBe(true);
    await page.choose('method', 'simplify');
    for (const id of ['l-curve', 'epsilon-counts', 'choose']) expect(await page.at(id).isVisible(), id).toBe(false);
    expect(await page.text('epsilon-none')).toMatch(/takes no ε/);
    await page.choose('method', 'tikhonov');
    await complete();
    for (const id of ['l-curve', 'epsilon-counts', 'choose']) expect(await page.at(id).isVisible(), id).toBe(true);
    await page.choose('metric', 'finiteElements');
    expect(await page.text('epsilon-none')).toMatch(/wavelength takes the place of ε/);
    expect(await page.at('l-curve').isVisible()).toBe(false);
  });
});

describe('a rule', () => {
  test('sets ε as the package chooses it, and says why', async () => {
    await openTorus();
    await page.at('open-choosing').click();
    expect(await page.at('tab-choosing').getAttribute('aria-selected')).toBe('true');
    for (const [option, rule] of [
      ['auto', 'auto'],
      ['lCurve', { rule: 'lCurve' }],
      ['discrepancy', { rule: 'discrepancy' }],
      ['atMostCriticalPoints', { rule: 'atMostCriticalPoints', count: 12 }],
    ]) {
      await page.at('epsilon-rule').selectOption(option);
      expect(await page.at('most-points').isVisible()).toBe(option === 'atMostCriticalPoints');
      if (option === 'atMostCriticalPoints') await page.at('most-points').fill('12');
      expect(await page.after(() => page.at('choose').click())).toBe('ready');
      const { epsilon, reason, runnersUp } = withFamily((family) => family.choose(rule));
      expect(await shownEpsilon(), option).toBe(Number(epsilon.toPrecision(4)));
      expect(await page.text('choices-text')).toContain(reason);
      if (runnersUp.length > 0) expect(await page.text('choices-text')).toContain('Next best: ε = ');
      await expectReport(page, torus.smoothed('tikhonov', { epsilon: Number(epsilon.toPrecision(4)) }));
    }
    // It was why that ε is there, and goes with it.
    await page.type('epsilon-number', 0.5);
    await expect.poll(() => page.text('choices-text')).toMatch(/^Marked: /);
  });

  test('that no ε can keep is an error, and ε stays', async () => {
    await openTorus();
    await page.at('open-choosing').click();
    await page.at('epsilon-rule').selectOption('atMostCriticalPoints');
    await page.at('most-points').fill('3');
    expect(await page.after(() => page.at('choose').click())).toBe('error');
    expect(await page.text('notice-code')).toBe('TooManyCriticalPoints');
    expect(await shownEpsilon()).toBe(0.1);
    expect(await page.after(() => page.slide('epsilon', [2]))).toBe('ready');
  });
});
