// Takes the README's picture, docs/picture.webp, from the real page: the opening example before and after smoothing.
import { mkdirSync, statSync, writeFileSync } from 'node:fs';
import { NO_BROWSER, findBrowser } from './lib/browser.mjs';
import { Problem, main, say } from './lib/log.mjs';
import { inRoot } from './lib/paths.mjs';
import { build } from './build.mjs';
import { setUp } from './setup.mjs';

/** Of the page around the two views: what is left for them makes a picture as wide as a README's column. */
const VIEWPORT = { width: 1240, height: 1115 };
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
    const page = await driver.open({ viewport: VIEWPORT, deviceScaleFactor: SCALE });
    if ((await page.settled()) !== 'ready') throw new Problem('The page does not come up: npm test says more.');
    // Waits for the next frame, which is the first with everything in it.
    await page.look('after');
    const picture = await webp(page.page, await page.page.locator('.views').screenshot());
    mkdirSync(inRoot('docs'), { recursive: true });
    writeFileSync(inRoot('docs', 'picture.webp'), picture);
  } finally {
    await driver.close();
  }
  const { size } = statSync(inRoot('docs', 'picture.webp'));
  say(`docs/picture.webp: ${Math.round(size / 1000)} kB`);
  if (size > LIMIT) throw new Problem(`That is more than ${LIMIT / 1000} kB.`);
});

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
