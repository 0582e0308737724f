// Where things are. Only Node's own modules may be imported by what runs before `npm ci`.
import { homedir } from 'node:os';
import { delimiter, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../../', import.meta.url)).replace(/[\\/]$/, '');
export const inRoot = (...parts) => join(root, ...parts);

/** Tools that later runs, of any checkout, use again. */
export const cache = join(process.env.XDG_CACHE_HOME || join(homedir(), '.cache'), 'morse-smooth');

export const pkg = inRoot('pkg');
export const dist = inRoot('dist');
export const artifacts = inRoot('artifacts');

const isWindows = process.platform === 'win32';
export const executable = (name) => (isWindows ? `${name}.exe` : name);

/** Directories searched before the caller's PATH: wasm-opt comes from the binaryen package, wasm-pack from the cache. */
const toolFolders = [
  inRoot('node_modules', '.bin'),
  join(cache, 'cargo', 'bin'),
  join(cache, 'npm', 'node_modules', '.bin'),
  join(process.env.CARGO_HOME || join(homedir(), '.cargo'), 'bin'),
];

/** The environment of every command that the scripts run. */
export const environment = {
  ...process.env,
  PATH: [...toolFolders, process.env.PATH].join(delimiter),
  WASM_PACK_CACHE: process.env.WASM_PACK_CACHE || join(cache, 'wasm-pack'),
};
