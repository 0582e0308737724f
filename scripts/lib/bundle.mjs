// The npm package's files in dist/.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { glueFactory } from './glue.mjs';
import { Problem } from './log.mjs';
import { modules, others } from './modules.mjs';
import { dist, inRoot } from './paths.mjs';

/** The class of errors has a file of its own, so that it is the same in all entries; it is left out of the other bundles. */
const ERROR = { '.js': './error.js', '.cjs': './error.cjs' };

/**
 * For each module a bundle for browsers and one for Node, with the glue in them, and what is copied as it is: the table in
 * `modules.mjs` says what.
 */
export async function bundle() {
  rmSync(dist, { recursive: true, force: true });
  mkdirSync(dist);
  for (const output of Object.values(ERROR)) await bundleOne(join('runtime', 'error.js'), output);
  for (const { bundles, copies, types } of Object.values({ ...modules, ...others })) {
    for (const [output, entry] of Object.entries(bundles)) await bundleOne(join('entries', entry), output);
    for (const name of copies) copyFileSync(source('entries', name), join(dist, name));
    for (const [name, parts] of Object.entries(types)) writeTypes(name, parts);
  }
  for (const { standalone, embedded } of Object.values(others)) {
    for (const [output, entry] of Object.entries(standalone)) await bundleAlone(entry, output);
    for (const [output, entry] of Object.entries(embedded)) await embed(entry, output);
  }
  for (const { built, wasm } of Object.values(modules)) copyFileSync(built, join(dist, wasm));
  const base64 = readFileSync(modules.core.built).toString('base64');
  writeFileSync(join(dist, 'wasm-base64.js'), `export default '${base64}';\n`);
}

/** One module in several files. The text is the same for both kinds of script but for names of files, by which TypeScript tells them. */
function writeTypes(name, parts) {
  const types = parts.map((part) => readFileSync(source('types', `${part}.d.ts`), 'utf8')).join('\n');
  writeFileSync(join(dist, `${name}.d.ts`), types);
  writeFileSync(join(dist, `${name}.d.cts`), types.replaceAll("'./index.js'", "'./index.cjs'"));
}

/** Bundles a file of src/js: for browsers as `.js`, for Node as `.cjs`. */
async function bundleOne(entry, output) {
  const kind = extname(output);
  const shared = {
    name: 'shared-error',
    resolveId: (id, importer) =>
      importer && /\/error\.js$/.test(id) ? { id: ERROR[kind], external: 'absolute' } : null,
  };
  const files = {
    name: 'files-of-dist',
    resolveId: (id) => (LATER.test(id) ? { id, external: 'absolute' } : null),
  };
  const format = kind === '.cjs' ? { format: 'cjs', exports: 'named' } : { format: 'esm' };
  await write(entry, kind, [shared, files], { ...format, file: join(dist, output) });
}

/** What scripts import when they need it, as it lies in dist/. */
const LATER = /^\.\/(wasm-base64\.js|worker-embedded\.js|worker-embedded-node\.cjs)$/;

/** Bundles a script that shares nothing with others, so that it is one file wherever it is. */
async function bundleAlone(entry, output, more = {}) {
  const kind = extname(output);
  await write(join('entries', entry), kind, [], {
    format: kind === '.cjs' ? 'cjs' : 'esm',
    file: join(dist, output),
    ...more,
  });
}

/** The same as a text that a script exports; a classic script for browsers. */
async function embed(entry, output) {
  const isNode = extname(output) === '.cjs';
  await bundleAlone(entry, output, { minify: true, ...(isNode ? {} : { format: 'iife' }) });
  const text = JSON.stringify(readFileSync(join(dist, output), 'utf8'));
  writeFileSync(join(dist, output), isNode ? `module.exports = ${text};\n` : `export default ${text};\n`);
}

async function write(entry, kind, plugins, output) {
  const { rolldown } = await import('rolldown');
  const { version } = JSON.parse(readFileSync(inRoot('package.json'), 'utf8'));
  const define = { __VERSION__: JSON.stringify(version) };
  try {
    const bundled = await rolldown({
      input: source(entry),
      platform: kind === '.cjs' ? 'node' : 'browser',
      plugins: [...plugins, glueFactory],
      transform: { define },
    });
    await bundled.write(output);
    await bundled.close();
  } catch (problem) {
    throw new Problem(`${problem.message}\nThe JavaScript does not build.`);
  }
}

const source = (...parts) => inRoot('src', 'js', ...parts);
