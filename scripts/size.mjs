// The download sizes of the built package, and the limits that the modules must keep.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { brotliCompressSync } from 'node:zlib';
import { Problem, main } from './lib/log.mjs';
import { modules } from './lib/modules.mjs';
import { dist } from './lib/paths.mjs';

/** Prints the sizes; fails when a module is too large. */
export function checkSize() {
  const names = readdirSync(dist).filter((name) => /\.(wasm|js|cjs|mjs)$/.test(name));
  const compressed = {};
  for (const name of names.sort()) {
    const bytes = readFileSync(join(dist, name));
    compressed[name] = brotliCompressSync(bytes).length;
    const [raw, small] = [bytes.length, compressed[name]].map((size) => `${(size / 1000).toFixed(1)} kB`);
    console.log(`${name.padEnd(32)}${raw.padStart(12)}${small.padStart(12)} brotli`);
  }
  const problems = Object.values(modules).flatMap(({ wasm, limit }) => {
    const size = compressed[wasm];
    return size > limit ? [`${wasm} is ${size} bytes with brotli; the limit is ${limit}.`] : [];
  });
  if (problems.length > 0) throw new Problem(problems.join('\n'));
  return { passed: Object.keys(modules).length, failed: 0 };
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) await main(async () => checkSize());
