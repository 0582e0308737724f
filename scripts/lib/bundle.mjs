// The npm package's files in dist/.
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { deflateSync } from 'node:zlib';
import { glueFactory } from './glue.mjs';
import { Problem } from './log.mjs';
import { looks } from './looks.mjs';
import { modules, others } from './modules.mjs';
import { dist, inRoot } from './paths.mjs';

/** The class of errors has a file of its own, so that it is the same in all entries; it is left out of the other bundles. */
const ERROR = { '.js': './error.js', '.cjs': './error.cjs', '.mjs': './error.js' };

/** What a file in dist/ is, by how its name ends. */
const KINDS = {
  '.js': { platform: 'browser', format: 'esm' },
  '.mjs': { platform: 'node', format: 'esm' },
  '.cjs': { platform: 'node', format: 'cjs', exports: 'named' },
};

/**
 * For each module its entries, with the glue in them, its file, and the copy of that in a script; the table in `modules.mjs` says
 * which. The error's class is in a file of its own, but for scripts that are a file each.
 */
export async function bundle() {
  rmSync(dist, { recursive: true, force: true });
  mkdirSync(dist);
  for (const kind of ['.js', '.cjs']) await bundleBeside(join('runtime', 'error-class.js'), ERROR[kind]);
  for (const [key, module] of Object.entries(modules)) {
    copyFileSync(module.built, join(dist, module.wasm));
    embed(key, module);
    for (const [output, entry] of Object.entries(module.bundles)) await bundleOne(join('entries', entry), output, key);
  }
  for (const { bundles, external, standalone = {}, embedded = {} } of Object.values(others)) {
    for (const [output, entry] of Object.entries(bundles)) await bundleBeside(join('entries', entry), output, external);
    for (const [output, entry] of Object.entries(standalone)) await bundleAlone(join('entries', entry), output);
    for (const [name, output] of Object.entries(embedded)) await embedScript(name, output, standalone[output]);
  }
  for (const { types } of [...Object.values(modules), ...Object.values(others)]) {
    for (const [name, parts] of Object.entries(types)) writeTypes(name, parts);
  }
}

/** The module's file as text in a script, for those that cannot fetch it. */
function embed(key, { built }) {
  const text = deflateSync(readFileSync(built), { level: 9, memLevel: 9 }).toString('base64');
  writeFileSync(join(dist, `${key}-embedded.js`), `export const packed = '${text}';\n`);
  writeFileSync(join(dist, `${key}-embedded.cjs`), `exports.packed = '${text}';\n`);
}

/** One module in several files. The text is the same for both kinds of script but for names of files, by which TypeScript tells them. */
function writeTypes(name, parts) {
  const types = parts.map((part) => readFileSync(source('types', `${part}.d.ts`), 'utf8')).join('\n');
  writeFileSync(join(dist, `${name}.d.ts`), types);
  writeFileSync(join(dist, `${name}.d.cts`), types.replace(/'(\.\/\w+)\.js'/g, "'$1.cjs'"));
}

/** Bundles an entry of a module; the name of the output says for whom. */
async function bundleOne(entry, output, key) {
  const isClassic = output.endsWith('.iife.js');
  const { platform, ...format } = KINDS[extname(output)];
  const plugins = [...(isClassic ? [] : [sharedError(ERROR[extname(output)])]), parts(key, output)];
  const classic = { format: 'iife', name: modules[key].global, extend: true };
  const written = { file: join(dist, output), ...(isClassic ? classic : format) };
  await write(entry, platform, plugins, written, modules[key].wasm);
}

/** Bundles an entry without a module of its own. One that imports the main entry by its name has the error's class from there. */
async function bundleBeside(entry, output, external = []) {
  const { platform, ...format } = KINDS[extname(output)];
  const main = external.find((id) => id === modules.core.entry);
  const plugins = [sharedError(main ?? ERROR[extname(output)]), embeddedFor(output), looks, leftOutside(external)];
  await write(entry, platform, plugins, { file: join(dist, output), ...format });
}

/** Bundles a script that shares nothing with others, so that it is one file wherever it is. */
async function bundleAlone(entry, output, more = {}) {
  const { platform, ...format } = KINDS[extname(output)];
  await write(entry, platform, [], { file: join(dist, output), ...format, ...more });
}

/** Such a script as text in scripts, as classic a script as its platform has. */
async function embedScript(name, output, entry) {
  const isNode = extname(output) === '.cjs';
  const file = join(dist, `${name}-embedded.js`);
  await bundleAlone(join('entries', entry), output, { file, minify: true, ...(isNode ? {} : { format: 'iife' }) });
  const text = JSON.stringify(readFileSync(file, 'utf8'));
  writeFileSync(file, `export const script = ${text};\n`);
  if (isNode) writeFileSync(join(dist, `${name}-embedded.cjs`), `exports.script = ${text};\n`);
}

async function write(entry, platform, plugins, output, wasm) {
  const { rolldown } = await import('rolldown');
  const { version } = JSON.parse(readFileSync(inRoot('package.json'), 'utf8'));
  const define = { __VERSION__: JSON.stringify(version), __WASM__: JSON.stringify(`./${wasm}`) };
  try {
    const bundled = await rolldown({
      input: source(entry),
      platform,
      plugins: [...plugins, glueFactory],
      transform: { define },
    });
    await bundled.write(output);
    await bundled.close();
  } catch (problem) {
    throw new Problem(`${problem.message}\nThe JavaScript does not build.`);
  }
}

/** Leaves the error's class in `place`. */
const sharedError = (place) => ({
  name: 'shared-error',
  resolveId: (id, importer) => (importer && /\/error-class\.js$/.test(id) ? { id: place, external: 'absolute' } : null),
});

/** Leaves other packages, and what is in them, to whoever uses this one. */
const leftOutside = (packages) => ({
  name: 'left-outside',
  resolveId: (id) =>
    packages.some((name) => id === name || id.startsWith(`${name}/`)) ? { id, external: true } : null,
});

/** What the entries import of the module that they are bundled for: `this:api`, `this:module`, `this:shared`, `this:embedded`. */
function parts(key, output) {
  const { shared } = modules[key];
  const kind = extname(output) === '.cjs' ? '.cjs' : '.js';
  const outside = (id) => ({ id: `./${id}`, external: 'absolute' });
  const places = {
    'this:api': source('api', key, 'index.js'),
    'this:module': source('api', key, 'module.js'),
    'this:shared': shared ? outside(shared) : source('entries', 'api.js'),
    'this:embedded': output.endsWith('.iife.js') ? join(dist, `${key}-embedded.js`) : outside(`${key}-embedded${kind}`),
  };
  return { name: 'parts', resolveId: (id) => places[id] ?? null };
}

/** What entries without a module import of what is embedded, by its name: `embedded:core`. */
function embeddedFor(output) {
  const kind = extname(output) === '.cjs' ? '.cjs' : '.js';
  const placeOf = (id) => ({ id: id.replace('embedded:', './') + `-embedded${kind}`, external: 'absolute' });
  return { name: 'embedded', resolveId: (id) => (id.startsWith('embedded:') ? placeOf(id) : null) };
}

const source = (...parts) => inRoot('src', 'js', ...parts);
