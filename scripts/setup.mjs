// Brings what the commands need to a fresh machine: once, into places that later runs use again.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { withLock } from './lib/lock.mjs';
import { Problem, say, step } from './lib/log.mjs';
import { cache, inRoot } from './lib/paths.mjs';
import { ask, atLeast, must, npm, versionIn } from './lib/run.mjs';
import { findWasmPack } from './lib/wasm-pack.mjs';

/** What Vite and Playwright need. */
const NODE = [20, 19];

/** Everything that building needs; says in one line what there is. */
export async function setUp() {
  checkNode();
  const rust = checkRust();
  const wasmPack = await withLock(join(cache, 'set-up.lock'), async () => {
    await installPackages();
    await addTarget();
    return findWasmPack();
  });
  say(`Node ${process.versions.node}, Rust ${rust}, wasm-pack ${wasmPack}: ready`);
}

function checkNode() {
  if (!atLeast(versionIn(process.versions.node), NODE)) {
    throw new Problem(
      `Node ${NODE.join('.')} or newer is needed; this is ${process.versions.node}. Get one from https://nodejs.org`,
    );
  }
}

function checkRust() {
  const want = /^rust-version = "(.*)"$/m.exec(readFileSync(inRoot('Cargo.toml'), 'utf8'))[1];
  const have = ask('rustc', '--version');
  if (have === null || ask('cargo', '--version') === null) {
    throw new Problem(
      `Rust ${want} or newer is needed. Get it from https://rustup.rs, open a new terminal and run this again.`,
    );
  }
  if (!atLeast(versionIn(have), versionIn(want))) {
    throw new Problem(
      `Rust ${want} or newer is needed; this is ${versionIn(have).join('.')}. Run \`rustup update stable\`.`,
    );
  }
  return versionIn(have).join('.');
}

async function installPackages() {
  if (packagesAreCurrent()) return;
  const [command, parameters] = npm('ci', '--no-audit', '--no-fund', '--loglevel=error');
  await step('installing the development packages from npm (250 MB unpacked; about 20 s)', () =>
    must(command, parameters, 'npm could not install the development packages: is there a network connection?'),
  );
}

/** Whether node_modules holds the versions that the lock file names. */
function packagesAreCurrent() {
  const installed = inRoot('node_modules', '.package-lock.json');
  if (!existsSync(installed)) return false;
  const wanted = JSON.parse(readFileSync(inRoot('package-lock.json'), 'utf8')).packages;
  const present = JSON.parse(readFileSync(installed, 'utf8')).packages;
  return Object.entries(wanted).every(
    ([path, { version, optional }]) =>
      path === '' || (optional && !present[path]) || present[path]?.version === version,
  );
}

async function addTarget() {
  const target = 'wasm32-unknown-unknown';
  const folder = ask('rustc', '--print', 'target-libdir', '--target', target);
  if (folder !== null && existsSync(folder)) return;
  const advice = `Rust's target ${target} is needed. Install it the way Rust was installed (with rustup: rustup target add ${target}).`;
  if (ask('rustup', '--version') === null) throw new Problem(advice);
  await step(`adding Rust's target ${target} (a small download)`, () =>
    must('rustup', ['target', 'add', target], advice),
  );
}
