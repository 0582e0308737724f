// One factorisation and solution in a fresh instance: whether it fits, and how far its memory grew.
import { Stopwatch } from './clock.mjs';
import { instantiate } from './peers.mjs';

export async function run({ wasm, mesh, size, system, bits, clock }) {
  const watch = new Stopwatch(clock);
  const instance = await instantiate(wasm, mesh, size);
  instance.system(system);
  const before = instance.bytes();
  watch.time('order', () => instance.ours_order());
  const nonzeros = watch.time('analyse', () => instance.ours_analyze());
  if (watch.time('factor', () => instance.ours_factor(bits)) === 0) {
    throw new Error('not positive definite to that precision');
  }
  const sum = watch.time('solve1', () => instance.ours_solve(1));
  if (!Number.isFinite(sum)) throw new Error('the solution is not finite');
  // Memory of WebAssembly never shrinks: its size at the end is its peak.
  const facts = { vertices: instance.vertices, nonzeros, before, peak: instance.bytes() };
  return { samples: watch.samples, facts };
}
