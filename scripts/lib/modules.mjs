// What there is of each of the package's WebAssembly modules: everything else follows from this table, or is compared with it.
import { join } from 'node:path';
import { pkg } from './paths.mjs';

/**
 * - `entry`: how the package's users import it.
 * - `name`: what wasm-pack calls the module; `feature`: the crate's feature that makes it.
 * - `bindings`: the folder below src/ that only this module is made from; `without`: folders and files that it does not need.
 * - `bundles`: what is bundled of src/js/entries/, by the file in dist/ that it becomes; `copies`: what is copied as it is.
 * - `types`: its type declarations, and the parts of src/js/types/ that they consist of, in the order in which one reads them.
 * - `exports`: what package.json says of its entries.
 * - `limit`: what it may take to download, in bytes with brotli at its best.
 */
const TABLE = {
  core: {
    entry: 'morse-smooth',
    name: 'morse_smooth',
    feature: 'wasm',
    title: 'the WebAssembly module',
    bindings: 'wasm/core',
    without: ['io', 'load.rs', 'render'],
    bundles: { 'core.js': 'core.js', 'node.cjs': 'node.js' },
    copies: ['index.js', 'inline.js', 'inline.d.ts', 'node.mjs'],
    types: { index: ['package', 'mesh', 'field', 'smoothing', 'prescribe', 'family'] },
    exports: {
      '.': exported('index', 'node'),
      './inline': { types: './dist/inline.d.ts', default: './dist/inline.js' },
    },
    // 36 kB for the sparse solver, 36 kB for families of all ε and the choice of one, 32 kB for persistence, Morse complex and the like,
    // 32 kB for prescribed extrema, 29 kB for constraints, filters and the intrinsic Delaunay Laplacian, 27 kB for missing values,
    // stopping, memory that is made sure of, welding with a tolerance and extrema that cannot be avoided, 88 kB for all else.
    limit: 282_000,
  },
  files: {
    ...besideTheMain('files'),
    title: 'the WebAssembly module of the files',
    without: ['operators', 'render', 'smooth', 'solve'],
    limit: 71_000,
  },
  snapshot: {
    ...besideTheMain('snapshot'),
    title: 'the WebAssembly module of the pictures',
    without: ['io', 'load.rs', 'operators', 'smooth', 'solve'],
    // Half of it tiny-skia and png.
    limit: 208_000,
  },
};

/** What follows from the name of a module that is another entry's. */
function besideTheMain(name) {
  return {
    entry: `morse-smooth/${name}`,
    name: `morse_smooth_${name}`,
    feature: `wasm-${name}`,
    bindings: `wasm/${name}`,
    bundles: { [`${name}.js`]: `${name}.js`, [`${name}-node.cjs`]: `${name}-node.js` },
    copies: [`${name}-node.mjs`],
    types: { [name]: [name] },
    exports: { [`./${name}`]: exported(name, `${name}-node`) },
  };
}

/** What package.json says of an entry with these files for browsers and for Node. */
function exported(browser, node) {
  const types = `./dist/${browser}.d.ts`;
  return {
    node: {
      import: { types, default: `./dist/${node}.mjs` },
      require: { types: `./dist/${browser}.d.cts`, default: `./dist/${node}.cjs` },
    },
    types,
    default: `./dist/${browser}.js`,
  };
}

/** The table, with the name of each module's file in dist/ (`wasm`) and where wasm-pack leaves it (`built`). */
export const modules = Object.fromEntries(
  Object.entries(TABLE).map(([key, module]) => {
    const wasm = `${module.name}_bg.wasm`;
    return [key, { ...module, wasm, built: join(pkg, key, wasm) }];
  }),
);

/**
 * Entries without a WebAssembly module of their own, told as above. `standalone`: scripts that need no other file, by their place in dist/;
 * `embedded`: the same as texts in scripts, each by the name of the script.
 */
export const others = {
  worker: {
    entry: 'morse-smooth/worker',
    bundles: { 'worker.js': 'worker.js', 'worker-node.cjs': 'worker-node.js' },
    standalone: { 'worker-script.js': 'worker-script.js', 'worker-script-node.cjs': 'worker-script-node.js' },
    embedded: { 'worker-embedded.js': 'worker-script.js', 'worker-embedded-node.cjs': 'worker-script-node.js' },
    copies: ['worker-node.mjs', 'worker-script.d.ts'],
    types: { worker: ['worker'] },
    exports: {
      './worker': exported('worker', 'worker-node'),
      './worker-script': {
        types: './dist/worker-script.d.ts',
        node: './dist/worker-script-node.cjs',
        default: './dist/worker-script.js',
      },
    },
  },
};

/** What cargo is told to compile a module with, and nothing else. */
export const cargoFeatures = ({ feature }) => ['--no-default-features', '--features', feature];

/** Whether a source file below src/ goes into a module: it need not be built anew for the others. */
export function isMadeFrom(key, file) {
  const others = Object.entries(modules).filter(([other]) => other !== key);
  const foreign = [...modules[key].without, ...others.map(([, { bindings }]) => bindings)];
  return !foreign.some((place) => file === place || file.startsWith(`${place}/`));
}
