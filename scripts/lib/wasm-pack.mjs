// wasm-pack, and through it wasm-bindgen.
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { withLock } from './lock.mjs';
import { Problem, say, step } from './log.mjs';
import { cache, environment, inRoot } from './paths.mjs';
import { ask, atLeast, execute, must, npm, versionIn } from './run.mjs';

/** First version that knows the wasm-bindgen options of Cargo.toml, and the ones that are installed here. */
const OLDEST = [0, 13, 1];
const FROM_NPM = '0.15.0';
const FROM_SOURCE = '0.15.1';

/** Longest wait for the prebuilt program, in seconds. */
const DOWNLOAD_LIMIT = 90;

/** The version of the wasm-pack that will be used; installs one where there is none. */
export async function findWasmPack() {
  return present() ?? (await prebuilt()) ?? (await compiled());
}

function present() {
  const have = versionIn(ask('wasm-pack', '--version'));
  return atLeast(have, OLDEST) ? have.join('.') : null;
}

/** The npm package downloads a program that is ready to run, where its download can be reached. */
function prebuilt() {
  const folder = join(cache, 'npm');
  return step('looking for a prebuilt wasm-pack (once)', async () => {
    mkdirSync(folder, { recursive: true });
    const [command, parameters] = npm('install', '--prefix', folder, '--no-save', '--silent', `wasm-pack@${FROM_NPM}`);
    const { code } = await execute(command, parameters, { limit: DOWNLOAD_LIMIT, cwd: folder });
    const version = code === 0 ? present() : null;
    if (version === null) rmSync(folder, { recursive: true, force: true });
    return version;
  });
}

function compiled() {
  const folder = join(cache, 'cargo');
  return step('there is none: compiling wasm-pack from source (about 3 minutes on two cores, once)', async () => {
    await must(
      'cargo',
      ['install', 'wasm-pack', '--version', FROM_SOURCE, '--locked', '--root', folder],
      'wasm-pack could not be compiled: a C compiler and linker and a network connection are needed.',
      { env: { CARGO_TARGET_DIR: join(folder, 'build') } },
    );
    rmSync(join(folder, 'build'), { recursive: true, force: true });
    const version = present();
    if (version === null) throw new Problem(`wasm-pack was compiled into ${folder} but does not run.`);
    return version;
  });
}

/** Runs wasm-pack. The first run for each version of wasm-bindgen also installs that; two runs must not do so at once. */
export async function runWasmPack(parameters, options) {
  const lock = readFileSync(inRoot('Cargo.lock'), 'utf8');
  const version = /name = "wasm-bindgen"\nversion = "(.*)"/.exec(lock)[1];
  const stamp = join(environment.WASM_PACK_CACHE, `wasm-bindgen-${version}.installed`);
  const run = () => execute('wasm-pack', parameters, options);
  if (existsSync(stamp)) return run();
  return withLock(join(cache, 'set-up.lock'), async () => {
    if (!existsSync(stamp)) {
      say(`wasm-pack fetches wasm-bindgen ${version}, or compiles it (about 4 minutes on two cores, once)`);
    }
    const result = await run();
    mkdirSync(environment.WASM_PACK_CACHE, { recursive: true });
    if (result.code === 0) writeFileSync(stamp, '');
    return result;
  });
}
