import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, existsSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, inject, it } from 'vitest';
import { formats } from 'morse-smooth/files';
import { manifest, modules, others } from '../../scripts/lib/modules.mjs';
import { npm } from '../../scripts/lib/run.mjs';
import { namesOf } from './apps/names.js';
import { openPage, serveFolder } from './browser.js';

const root = fileURLToPath(new URL('../..', import.meta.url));
const installed = inject('installed');
const dist = join(installed, 'node_modules', 'morse-smooth', 'dist');
const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));

/** What use.js finds: a square of area 2 with a peak in the middle of a slope. */
const expected = {
  version,
  area: 2,
  before: { minima: 1, maxima: 1, saddles: expect.any(Number), indexSum: 1 },
  finite: true,
  code: 'IndexOutOfBounds',
};

const run = (...parameters) =>
  JSON.parse(execFileSync(process.execPath, parameters, { cwd: installed, encoding: 'utf8' }));

/** The size of a module's file. */
const sizeOf = (key) => readFileSync(join(dist, modules[key].wasm)).length;

/** What draw.js finds: the bytes of the picture, and so their sum, are the same everywhere. */
const drawn = {
  signature: 0x89504e47,
  size: [160, 120],
  sum: run('snapshot.mjs').sum,
  vertices: [0, 1, 2, 3, 4],
  code: 'UseAfterFree',
};

/** What read.js finds: the square of use.js, with its field. */
const read = {
  format: 'vtk',
  positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0],
  triangles: [0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1],
  heat: [5, 1, 2, 3, 4],
  column: [2, 4],
  formats: formats().length,
  code: 'UnknownColumn',
};

/** What remote.js finds, in a worker. */
const away = {
  vertices: 3600,
  euler: 1,
  stopped: 'AbortError',
  code: 'IndexOutOfBounds',
  formats: formats().length,
  png: true,
  closed: 'ConnectionClosed',
};

