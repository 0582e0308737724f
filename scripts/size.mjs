// The download sizes of the built package, and the limit that the core module must keep.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { brotliCompressSync } from 'node:zlib';
import { Problem, main } from './lib/log.mjs';
import { dist } from './lib/paths.mjs';

const CORE = 'morse_smooth_bg.wasm';
/**
 * Bytes, brotli at its best: 36 kB for the sparse solver, 32 kB for persistence, Morse complex and the like, 29 kB for constraints,
 * filters and the intrinsic Delaunay Laplacian, 120 kB for all else.
 */
const LIMIT = 218_000;

/** Prints the sizes; fails when the core module is too large. */
export function checkSize() {
  const names = readdirSync(dist).filter((name) => /\.(wasm|js|cjs|mjs)$/.test(name));
  for (const name of names.sort()) {
    const bytes = readFileSync(join(dist, name));
    const [raw, compressed] = [bytes.length, brotliCompressSync(bytes).length].map(
      (size) => `${(size / 1000).toFixed(1)} kB`,
    );
    console.log(`${name.padEnd(24)}${raw.padStart(12)}${compressed.padStart(12)} brotli`);
  }
  const core = brotliCompressSync(readFileSync(join(dist, CORE))).length;
  if (core > LIMIT) throw new Problem(`${CORE} is ${core} bytes with brotli; the limit is ${LIMIT}.`);
  return { passed: 1, failed: 0 };
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) await main(async () => checkSize());
