// Takes the README's pictures of the real page: docs/reading.webp, the Earth's geoid simplified, with its basins, its Morse complex
// and the plots, and docs/constraints.webp, a protein's potential interpolated at its persistent critical points, with the report.
// Also docs/three.webp, examples/three.html as it comes up.
// (docs/sheet.png is drawn by examples/sheet.mjs.)
import { mkdirSync, writeFileSync } from 'node:fs';
import { NO_BROWSER, findBrowser } from './lib/browser.mjs';
import { Problem, main, say } from './lib/log.mjs';
import { inRoot } from './lib/paths.mjs';
import { build } from './build.mjs';
import { setUp } from './setup.mjs';

const READING = { width: 1240, height: 860 };
/** Wide enough for the report's four columns. */
const CONSTRAINTS = { width: 1480, height: 880 };
const THREE = { width: 760, height: 540 };
/** Twice the width that it is shown with, for screens with small pixels: a PNG of it would have a megabyte. */
const SCALE = 2;
const QUALITY = 0.8;
/** It is fetched with every visit of the README. */
const LIMIT = 300_000;

await main(async () => {
  await setUp();
  await build();
  const browser = await findBrowser();
  if (browser === null) throw new Problem(NO_BROWSER);
  process.env.CHROME_PATH = browser;

  const { build: bundle } = await import('vite');
  await bundle({ root: inRoot('www'), logLevel: 'warn' });
  const { startBrowser } = await import('../tests/browser/driver.js');
  const driver = await startBrowser();
  try {
    const page = await driver.open({ viewport: READING, deviceScaleFactor: SCALE });
    if ((await page.settled()) !== 'ready') throw new Problem('The page does not come up: npm test says more.');
    await page.after(() => page.at('example').selectOption('earth'));
    await page.after(() => page.at('method').selectOption('simplify'));
    await page.after(() => page.at('coloring').selectOption('minima'));
    await page.after(() => page.at('show-complex').check());
    await page.at('show-levels').uncheck();
    await page.at('show-glyphs').uncheck();
    await page.page.setViewportSize(READING);
    await page.look('after');
    await save(page, 'reading', await page.page.locator('main').screenshot());

    await page.at('coloring').selectOption('value');
    await page.at('show-complex').uncheck();
    await page.after(() => page.at('example').selectOption('lysozyme'));
    await page.after(() => page.at('method').selectOption('interpolate'));
    await page.after(() => page.at('weights').selectOption('intrinsicDelaunay'));
    await page.at('show-levels').check();
    await page.at('show-glyphs').check();
    await page.at('tab-report').click();
    await page.page.setViewportSize(CONSTRAINTS);
    await page.look('after');
    await save(page, 'constraints', await page.page.locator('main').screenshot());
  } finally {
    await driver.close();
  }
  await takeExample();
});

async function takeExample() {
  const { openPage, serveFolder } = await import('../tests/package/browser.js');
  const server = await serveFolder(inRoot());
  const options = { viewport: THREE, deviceScaleFactor: SCALE };
  const { page, close } = await openPage(`${server.url}/examples/three.html`, options);
  try {
    await page.waitForSelector('canvas');
    await page.mouse.move(THREE.width / 2, 0.42 * THREE.height);
    await save({ page }, 'three', await page.screenshot());
  } finally {
    await close();
    await server.close();
  }
}

async function save(page, name, png) {
  const picture = await webp(page.page, png);
  mkdirSync(inRoot('docs'), { recursive: true });
  writeFileSync(inRoot('docs', `${name}.webp`), picture);
  say(`docs/${name}.webp: ${Math.round(picture.length / 1000)} kB`);
  if (picture.length > LIMIT) throw new Problem(`That is more than ${LIMIT / 1000} kB.`);
}

/** The browser is the encoder. */
async function webp(page, png) {
  const encode = async ([source, quality]) => {
    const bytes = Uint8Array.from(atob(source), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes]));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    canvas.getContext('2d').drawImage(bitmap, 0, 0);
    const encoded = await canvas.convertToBlob({ type: 'image/webp', quality });
    return [...new Uint8Array(await encoded.arrayBuffer())];
  };
  return Buffer.from(await page.evaluate(encode, [png.toString('base64'), QUALITY]));
}
