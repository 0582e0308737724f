// The npm package's files in dist/.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { glueFactory } from './glue.mjs';
import { Problem } from './log.mjs';
import { modules } from './modules.mjs';
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
  for (const { bundles, copies, types, built, wasm } of Object.values(modules)) {
    for (const [output, entry] of Object.entries(bundles)) await bundleOne(join('entries', entry), output);
    for (const name of copies) copyFileSync(source('entries', name), join(dist, name));
    for (const [name, parts] of Object.entries(types)) writeTypes(name, parts);
    copyFileSync(built, join(dist, wasm));
  }
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
  const { rolldown } = await import('rolldown');
  const { version } = JSON.parse(readFileSync(inRoot('package.json'), 'utf8'));
  const define = { __VERSION__: JSON.stringify(version) };
  const kind = extname(output);
  const shared = {
    name: 'shared-error',
    resolveId: (id, importer) =>
      importer && /\/error\.js$/.test(id) ? { id: ERROR[kind], external: 'absolute' } : null,
  };
  const platform = kind === '.cjs' ? 'node' : 'browser';
  const format = kind === '.cjs' ? { format: 'cjs', exports: 'named' } : { format: 'esm' };
  try {
    const bundled = await rolldown({
      input: source(entry),
      platform,
      plugins: [shared, glueFactory],
      transform: { define },
    });
    await bundled.write({ file: join(dist, output), ...format });
    await bundled.close();
  } catch (problem) {
    throw new Problem(`${problem.message}\nThe JavaScript does not build.`);
  }
}

const source = (...parts) => inRoot('src', 'js', ...parts);
