// Times of every stage of every solver on one mesh, taking turns.
import { join } from 'node:path';
import { Stopwatch } from './clock.mjs';
import { runCholmod, writeSystem } from './cholmod.mjs';
import { instantiate } from './peers.mjs';

/** Shifts of the complex system with which refinement of single precision is timed. */
export const SHIFTS = [1, 1e-4];

export async function run({ wasm, simd, mesh, size, systems, rounds, clock, withCsc, cholmod, folder }) {
  const watch = new Stopwatch(clock);
  const facts = {};
  const cases = [];
  for (const system of systems) {
    const instance = await instantiate(wasm, mesh, size);
    facts.vertices = instance.vertices;
    facts[`${system}/unknowns`] = instance.system(system);
    const isReal = system !== 'C';
    const file = cholmod && isReal ? join(folder, `${mesh}-${size}-${system}.bin`) : null;
    if (file) writeSystem(file, instance.matrix());
    // The same solver of ours in another module, for the ordering; only its faer is measured.
    const other = isReal ? await instantiate(simd, mesh, size) : null;
    other?.system(system);
    other?.ours_order();
    cases.push({ system, instance, other, isReal, file });
  }
  for (let round = 0; round < rounds; round++) {
    for (const { system, instance, other, isReal, file } of cases) {
      const time = (what, work) => watch.time(`${system}/${what}`, work);
      ours(time, facts, system, instance, isReal);
      if (isReal) {
        faer(time, facts, system, instance, 'faer', 0);
        faer(time, facts, system, other, 'faer-simd', 0);
        other.forget_peers();
        // It is slow and only completes the picture.
        if (round === 0) faer(time, facts, system, instance, 'faer-amd', 1);
        if (round === 0 && withCsc) csc(time, facts, system, instance);
        instance.forget_peers();
      }
      if (file) native(watch, facts, system, runCholmod(cholmod, file, clock));
    }
  }
  return { samples: watch.samples, facts };
}

function ours(time, facts, system, instance, isReal) {
  time('ours/order', () => instance.ours_order());
  facts[`${system}/ours/nonzeros`] = time('ours/analyse', () => instance.ours_analyze());
  for (const [name, bits] of [
    ['ours', 64],
    ['ours-single', 32],
  ]) {
    // Single precision cannot tell some matrices from singular ones.
    if (!time(`${name}/factor`, () => instance.ours_factor(bits))) continue;
    time(`${name}/solve1`, () => instance.ours_solve(1));
    time(`${name}/solve8`, () => instance.ours_solve(8));
    time(`${name}/refactor`, () => instance.ours_refactor());
  }
  if (isReal) return;
  for (const epsilon of SHIFTS) {
    instance.system(system, epsilon);
    instance.ours_refactor();
    facts[`${system}/refined/${epsilon}/steps`] = time(`refined/${epsilon}`, () => instance.ours_refined());
  }
  instance.system(system);
}

function faer(time, facts, system, instance, name, ownOrder) {
  facts[`${system}/${name}/nonzeros`] = time(`${name}/analyse`, () => instance.faer_analyze(ownOrder));
  time(`${name}/factor`, () => instance.faer_factor());
  time(`${name}/solve1`, () => instance.faer_solve(1));
  time(`${name}/solve8`, () => instance.faer_solve(8));
  time(`${name}/refactor`, () => instance.faer_factor());
}

function csc(time, facts, system, instance) {
  time('csc/analyse', () => instance.csc_analyze());
  facts[`${system}/csc/nonzeros`] = time('csc/factor', () => instance.csc_factor());
  time('csc/solve1', () => instance.csc_solve(1));
  time('csc/solve8', () => instance.csc_solve(8));
}

function native(watch, facts, system, measured) {
  facts[`${system}/cholmod/nonzeros`] = measured.nonzeros;
  for (const stage of ['analyse', 'factor', 'refactor', 'solve1', 'solve8']) {
    watch.add(`${system}/cholmod/${stage}`, measured[stage]);
  }
}
