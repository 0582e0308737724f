// The built page in a real browser, with the few things that a person does to it.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { serve } from './serve.js';

const BUILT = fileURLToPath(new URL('../../www/dist/', import.meta.url));
const PATIENCE = 60_000;

export async function startBrowser() {
  if (!existsSync(BUILT)) throw new Error('www/dist is missing: build the page first (`npx vite build www`)');
  const executablePath = process.env.CHROME_PATH ?? '/usr/bin/chromium';
  const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
  // Under a sub path, where absolute addresses would fail.
  const server = await serve(BUILT, '/some/where/');
  return {
    open: (options) => Page.open(browser, server.address, options),
    close: async () => {
      await browser.close();
      await server.close();
    },
  };
}

export class Page {
  /** What the console and the page itself complained about. */
  complaints = [];

  /** `example` is the one to open, `prepare` gets the page before anything is loaded. */
  static async open(browser, address, { viewport = { width: 1280, height: 800 }, example, prepare, ...context } = {}) {
    const page = new Page();
    page.context = await browser.newContext({ viewport, ...context });
    page.page = await page.context.newPage();
    page.page.on('console', (message) => {
      if (message.type() === 'error') page.complaints.push(message.text());
    });
    page.page.on('pageerror', (error) => page.complaints.push(String(error)));
    await prepare?.(page.page);
    await page.page.goto(example ? `${address}#${example}` : address);
    return page;
  }

  /** What an element says, with plain spaces. */
  async text(id) {
    return (await this.at(id).textContent()).replaceAll('\u00a0', ' ');
  }

  at(id) {
    return this.page.getByTestId(id);
  }

  async close() {
    await this.context.close();
  }

  state() {
    return this.page.evaluate(() => document.documentElement.dataset.state);
  }

  /** Until nothing is under way; resolves to 'ready' or 'error'. */
  async settled() {
    await this.page.waitForFunction(() => document.documentElement.dataset.state !== 'working', null, {
      timeout: PATIENCE,
    });
    return this.state();
  }

  /** Does something that sets the page to work, and waits for the end of it. */
  async after(act) {
    await this.page.evaluate(() => {
      window.sawWork = false;
      new MutationObserver(() => {
        window.sawWork ||= document.documentElement.dataset.state === 'working';
      }).observe(document.documentElement, { attributes: true });
    });
    await act();
    await this.page.waitForFunction(() => window.sawWork, null, { timeout: PATIENCE });
    return this.settled();
  }

  /** [minima, maxima, saddles] of a side, as shown. */
  async counts(side) {
    const texts = await Promise.all(['minima', 'maxima', 'saddles'].map((kind) => this.text(`${side}-${kind}`)));
    return texts.map((text) => Number(text.replaceAll(',', '')));
  }

  /** Chooses from a list, and waits for the end of it. */
  choose(id, option) {
    return this.after(() => this.at(id).selectOption(option));
  }

  /** Types a number, as a person does. */
  type(id, number) {
    return this.after(async () => {
      await this.at(id).fill(String(number));
      await this.at(id).press('Tab');
    });
  }

  /** The vertices with rings around them, which both views have. */
  async ringed() {
    const sides = ['before', 'after'].map((side) => this.at(side).getAttribute('data-constrained'));
    const [before, after] = await Promise.all(sides);
    if (before !== after) throw new Error(`rings around ${before} before, around ${after} after`);
    return before === '' ? [] : before.split(' ').map(Number);
  }

  /** How many vertices are constrained and how many of them are feature points, as the form says. */
  async constrained() {
    const [all, features] = (await this.text('constrained')).replaceAll(',', '').match(/\d+/g).map(Number);
    return { all, features };
  }

  /** Moves a slider as a drag does: many values in a row, none of them waited for. */
  slide(id, values) {
    return this.at(id).evaluate((slider, positions) => {
      for (const position of positions) {
        slider.value = String(position);
        slider.dispatchEvent(new Event('input', { bubbles: true }));
      }
    }, values);
  }

  /** Drops a file of the given content on the page. */
  drop(name, bytes) {
    const base64 = Buffer.from(bytes).toString('base64');
    return this.page.evaluate(
      ([fileName, content]) => {
        const data = new DataTransfer();
        data.items.add(new File([Uint8Array.from(atob(content), (c) => c.charCodeAt(0))], fileName));
        for (const type of ['dragenter', 'dragover', 'drop']) {
          document.body.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
        }
      },
      [name, base64],
    );
  }

  /** What a view shows, as PNG, once it shows the same twice: without a graphics card frames take their time. */
  async picture(side) {
    for (let last = null, tries = 0; ; tries++) {
      // Whatever changed last is drawn in the next frame.
      await this.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      const picture = await this.at(`${side}-canvas`).screenshot();
      if (last?.equals(picture) || tries === 10) return picture;
      last = picture;
    }
  }

  /** How many distinct colors a view shows, and how much of it is not background. */
  async look(side) {
    const picture = await this.picture(side);
    return this.page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      const colors = new Set();
      let covered = 0;
      for (let k = 0; k < data.length; k += 4) {
        colors.add((data[k] << 16) | (data[k + 1] << 8) | data[k + 2]);
        if (data[k] < 240 || data[k + 1] < 240 || data[k + 2] < 240) covered += 4 / data.length;
      }
      return { colors: colors.size, covered };
    }, picture.toString('base64'));
  }

  /** Elements that stick out of the page sideways, or out of the view that they are in. */
  overflow() {
    return this.page.evaluate(async () => {
      // The plots follow their boxes in the next frame.
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      const width = document.documentElement.clientWidth;
      return [...document.body.querySelectorAll('*')]
        .filter((element) => {
          const { left, right, width: own } = element.getBoundingClientRect();
          const view = element.closest('.view')?.getBoundingClientRect() ?? { left: 0, right: width };
          return own > 0 && (left < view.left - 0.5 || right > view.right + 0.5);
        })
        .map((element) => element.outerHTML.slice(0, 80));
    });
  }
}
