// npm run build: the wasm module into pkg/, the npm package's files into dist/.
import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { dirname, join, relative } from 'node:path';
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
    await unlessCurrent(join(pkg, WASM), wasmInputs(), () =>
      step('building the WebAssembly module, optimised (a minute or two from scratch)', buildWasm),
    );
    await unlessCurrent(join(dist, WASM), bundleInputs(), () => step('bundling the JavaScript into dist/', bundle));
  });
}

/** Makes `output`, unless it is there and was made from these very files. */
async function unlessCurrent(output, inputs, work) {
  const stamp = join(pkg, `${relative(root, dirname(output))}.sha256`);
  const hash = hashOf(inputs);
  if (existsSync(output) && existsSync(stamp) && readFileSync(stamp, 'utf8') === hash) return;
  rmSync(stamp, { force: true });
  await work();
  writeFileSync(stamp, hash);
}

/** Everything that the module is made from: cargo would notice a change, but wasm-opt would not notice that there is none. */
function wasmInputs() {
  const sources = readdirSync(inRoot('src'), { recursive: true }).filter((name) => name.endsWith('.rs'));
  const others = ['Cargo.toml', 'Cargo.lock', 'package-lock.json', join('scripts', 'build.mjs')];
  return [...others, ...sources.map((name) => join('src', name))];
}

function bundleInputs() {
  const sources = readdirSync(inRoot('src', 'js'), { recursive: true })
    .filter((name) => /\.(js|mjs|ts)$/.test(name))
    .map((name) => join('src', 'js', name));
  return ['package.json', join('pkg', WASM), join('scripts', 'build.mjs'), ...sources];
}

function hashOf(files) {
  const hash = createHash('sha256').update(ask('rustc', '--version') ?? '');
  for (const file of files.sort()) hash.update(`\0${file}\0`).update(readFileSync(inRoot(file)));
  return hash.digest('hex');
}

async function buildWasm() {
  const parameters = ['build', '--target', 'web', '--release', '--no-pack', '--no-gitignore'];
  parameters.push('--out-dir', pkg, '--out-name', 'morse_smooth', '--', '--features', 'wasm', '--locked');
  const { code, output } = await runWasmPack(parameters, { env: { RUSTFLAGS: rustFlags() } });
  if (code !== 0) throw new Problem(`${output}\nThe WebAssembly module does not build.`);
}

/**
 * SIMD for the sparse solver, which halves its time; little inlining, which only costs size where the source does not ask
 * for it; and the builder's folders kept out of the module, where panics name their places.
 */
const OPTIMISATION = ['-C target-feature=+simd128', '-C llvm-args=-inline-threshold=5'];

function rustFlags() {
  const cargoHome = process.env.CARGO_HOME || join(homedir(), '.cargo');
  const remap = [`--remap-path-prefix=${cargoHome}=/cargo`, `--remap-path-prefix=${root}=/morse-smooth`];
  return [process.env.RUSTFLAGS, ...OPTIMISATION, ...remap].filter(Boolean).join(' ');
}

/** The parts of the type declarations, in the order in which one reads them: one module in several files. */
const TYPES = ['package', 'files', 'mesh', 'field', 'smoothing'];

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
  // The same text for both kinds of module: TypeScript tells them apart by the file's name, and imports between the parts
  // would have to name files of either kind.
  const types = TYPES.map((name) => readFileSync(source(`types/${name}.d.ts`), 'utf8')).join('\n');
  for (const name of ['index.d.ts', 'index.d.cts']) writeFileSync(join(dist, name), types);
}

async function bundleOne(name, platform, output) {
  const { rolldown } = await import('rolldown');
  const { version } = JSON.parse(readFileSync(inRoot('package.json'), 'utf8'));
  const define = { __VERSION__: JSON.stringify(version) };
  try {
    const bundled = await rolldown({ input: source(name), platform, transform: { define } });
    await bundled.write(output);
    await bundled.close();
  } catch (error) {
    throw new Problem(`${error.message}\nThe JavaScript does not build.`);
  }
}

const source = (name) => inRoot('src', 'js', name);

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  await main(async () => {
    await setUp();
    await build();
  });
}
