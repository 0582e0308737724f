// The sparse solver beside others: times of the stages, whole calls, errors, memory. `--help` lists the options.
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { heading, main, say, step } from '../scripts/lib/log.mjs';
import { inRoot } from '../scripts/lib/paths.mjs';
import { inChild } from './lib/child.mjs';
import { buildCholmod } from './lib/cholmod.mjs';
import { printGoals } from './lib/goals.mjs';
import { readOptions } from './lib/options.mjs';
import { buildPeers, targetFolder } from './lib/peers.mjs';
import { printAccuracy, printCalls, printMemory, printSpeed, size } from './lib/table.mjs';

/** nalgebra-sparse takes half a minute for A at this size, and there is no news beyond. */
const LARGEST_FOR_CSC = 100_000;
const MEMORY_CASES = [
  ['LII', 64],
  ['C', 64],
  ['C', 32],
  ['A', 64],
  ['A', 32],
];

await main(async () => {
  const options = readOptions(process.argv.slice(2));
  const { wasm, simd } = await step(
    'building the solver and its peers for WebAssembly (minutes from scratch)',
    buildPeers,
  );
  const cholmod = await buildCholmod(join(targetFolder, 'cholmod'));
  if (cholmod) say(`native CHOLMOD with METIS and ${cholmod.blas}, one thread`);
  else say('CHOLMOD is skipped: it wants cc and its headers (Debian: libsuitesparse-dev libopenblas-dev)');
  const folder = mkdtempSync(join(tmpdir(), 'morse-smooth-bench-'));
  try {
    const common = { wasm, simd, cholmod: cholmod?.program, folder, clock: options.clock };
    const measured = {};
    if (options.parts.includes('speed')) measured.speed = await speed(options, common);
    if (options.parts.includes('calls')) measured.calls = await calls(options, common);
    if (options.parts.includes('accuracy')) measured.accuracy = await accuracy(options, common);
    if (options.parts.includes('memory')) measured.memory = await memory(options, common);
    heading('what must hold');
    printGoals(measured, options.mainSize);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

/** Measures in a child process, with a sentence if that fails. */
async function measure(what, task, parameters) {
  const result = await step(what, () => inChild(task, parameters));
  if (result.failure) say(`  it failed: ${result.failure}`);
  return result;
}

/** Returns what was measured at the main size, by mesh. */
async function speed({ sizes, meshes, systems, rounds, mainSize }, common) {
  const main = {};
  for (const vertices of sizes) {
    for (const mesh of meshes) {
      heading(`${mesh}, ${size(vertices)} vertices, ε = 1`);
      const count = rounds(vertices);
      const parameters = { mesh, size: vertices, systems, rounds: count, withCsc: vertices <= LARGEST_FOR_CSC };
      const result = await measure(`medians of ${count} rounds`, 'speed', { ...common, ...parameters });
      if (result.failure) continue;
      printSpeed(result, systems);
      if (vertices === mainSize) main[mesh] = result;
    }
  }
  return main;
}

async function calls({ mainSize, rounds }, common) {
  heading(`whole calls of the package, torus, ${size(mainSize)} vertices`);
  if (!existsSync(inRoot('dist', 'node.mjs'))) {
    say('skipped: there is no dist/ yet (npm run build)');
    return undefined;
  }
  const count = rounds(mainSize);
  const parameters = { mesh: 'torus', size: mainSize, rounds: count };
  const result = await measure(`medians of ${count} rounds`, 'calls', { ...common, ...parameters });
  if (result.failure) return undefined;
  printCalls(result);
  return result;
}

async function accuracy({ accuracySize }, common) {
  heading(`errors, torus, ${size(accuracySize)} vertices`);
  const parameters = { mesh: 'torus', size: accuracySize };
  const result = await measure('against references of twice the precision', 'accuracy', { ...common, ...parameters });
  if (result.failure) return undefined;
  printAccuracy(result);
  return result;
}

async function memory({ memorySizes, systems }, common) {
  heading('memory, torus');
  const runs = [];
  for (const vertices of memorySizes) {
    for (const [system, bits] of MEMORY_CASES.filter(([system]) => systems.includes(system))) {
      const parameters = { mesh: 'torus', size: vertices, system, bits };
      const result = await measure(`${size(vertices)}, ${system}, ${bits} bits`, 'memory', {
        ...common,
        ...parameters,
      });
      runs.push({ vertices, system, bits, result });
    }
  }
  printMemory(runs);
  return runs;
}
