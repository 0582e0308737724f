// The package beside three.js, which others bring along, and the example.
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, inject, it } from 'vitest';
import { namesOf } from './apps/names.js';
import { truth } from './apps/surface.js';
import { openPage, serveFolder } from './browser.js';

const root = fileURLToPath(new URL('../..', import.meta.url));
let folder;
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'morse-smooth-three-'));
  cpSync(inject('installed'), folder, { recursive: true });
  const [from, to] = [root, folder].map((place) => join(place, 'node_modules', 'three'));
  for (const part of ['package.json', 'build', join('examples', 'jsm', 'lines')])
    cpSync(join(from, part), join(to, part), { recursive: true });
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const run = (...parameters) =>
  JSON.parse(execFileSync(process.execPath, parameters, { cwd: folder, encoding: 'utf8' }));

describe('with three.js, the package', () => {
  it('asks for it, but not of those who do without', () => {
    const { peerDependencies, peerDependenciesMeta } = JSON.parse(
      readFileSync(join(inject('installed'), 'node_modules', 'morse-smooth', 'package.json'), 'utf8'),
    );
    expect(Object.keys(peerDependencies)).toEqual(['three']);
    expect(peerDependenciesMeta).toEqual({ three: { optional: true } });
  });

  it('gives the same names to import and require', () => {
    const script = `import('morse-smooth/three').then((names) => console.log(JSON.stringify(
      [names, require('morse-smooth/three')].map(${namesOf}))))`;
    const [imported, required] = run('--input-type=commonjs', '-e', script);
    expect(imported).toEqual(required);
    expect(imported).toContain('MorseSmoothError');
  });

  it('is imported in Node', () => {
    const script = "import { run } from './three.js'; console.log(JSON.stringify(await run(false)))";
    expect(run('--input-type=module', '-e', script)).toEqual({ ...truth, wide: 1 });
  });

  it('is required in Node', () => {
    expect(run('three.cjs')).toEqual(truth);
  });

  const resultOf = async (url) => {
    const { page, problems, messages, close } = await openPage(url);
    try {
      await page.waitForFunction(() => globalThis.result !== undefined);
      expect(problems).toEqual([]);
      // Two copies of three.js would say so.
      expect(messages.filter((text) => /three/i.test(text))).toEqual([]);
      return await page.evaluate(() => globalThis.result);
    } finally {
      await close();
    }
  };
  const common = () => ({ root: join(folder, 'vite-three'), configFile: false, logLevel: 'error' });

  it('runs in what Vite has built', async () => {
    const { build } = await import('vite');
    await build({ ...common(), build: { outDir: 'built' } });
    const server = await serveFolder(join(folder, 'vite-three', 'built'));
    try {
      expect(await resultOf(server.url)).toEqual({ ...truth, wide: 1 });
    } finally {
      await server.close();
    }
  });

  it("runs in what Vite's development server serves", async () => {
    const { createServer } = await import('vite');
    const server = await createServer({ ...common(), server: { port: 0 } });
    try {
      await server.listen();
      expect(await resultOf(server.resolvedUrls.local[0])).toEqual({ ...truth, wide: 1 });
    } finally {
      await server.close();
    }
  });
});

describe('the example', () => {
  it('shows a field under a slider, and what is pointed at', async () => {
    const server = await serveFolder(root);
    const { page, problems, close } = await openPage(`${server.url}/examples/three.html`);
    try {
      await page.waitForSelector('canvas');
      const read = async (right, down) => {
        await page.mouse.move(right, down);
        return page.locator('output').textContent();
      };
      const { width, height } = page.viewportSize();
      // A row of places, some of which are on the knot.
      const places = Array.from({ length: 12 }, (_, k) => [((k + 1) * width) / 13, 0.4 * height]);
      const told = async () => {
        const found = [];
        for (const place of places) found.push(await read(...place));
        return found;
      };
      const first = await told();
      expect(first.filter((text) => /^vertex \d+, value -?\d\.\d{3}$/.test(text)).length).toBeGreaterThan(2);
      // Left and right beyond it.
      expect([first[0], first.at(-1)]).toEqual(['', '']);
      await page.locator('input').fill('1');
      const second = await told();
      const vertexOf = (text) => text.split(',')[0];
      expect(second.map(vertexOf)).toEqual(first.map(vertexOf));
      expect(second).not.toEqual(first);
      expect(problems).toEqual([]);
    } finally {
      await close();
      await server.close();
    }
  });
});
