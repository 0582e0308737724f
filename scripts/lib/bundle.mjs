// The npm package's files in dist/.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Problem } from './log.mjs';
import { dist, inRoot, modules } from './paths.mjs';

/** The parts of the main entry's type declarations, in the order in which one reads them: one module in several files. */
const TYPES = ['package', 'files', 'mesh', 'field', 'smoothing'];

const ERROR = './error.js';

/**
 * For each module a bundle for browsers and one for Node, with the glue in them; the rest is copied as it is. The class of errors
 * has a file of its own, so that it is the same in all entries.
 */
export async function bundle() {
  rmSync(dist, { recursive: true, force: true });
  mkdirSync(dist);
  await bundleBoth('error.js', 'error.js', 'error.cjs');
  await bundleBoth('core.js', 'core.js');
  await bundleBoth('node.js', null, 'node.cjs');
  await bundleBoth('snapshot/index.js', 'snapshot.js');
  await bundleBoth('snapshot/node.js', null, 'snapshot-node.cjs');
  for (const name of ['index.js', 'inline.js', 'inline.d.ts', 'node.mjs']) copyFileSync(source(name), join(dist, name));
  copyFileSync(source('snapshot/node.mjs'), join(dist, 'snapshot-node.mjs'));

  for (const { built, wasm } of Object.values(modules)) copyFileSync(built, join(dist, wasm));
  const base64 = readFileSync(modules.core.built).toString('base64');
  writeFileSync(join(dist, 'wasm-base64.js'), `export default '${base64}';\n`);

  writeTypes('index', TYPES.map((name) => read(`types/${name}.d.ts`)).join('\n'));
  writeTypes('snapshot', read('types/snapshot.d.ts'));
}

/** The same text for both kinds of module, but for the names of files: TypeScript tells them apart by these. */
function writeTypes(name, types) {
  writeFileSync(join(dist, `${name}.d.ts`), types);
  writeFileSync(join(dist, `${name}.d.cts`), types.replaceAll("'./index.js'", "'./index.cjs'"));
}

/** Bundles one file as `esm`, for browsers, and as `cjs`, for Node, or as one of the two. */
async function bundleBoth(name, esm, cjs) {
  if (esm) await bundleOne(name, 'browser', ERROR, { file: join(dist, esm), format: 'esm' });
  if (cjs) await bundleOne(name, 'node', './error.cjs', { file: join(dist, cjs), format: 'cjs', exports: 'named' });
}

/** Leaves `error` out of the bundle. */
async function bundleOne(name, platform, error, output) {
  const { rolldown } = await import('rolldown');
  const { version } = JSON.parse(readFileSync(inRoot('package.json'), 'utf8'));
  const define = { __VERSION__: JSON.stringify(version) };
  const shared = {
    name: 'shared-error',
    resolveId: (id, importer) => (importer && /\/error\.js$/.test(id) ? { id: error, external: 'absolute' } : null),
  };
  try {
    const bundled = await rolldown({ input: source(name), platform, plugins: [shared], transform: { define } });
    await bundled.write(output);
    await bundled.close();
  } catch (problem) {
    throw new Problem(`${problem.message}\nThe JavaScript does not build.`);
  }
}

const source = (name) => inRoot('src', 'js', name);
const read = (name) => readFileSync(source(name), 'utf8');
