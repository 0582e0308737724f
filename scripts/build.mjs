// npm run build: the wasm modules into pkg/, the npm package's files into dist/.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { dirname, join, relative, sep } from 'node:path';
import { pathToFileURL } from 'node:url';
import { bundle } from './lib/bundle.mjs';
import { withLock } from './lib/lock.mjs';
import { Problem, main, step } from './lib/log.mjs';
import { cargoFeatures, isMadeFrom, modules } from './lib/modules.mjs';
import { dist, inRoot, pkg, root } from './lib/paths.mjs';
import { ask } from './lib/run.mjs';
import { runWasmPack } from './lib/wasm-pack.mjs';
import { setUp } from './setup.mjs';

/** Builds what is out of date. The set-up must have been done. */
export function build() {
  return withLock(inRoot('node_modules', '.build.lock'), async () => {
    for (const [name, module] of Object.entries(modules)) {
      await unlessCurrent(name, module.built, wasmInputs(name), () =>
        step(`building ${module.title}, optimised (a minute or two from scratch)`, () => buildWasm(module)),
      );
    }
    await unlessCurrent('dist', join(dist, modules.core.wasm), bundleInputs(), () =>
      step('bundling the JavaScript into dist/', bundle),
    );
  });
}

/** Makes `output`, unless it is there and was made from these very files. */
async function unlessCurrent(name, output, inputs, work) {
  const stamp = join(pkg, `${name}.sha256`);
  const hash = hashOf(inputs);
  if (existsSync(output) && existsSync(stamp) && readFileSync(stamp, 'utf8') === hash) return;
  rmSync(stamp, { force: true });
  mkdirSync(pkg, { recursive: true });
  await work();
  writeFileSync(stamp, hash);
}

/** Everything that a module is made from: cargo would notice a change, but wasm-opt would not notice that there is none. */
function wasmInputs(name) {
  const sources = readdirSync(inRoot('src'), { recursive: true }).filter(
    (file) => file.endsWith('.rs') && isMadeFrom(name, file.replaceAll(sep, '/')),
  );
  const others = ['Cargo.toml', 'Cargo.lock', 'package-lock.json', join('scripts', 'build.mjs')];
  return [...others, ...sources.map((file) => join('src', file))];
}

function bundleInputs() {
  const sources = readdirSync(inRoot('src', 'js'), { recursive: true })
    .filter((name) => /\.(js|mjs|ts)$/.test(name))
    .map((name) => join('src', 'js', name));
  const wasm = Object.values(modules).map(({ built }) => relative(root, built));
  const scripts = ['bundle.mjs', 'glue.mjs', 'looks.mjs', 'modules.mjs'].map((name) => join('scripts', 'lib', name));
  return ['package.json', ...scripts, ...wasm, ...sources];
}

function hashOf(files) {
  const hash = createHash('sha256').update(ask('rustc', '--version') ?? '');
  for (const file of files.sort()) hash.update(`\0${file}\0`).update(readFileSync(inRoot(file)));
  return hash.digest('hex');
}

/** Each module has a folder of its own, because wasm-pack optimises all that lie in its folder. */
async function buildWasm(module) {
  const { name, title, built } = module;
  const parameters = ['build', '--target', 'web', '--release', '--no-pack', '--no-gitignore'];
  parameters.push('--out-dir', dirname(built), '--out-name', name, '--', ...cargoFeatures(module), '--locked');
  const { code, output } = await runWasmPack(parameters, { env: { RUSTFLAGS: rustFlags() } });
  if (code !== 0) throw new Problem(`${output}\n${title} does not build.`);
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

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  await main(async () => {
    await setUp();
    await build();
  });
}
