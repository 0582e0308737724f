// A browser for a file of tests, the page with the torus in it for each of its tests, and what the package says of that torus.
// Tests see the page that is open through the binding `page`.
import { afterAll, afterEach, beforeAll, expect } from 'vitest';
import { startBrowser } from './driver.js';
import { readTorus } from './torus.js';

export let browser;
export let page;
export let torus;

beforeAll(async () => {
  browser = await startBrowser();
  torus = readTorus();
});
afterAll(async () => {
  torus?.mesh.free();
  await browser?.close();
});
afterEach(async () => {
  const complaints = page?.complaints ?? [];
  await page?.close();
  page = null;
  expect(complaints, 'errors in the console').toEqual([]);
});

export async function open(options) {
  page = await browser.open(options);
  return page.settled();
}

export async function openTorus(options) {
  expect(await open({ example: 'torus', ...options })).toBe('ready');
}
