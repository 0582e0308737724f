// How the modules come where they cannot be fetched, and where there are no modules at all.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { afterAll, describe, expect, inject, it } from 'vitest';
import { openPage, serveFolder } from './browser.js';

const installed = inject('installed');
const run = (cwd, ...parameters) => JSON.parse(execFileSync(process.execPath, parameters, { cwd, encoding: 'utf8' }));

/** What the app finds in Node: it is to find the same everywhere. */
const script = "import('./app.js').then(({ run }) => run(false)).then((result) => console.log(JSON.stringify(result)))";
const expected = run(installed, '-e', script);

/** What a page says: its result, and what the console said. */
async function said(url) {
  const { page, messages, problems, close } = await openPage(url);
  try {
    await page.waitForFunction(() => globalThis.result !== undefined);
    return { result: await page.evaluate(() => globalThis.result), messages, problems };
  } finally {
    await close();
  }
}

/** The same of a page in the folder of the package, whose server has these headers and may answer by itself. */
async function saidBy(page, headers, answer) {
  const server = await serveFolder(installed, headers, answer);
  try {
    return await said(`${server.url}/${page}`);
  } finally {
    await server.close();
  }
}

const app = (content) => `<!doctype html>
<meta charset="utf-8" />
<link rel="icon" href="data:," />
<script type="importmap">{ "imports": { ${['', '/files', '/snapshot']
  .map((part) => `"morse-smooth${part}": "/node_modules/morse-smooth/dist${part || '/index'}.js"`)
  .join(', ')} } }</script>
<script type="module">${content}</script>
`;

describe('where the file cannot be had', () => {
  writeFileSync(
    join(installed, 'twice.html'),
    app(`import init from 'morse-smooth';
import { run } from './app.js';
run().then(async (result) => {
  await init();
  globalThis.result = result;
}, (error) => (globalThis.result = String(error)));`),
  );
  const wasm = (answer) => (request, response) => {
    if (!request.url.endsWith('.wasm')) return false;
    answer(response);
    return true;
  };

  it.each([
    ['it is not there', (response) => response.writeHead(404).end(), 'the server answered 404 (no such file'],
    ['it may not be read', (response) => response.writeHead(403).end(), 'the server answered 403'],
    [
      'a page comes',
      (response) => response.writeHead(200, { 'content-type': 'text/html' }).end('<!doctype html>'),
      'a web page',
    ],
    [
      'a page comes that is said to be WebAssembly',
      (response) => response.writeHead(200, { 'content-type': 'application/wasm' }).end('<!doctype html>'),
      'could not be loaded',
    ],
    ['nothing comes', (response) => response.destroy(), 'there was no answer'],
    [
      'half of it comes',
      (response) => response.writeHead(200).end(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 1)),
      'could not be loaded',
    ],
  ])('a copy does, and the console says so once: %s', async (_, answer, why) => {
    const { result, messages } = await saidBy('twice.html', {}, wasm(answer));
    expect(result).toEqual(expected);
    const told = messages.filter((text) => text.startsWith('morse-smooth: '));
    expect(told).toHaveLength(3);
    for (const name of ['morse_smooth_bg.wasm', 'morse_smooth_files_bg.wasm', 'morse_smooth_snapshot_bg.wasm']) {
      const [text, ...more] = told.filter((text) => text.includes(`/dist/${name}`));
      expect(more).toEqual([]);
      expect(text).toContain(why);
      expect(text).toContain('The copy in a script');
    }
  });

  it('and the copy neither, the error names address, status and cause', async () => {
    const page = `import init from 'morse-smooth';
init().catch(({ code, message, detail }) => (globalThis.result = { code, message, detail }));`;
    writeFileSync(join(installed, 'fails.html'), app(page));
    const nowhere = (request, response) => {
      if (!/\.wasm$|embedded/.test(request.url)) return false;
      response.writeHead(404).end();
      return true;
    };
    const { result } = await saidBy('fails.html', {}, nowhere);
    expect(result).toMatchObject({ code: 'LoadFailed', detail: { status: 404 } });
    expect(result.detail.url).toContain('/dist/morse_smooth_bg.wasm');
    for (const part of [result.detail.url, '404', 'nor could the copy']) expect(result.message).toContain(part);

    // Inline scripts are needed by this page, not by the package.
    const policy = { 'content-security-policy': "default-src 'self'; script-src 'self' 'unsafe-inline'" };
    const refused = (await saidBy('fails.html', policy)).result;
    expect(refused).toMatchObject({ code: 'LoadFailed', detail: { status: 200 } });
    expect(refused.message).toContain("`script-src` needs 'wasm-unsafe-eval'");
  });
});

