// npm run lint: formatting, lints and types of everything. npm run format (--fix): puts the formatting right.
import { existsSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { Problem, main } from './lib/log.mjs';
import { cargoFeatures, modules } from './lib/modules.mjs';
import { inRoot } from './lib/paths.mjs';
import { ask, must } from './lib/run.mjs';
import { runChecks } from './lib/sections.mjs';
import { build } from './build.mjs';
import { setUp } from './setup.mjs';

const node = process.execPath;
const prettier = inRoot('node_modules', 'prettier', 'bin', 'prettier.cjs');
const tsc = inRoot('node_modules', 'typescript', 'bin', 'tsc');
const PEERS = inRoot('benches', 'peers', 'src', 'lib.rs');
const WASM = ['--target', 'wasm32-unknown-unknown'];

export const lints = [
  { name: 'cargo fmt', command: 'cargo', parameters: ['fmt', '--check'] },
  // No part of the package, so `cargo fmt` passes it by.
  { name: 'rustfmt, benches/peers', command: 'rustfmt', parameters: ['--edition', '2024', '--check', PEERS] },
  { name: 'cargo clippy', command: 'cargo', parameters: clippy('--all-targets', '--features', 'render') },
  ...Object.values(modules).map((module) => ({
    name: `cargo clippy, ${module.feature}`,
    command: 'cargo',
    parameters: clippy(...WASM, ...cargoFeatures(module)),
  })),
  {
    name: 'rustdoc, its links',
    command: 'cargo',
    parameters: ['rustdoc', '--quiet', '--locked', '--lib', '--features', 'render,serde', '--', '--deny', 'warnings'],
  },
  { name: 'prettier', command: node, parameters: [prettier, '--check', '--log-level=warn', '.'] },
];

/** Projects of the TypeScript compiler; they need the built package. */
export const typeChecks = ['tests/types', 'tests/types/bare', 'www']
  .filter((folder) => existsSync(inRoot(folder, 'tsconfig.json')))
  .map((folder) => ({ name: `tsc, ${folder}`, command: node, parameters: [tsc, '--project', inRoot(folder)] }));

function clippy(...more) {
  return ['clippy', '--quiet', '--locked', ...more, '--', '--deny', 'warnings'];
}

/** rustup installs them by default, a distribution may not. */
export function checkLinters() {
  if (ask('cargo', 'clippy', '--version') === null || ask('cargo', 'fmt', '--version') === null) {
    throw new Problem("Rust's clippy and rustfmt are needed. With rustup: rustup component add clippy rustfmt");
  }
}

async function fix() {
  await must('cargo', ['fmt'], 'cargo fmt failed.', { show: true });
  await must('rustfmt', ['--edition', '2024', PEERS], 'rustfmt failed.', { show: true });
  await must(node, [prettier, '--write', '--log-level=warn', '.'], 'prettier failed.', { show: true });
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  await main(async () => {
    await setUp();
    checkLinters();
    if (process.argv.includes('--fix')) return fix();
    await build();
    const { failed } = await runChecks([...lints, ...typeChecks]);
    if (failed) throw new Problem(`${failed} of the checks failed. \`npm run format\` puts formatting right.`);
  });
}
