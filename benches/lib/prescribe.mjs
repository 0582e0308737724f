// A field with prescribed extrema beside the smoothed one, in a process of its own.
import { Smoother, TriMesh } from '../../dist/index.js';
import { Stopwatch } from './clock.mjs';
import { jitteredTorus, noisyField } from './jittered.mjs';
import { loadWithMemory } from './memory-size.mjs';

/** Which extrema there shall be: easy ones, more of them, and those of the noise. */
export const SETS = {
  smoothed: { from: 'persistence', threshold: 0.05 },
  more: { from: 'persistence', threshold: 0.001 },
  input: { from: 'persistence', minima: 8, maxima: 8, of: 'input' },
};

/** What smooths as much as 0.05 does on a mesh of 10,000 vertices. */
const epsilonFor = (size) => Number((0.05 * (10_000 / size) ** 2).toPrecision(2));

/** `only` names the one call whose memory is measured; without it all calls take turns and are timed. */
export async function run({ size, set, rounds, clock, only }) {
  const memory = await loadWithMemory();
  const { positions, triangles } = jitteredTorus(size);
  const values = noisyField(positions);
  const mesh = new TriMesh(positions, triangles);
  const epsilon = epsilonFor(size);
  const calls = {
    tikhonov: (smoother) => smoother.tikhonov(values, { epsilon }),
    preview: (smoother) => smoother.prescribe(values, { epsilon, extrema: SETS[set], preview: true }),
    prescribe: (smoother) => smoother.prescribe(values, { epsilon, extrema: SETS[set] }),
  };
  const found = {};
  const watch = new Stopwatch(clock);
  for (let round = 0; round < rounds; round++) {
    for (const [name, call] of Object.entries(calls)) {
      if (only && only !== name) continue;
      // Every call is the first one of its smoother: ordering and analysis are part of it.
      found[name] = watch.time(name, () => {
        const smoother = new Smoother(mesh);
        const result = call(smoother);
        smoother.free();
        return result;
      });
    }
  }
  // Memory of WebAssembly never shrinks: its size is its peak.
  const facts = { vertices: mesh.vertexCount, epsilon, peak: memory() };
  for (const name of ['preview', 'prescribe']) {
    if (found[name]) facts[name] = told(mesh, found[name]);
  }
  return { samples: watch.samples, facts };
}

/** What the result says of itself, and whether its extrema are the chosen ones. */
function told(mesh, result) {
  const { minima, maxima, energy, unconstrainedEnergy, iterations, solves, gap, leastSlack, values } = result;
  const { vertices, kinds } = mesh.criticalPoints(Float32Array.from(values));
  const of = (kind) => vertices.filter((_, k) => kinds[k] === kind).join();
  const exact = of(-1) === minima.join() && of(1) === maxima.join();
  const kept = [minima.length, maxima.length];
  return { kept, rise: energy / unconstrainedEnergy - 1, iterations, solves, gap, leastSlack, exact };
}