describe('the package', () => {
  it('holds what users need and nothing else', () => {
    expect(inject('packed')).toEqual([
      'CHANGELOG.md',
      'LICENSE-APACHE',
      'LICENSE-MIT',
      'README.md',
      'dist/cli.mjs',
      'dist/core-embedded.cjs',
      'dist/core-embedded.js',
      'dist/core.js',
      'dist/error.cjs',
      'dist/error.js',
      'dist/files-embedded.cjs',
      'dist/files-embedded.js',
      'dist/files-node.cjs',
      'dist/files-node.mjs',
      'dist/files.d.cts',
      'dist/files.d.ts',
      'dist/files.js',
      'dist/index.d.cts',
      'dist/index.d.ts',
      'dist/index.js',
      'dist/inline.d.cts',
      'dist/inline.d.ts',
      'dist/inline.js',
      'dist/morse-smooth-files.iife.js',
      'dist/morse-smooth-snapshot.iife.js',
      'dist/morse-smooth.iife.js',
      'dist/morse_smooth_bg.wasm',
      'dist/morse_smooth_files_bg.wasm',
      'dist/morse_smooth_snapshot_bg.wasm',
      'dist/node.cjs',
      'dist/node.mjs',
      'dist/snapshot-embedded.cjs',
      'dist/snapshot-embedded.js',
      'dist/snapshot-node.cjs',
      'dist/snapshot-node.mjs',
      'dist/snapshot.d.cts',
      'dist/snapshot.d.ts',
      'dist/snapshot.js',
      'dist/three.cjs',
      'dist/three.d.cts',
      'dist/three.d.ts',
      'dist/three.js',
      'dist/worker-embedded.js',
      'dist/worker-node-embedded.cjs',
      'dist/worker-node-embedded.js',
      'dist/worker-node.cjs',
      'dist/worker-node.mjs',
      'dist/worker-script-node.cjs',
      'dist/worker-script.d.cts',
      'dist/worker-script.d.ts',
      'dist/worker-script.js',
      'dist/worker.d.cts',
      'dist/worker.d.ts',
      'dist/worker.js',
      'package.json',
    ]);
  });

  it('says of each module what the table of modules says', () => {
    const written = JSON.parse(readFileSync(join(dist, '..', 'package.json'), 'utf8'));
    expect(written).toMatchObject(manifest());
    expect(written.exports).toEqual(manifest().exports);
  });

  it('has every file that package.json names', () => {
    const names = JSON.stringify(manifest()).match(/(\.\/)?dist\/[^"]*/g);
    for (const name of names.filter((name) => !name.includes('*')))
      expect(existsSync(join(dist, '..', name)), name).toBe(true);
  });

  // What needs other packages is in three.test.js.
  const alone = Object.values({ ...modules, ...others }).filter(({ external }) => !external);
  it.each(alone.map(({ entry }) => entry))('gives the same names to import and require: %s', (entry) => {
    const script = `import(${JSON.stringify(entry)}).then((names) => console.log(JSON.stringify(
      [names, require(${JSON.stringify(entry)})].map(${namesOf}))))`;
    const [imported, required] = run('--input-type=commonjs', '-e', script);
    expect(imported).toEqual(required);
    expect(imported).toContain('MorseSmoothError');
  });

  it('would be published without a warning', () => {
    const [command, parameters] = npm('publish', '--dry-run', '--ignore-scripts', '--tag', 'latest');
    const { status, stderr } = spawnSync(command, parameters, { cwd: root, encoding: 'utf8' });
    // About the settings of whoever runs this, not about the package.
    const warnings = stderr
      .split('\n')
      .filter((line) => /^npm (warn|error)/i.test(line) && !/ (user|env) config | logged in /.test(line));
    expect(warnings).toEqual([]);
    expect(status).toBe(0);
  });

  it('brings nothing along and runs nothing when it is installed', () => {
    const manifest = JSON.parse(readFileSync(join(dist, '..', 'package.json'), 'utf8'));
    expect(manifest.dependencies ?? manifest.optionalDependencies).toBeUndefined();
    for (const name of Object.keys(manifest.peerDependencies))
      expect(manifest.peerDependenciesMeta[name]).toEqual({ optional: true });
    const installScripts = ['preinstall', 'install', 'postinstall', 'prepare'];
    expect(Object.keys(manifest.scripts).filter((name) => installScripts.includes(name))).toEqual([]);
    expect(readdirSync(join(installed, 'node_modules')).filter((name) => !name.startsWith('.'))).toEqual([
      'morse-smooth',
    ]);
  });

  it('has no Node module, await at the top or eval in what browsers load', () => {
    for (const name of [
      'index.js',
      'core.js',
      'error.js',
      'files.js',
      'inline.js',
      'snapshot.js',
      'three.js',
      'worker.js',
      'worker-script.js',
    ]) {
      const source = readFileSync(join(dist, name), 'utf8');
      expect(source).not.toMatch(/node:|require\(|^await |\beval\(|new Function/m);
    }
  });

  it('says nothing of the machine that built it', () => {
    for (const name of readdirSync(dist)) {
      const content = readFileSync(join(dist, name), 'latin1');
      expect(content.match(/(\.cargo|\/home|\/root|\/Users)\/[\w./-]{0,80}/)?.[0], name).toBeUndefined();
    }
  });
});

describe('Node', () => {
  it('imports it', () => {
    expect(run('import.mjs')).toEqual({ ...expected, oneInstance: true });
  });

  it('requires it', () => {
    const names = ['MorseSmoothError', 'Smoother', 'SmoothingFamily', 'TriMesh', 'default', 'smooth', 'version'];
    expect(run('require.cjs')).toEqual({ ...expected, keys: names });
  });

  it('imports the inline entry', () => {
    expect(run('inline.mjs')).toEqual(expected);
  });

  it('imports the files, whose errors are of the same class', () => {
    expect(run('files.mjs')).toEqual({ ...read, oneInstance: true, oneError: true });
  });

  it('requires the files, and compiles each module when it is used, for its own entry only', () => {
    expect(run('files.cjs')).toEqual({
      ...read,
      keys: ['MorseSmoothError', 'default', 'formats', 'readField', 'readMesh', 'readTable', 'writeMesh'],
      imported: [],
      alone: [sizeOf('files')],
      both: [sizeOf('files'), sizeOf('core')],
    });
  });

  it('imports the pictures, whose errors are of the same class', () => {
    expect(run('snapshot.mjs')).toEqual({ ...drawn, oneInstance: true, oneError: true });
  });

  it('requires the pictures, and compiles each module when it is used, for its own entry only', () => {
    expect(run('snapshot.cjs')).toEqual({
      ...drawn,
      keys: ['MorseSmoothError', 'Scene', 'default', 'sheet', 'snapshot'],
      imported: [],
      alone: [sizeOf('snapshot')],
      both: [sizeOf('snapshot'), sizeOf('core')],
    });
  });

  it('imports and requires what makes workers', () => {
    expect(run('worker.mjs')).toEqual({ ...away, oneError: true, oneInstance: true });
  });

  it('finds the wasm files and package.json under their own names', () => {
    const wasm = Object.values(modules).map(({ wasm }) => wasm);
    const names = [...wasm, 'package.json'];
    const script = `console.log(JSON.stringify(${JSON.stringify(names)}.map((x) => require.resolve('morse-smooth/' + x))))`;
    expect(run('-e', script)).toEqual([...wasm.map((name) => join(dist, name)), join(dist, '..', 'package.json')]);
  });
});

describe('Chromium', () => {
  const resultOf = async (url) => {
    const { page, problems, close } = await openPage(url);
    try {
      await page.waitForFunction(() => globalThis.result !== undefined);
      expect(problems).toEqual([]);
      return await page.evaluate(() => globalThis.result);
    } finally {
      await close();
    }
  };
  const throughVite = {
    page: expected,
    inline: expected,
    file: read,
    picture: drawn,
    oneError: true,
    worker: expected,
    byteLength: readFileSync(join(dist, 'morse_smooth_bg.wasm')).length,
    remote: away,
  };
  const app = join(installed, 'vite');
  const common = { root: app, configFile: false, logLevel: 'error' };

  it('runs what Vite has built, a worker included', async () => {
    const { build, preview } = await import('vite');
    await build({ ...common, build: { outDir: 'built' } });
    const server = await preview({ ...common, build: { outDir: 'built' }, preview: { port: 0 } });
    try {
      expect(await resultOf(server.resolvedUrls.local[0])).toEqual(throughVite);
    } finally {
      await server.close();
    }
  });

  it("runs what Vite's development server serves", async () => {
    const { createServer } = await import('vite');
    const server = await createServer({ ...common, server: { port: 0 } });
    try {
      await server.listen();
      expect(await resultOf(server.resolvedUrls.local[0])).toEqual(throughVite);
    } finally {
      await server.close();
    }
  });

  it('runs it from a static server, without a bundler, MIME type for wasm or permission to eval', async () => {
    const headers = { 'content-security-policy': "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'" };
    const server = await serveFolder(installed, headers);
    try {
      const result = await resultOf(`${server.url}/static/index.html`);
      expect(result).toEqual({ page: expected, file: read, picture: drawn });
    } finally {
      await server.close();
    }
  });

  const strict = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self' blob:";
  it.each([
    ['with a strict content security policy', { 'content-security-policy': strict }, false],
    [
      'where memory is shared',
      { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' },
      true,
    ],
  ])('runs workers %s', async (_, headers, isolated) => {
    const server = await serveFolder(installed, headers);
    try {
      const url = `${server.url}/static/worker.html?dist=/node_modules/morse-smooth/dist`;
      expect(await resultOf(url)).toEqual({ ...away, isolated });
    } finally {
      await server.close();
    }
  });

  it('runs workers where their script and the modules are not found', async () => {
    const moved = join(installed, 'moved');
    cpSync(dist, moved, { recursive: true });
    const missing = ['worker-script.js', ...Object.values(modules).map(({ wasm }) => wasm)];
    for (const name of missing) rmSync(join(moved, name));
    const server = await serveFolder(installed);
    const { page, close } = await openPage(`${server.url}/static/worker.html?dist=/moved`);
    try {
      await page.waitForFunction(() => globalThis.result !== undefined);
      expect(await page.evaluate(() => globalThis.result)).toEqual({ ...away, isolated: false });
    } finally {
      await close();
      await server.close();
      rmSync(moved, { recursive: true });
    }
  });
});
