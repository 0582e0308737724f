// npm run build: the wasm module into pkg/, the npm package's files into dist/.
import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { withLock } from './lib/lock.mjs';
import { Problem, main, step } from './lib/log.mjs';
import { dist, inRoot, pkg, root } from './lib/paths.mjs';
import { ask } from './lib/run.mjs';
import { runWasmPack } from './lib/wasm-pack.mjs';
import { setUp } from './setup.mjs';

const WASM = 'morse_smooth_bg.wasm';

/** Builds what is out of date. The set-up must have been done. */
export function build() {
  return withLock(inRoot('node_modules', '.build.lock'), async () => {
    await buildWasm();
    await step('bundling the JavaScript into dist/', bundle);
  });
}

async function buildWasm() {
  const stamp = join(pkg, 'inputs.sha256');
  const inputs = hashOfInputs();
  if (existsSync(stamp) && readFileSync(stamp, 'utf8') === inputs) return;
  await step('building the WebAssembly module, optimised (a minute or two from scratch)', async () => {
    const parameters = ['build', '--target', 'web', '--release', '--no-pack', '--no-gitignore'];
    parameters.push('--out-dir', pkg, '--out-name', 'morse_smooth', '--', '--features', 'wasm', '--locked');
    const { code, output } = await runWasmPack(parameters, { env: { RUSTFLAGS: rustFlags() } });
    if (code !== 0) throw new Problem(`${output}\nThe WebAssembly module does not build.`);
  });
  writeFileSync(stamp, inputs);
}

/** Keeps the builder's folders out of the module, where panics name their places. */
function rustFlags() {
  const cargoHome = process.env.CARGO_HOME || join(homedir(), '.cargo');
  const remap = [`--remap-path-prefix=${cargoHome}=/cargo`, `--remap-path-prefix=${root}=/morse-smooth`];
  return [process.env.RUSTFLAGS, ...remap].filter(Boolean).join(' ');
}

/** Of everything that the module is made from: cargo would notice a change by itself, wasm-opt would not notice that there is none. */
function hashOfInputs() {
  const sources = readdirSync(inRoot('src'), { recursive: true }).filter((name) => name.endsWith('.rs'));
  const files = ['Cargo.toml', 'Cargo.lock', 'package-lock.json', ...sources.sort().map((name) => join('src', name))];
  const hash = createHash('sha256').update(ask('rustc', '--version') ?? '');
  for (const file of files) hash.update(`\0${file}\0`).update(readFileSync(inRoot(file)));
  return hash.digest('hex');
}

/** Two bundles with the glue in them, one for browsers and one for Node; the rest is copied as it is. */
async function bundle() {
  rmSync(dist, { recursive: true, force: true });
  mkdirSync(dist);
  await bundleOne('core.js', 'browser', { file: join(dist, 'core.js'), format: 'esm' });
  await bundleOne('node.js', 'node', { file: join(dist, 'node.cjs'), format: 'cjs', exports: 'named' });

  const wasm = readFileSync(join(pkg, WASM));
  writeFileSync(join(dist, WASM), wasm);
  writeFileSync(join(dist, 'wasm-base64.js'), `export default '${wasm.toString('base64')}';\n`);
  for (const name of ['index.js', 'inline.js', 'inline.d.ts', 'node.mjs']) copyFileSync(source(name), join(dist, name));
  // The same text for both kinds of module: TypeScript tells them apart by the file's name.
  for (const name of ['index.d.ts', 'index.d.cts']) copyFileSync(source('morse-smooth.d.ts'), join(dist, name));
}

async function bundleOne(name, platform, output) {
  const { rolldown } = await import('rolldown');
  const { version } = JSON.parse(readFileSync(inRoot('package.json'), 'utf8'));
  const define = { __VERSION__: JSON.stringify(version) };
  const bundled = await rolldown({ input: source(name), platform, transform: { define } });
  await bundled.write(output);
  await bundled.close();
}

const source = (name) => inRoot('src', 'js', name);

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  await main(async () => {
    await setUp();
    await build();
  });
}