describe('without a bundler', () => {
  it('it comes from another origin by an import map', async () => {
    const other = await serveFolder(installed, { 'access-control-allow-origin': '*' });
    try {
      const page = join(installed, 'static', 'importmap.html');
      writeFileSync(page, readFileSync(page, 'utf8').replaceAll('ORIGIN', other.url));
      const { result, problems } = await saidBy('static/importmap.html');
      expect(result).toEqual(expected);
      expect(problems).toEqual([]);
    } finally {
      await other.close();
    }
  });

  it('classic scripts work in a page from a disk', async () => {
    const plain = ['use', 'read', 'draw'].map((name) =>
      readFileSync(join(installed, `${name}.js`), 'utf8').replaceAll(/^export /gm, ''),
    );
    writeFileSync(
      join(installed, 'classic-app.js'),
      `${plain.join('')}
const { files, snapshot: pictures } = MorseSmooth;
Promise.all([MorseSmooth.init(), files.init(), pictures.init()]).then(
  () => (globalThis.result = { page: use(MorseSmooth), file: read(files), picture: draw(pictures) }),
  (error) => (globalThis.result = String(error)),
);
`,
    );
    const { result, problems } = await said(pathToFileURL(join(installed, 'static', 'classic.html')).href);
    const { page, file, picture } = expected;
    expect(result).toEqual({ page, file, picture });
    expect(problems).toEqual([]);
  });
});

describe('bundled into one place', () => {
  const folder = mkdtempSync(join(tmpdir(), 'morse-smooth-bundled-'));
  afterAll(() => rmSync(folder, { recursive: true, force: true }));

  const bundle = async (content, options, output) => {
    const { rolldown } = await import('rolldown');
    const input = join(installed, 'entry.js');
    writeFileSync(input, content);
    const bundled = await rolldown({ input, cwd: installed, logLevel: 'silent', ...options });
    await bundled.write(output);
    await bundled.close();
  };

  it.each([
    ['esm', 'node.mjs'],
    ['cjs', 'node.cjs'],
  ])('it runs in Node without a file beside it: %s', async (format, name) => {
    const content =
      "import { run } from './app.js';\nrun(false).then((result) => console.log(JSON.stringify(result)));\n";
    await bundle(content, { platform: 'node' }, { file: join(folder, 'alone', name), format });
    expect(run(folder, join('alone', name))).toEqual(expected);
  });

  it('it runs in a browser with the copy in chunks of its own', async () => {
    const content = `import { run } from './app.js';
run().then((result) => (globalThis.result = result), (error) => (globalThis.result = String(error)));\n`;
    const place = join(folder, 'browser');
    mkdirSync(place);
    await bundle(content, { platform: 'browser' }, { dir: place, format: 'esm', minify: true });
    const page = '<!doctype html><link rel="icon" href="data:," /><script type="module" src="entry.js"></script>';
    writeFileSync(join(place, 'index.html'), page);
    expect(readFileSync(join(place, 'entry.js')).length).toBeLessThan(80_000);
    const server = await serveFolder(place);
    try {
      expect((await said(server.url)).result).toEqual(expected);
    } finally {
      await server.close();
    }
  });
});

describe('objects that are forgotten', () => {
  it('are collected in time', () => {
    const [tidy, forgetful] = ['tidy', 'forget'].map((how) => run(installed, 'forget.mjs', how));
    expect(forgetful.all).toBeLessThan(3 * tidy.all);
    // Measured 2.7; 35 where the garbage collector is left to itself.
    expect(forgetful.wasm).toBeLessThan(8 * tidy.wasm);
  });
});
