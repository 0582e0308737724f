// Native CHOLMOD with METIS on one thread, where a C compiler and its headers are there.
import { spawnSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { execute } from '../../scripts/lib/run.mjs';
import { inRoot } from '../../scripts/lib/paths.mjs';

/** Builds the program; null where that is not possible. */
export async function buildCholmod(folder) {
  mkdirSync(folder, { recursive: true });
  const program = join(folder, 'cholmod');
  const source = inRoot('benches', 'cholmod', 'cholmod.c');
  // The BLAS that CHOLMOD was linked with may be the reference one.
  for (const libraries of [['-lcholmod', '-lopenblas'], ['-lcholmod']]) {
    const { code } = await execute('cc', ['-O2', '-o', program, source, ...libraries]);
    if (code === 0) return { program, blas: libraries.length > 1 ? 'OpenBLAS' : "the system's BLAS" };
  }
  return null;
}

/** Writes a system for the program to read. */
export function writeSystem(path, { offsets, rows, values, rightHandSides }) {
  const unknowns = offsets.length - 1;
  const header = Uint32Array.of(unknowns, rows.length, rightHandSides.length / unknowns, 0);
  const padding = new Uint32Array((offsets.length + rows.length) % 2);
  const parts = [header, offsets, rows, padding, values, rightHandSides];
  writeFileSync(
    path,
    Buffer.concat(parts.map((part) => new Uint8Array(part.buffer, part.byteOffset, part.byteLength))),
  );
}

/** Analyses, factorises and solves once: times in seconds, and the factor's entries. */
export function runCholmod(program, path, clock) {
  const env = { ...process.env, OPENBLAS_NUM_THREADS: '1', OMP_NUM_THREADS: '1' };
  const { status, stdout, stderr } = spawnSync(program, [path, clock], { env, encoding: 'utf8' });
  if (status !== 0) throw new Error(`CHOLMOD failed: ${stderr.trim()}`);
  return JSON.parse(stdout);
}
