// What there is of each of the package's WebAssembly modules: everything else follows from this table.
import { join } from 'node:path';
import { pkg } from './paths.mjs';

/**
 * - `name`: what wasm-pack calls the module; `feature`: the crate's feature that makes it.
 * - `bindings`: the folder below src/ that only this module is made from; `without`: those that it does not need.
 * - `bundles`: what is bundled of src/js/entries/, by the file in dist/ that it becomes; `copies`: what is copied as it is.
 * - `types`: its type declarations, and the parts of src/js/types/ that they consist of, in the order in which one reads them.
 * - `limit`: what it may take to download, in bytes with brotli at its best.
 */
const TABLE = {
  core: {
    name: 'morse_smooth',
    feature: 'wasm',
    title: 'the WebAssembly module',
    bindings: 'wasm/core',
    without: ['render'],
    bundles: { 'core.js': 'core.js', 'node.cjs': 'node.js' },
    copies: ['index.js', 'inline.js', 'inline.d.ts', 'node.mjs'],
    types: { index: ['package', 'files', 'mesh', 'field', 'smoothing', 'family'] },
    // 36 kB for the sparse solver, 32 kB for persistence, Morse complex and the like, 29 kB for constraints, filters and the
    // intrinsic Delaunay Laplacian, 27 kB for missing values, stopping, memory that is made sure of, welding with a tolerance and
    // extrema that cannot be avoided, 120 kB for all else.
    limit: 246_000,
  },
  snapshot: {
    name: 'morse_smooth_snapshot',
    feature: 'wasm-snapshot',
    title: 'the WebAssembly module of the pictures',
    bindings: 'wasm/snapshot',
    without: [],
    bundles: { 'snapshot.js': 'snapshot.js', 'snapshot-node.cjs': 'snapshot-node.js' },
    copies: ['snapshot-node.mjs'],
    types: { snapshot: ['snapshot'] },
    // Half of it tiny-skia and png.
    limit: 208_000,
  },
};

/** The table, with the name of each module's file in dist/ (`wasm`) and where wasm-pack leaves it (`built`). */
export const modules = Object.fromEntries(
  Object.entries(TABLE).map(([key, module]) => {
    const wasm = `${module.name}_bg.wasm`;
    return [key, { ...module, wasm, built: join(pkg, key, wasm) }];
  }),
);

/** Whether a source file below src/ goes into a module: it need not be built anew for the others. */
export function isMadeFrom(key, file) {
  const others = Object.entries(modules).filter(([other]) => other !== key);
  const foreign = [...modules[key].without, ...others.map(([, { bindings }]) => bindings)];
  return !foreign.some((folder) => file.startsWith(`${folder}/`));
}
