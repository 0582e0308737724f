// What there is of each of the package's WebAssembly modules: everything else follows from this table, or is compared with it.
import { join } from 'node:path';
import { pkg } from './paths.mjs';

/**
 * - `entry`: how the package's users import it.
 * - `name`: what wasm-pack calls the module; `feature`: the crate's feature that makes it.
 * - `bindings`: the folder below src/ that only this module is made from; `without`: folders and files that it does not need.
 * - `bundles`: what is bundled of src/js/entries/, by the file in dist/ that it becomes; `shared`: which of them others import.
 * - `global`: where classic scripts find it.
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
    bundles: { 'core.js': 'api.js', 'inline.js': 'inline.js', ...bundled('index', 'node', 'morse-smooth') },
    shared: 'core.js',
    global: 'MorseSmooth',
    types: { index: ['package', 'mesh', 'field', 'smoothing', 'prescribe', 'family'], inline: ['inline'] },
    exports: { '.': exported('index', 'node'), './inline': exported('inline', 'node', false) },
    // 36 kB for the sparse solver, 36 kB for families of all ε and the choice of one, 32 kB for persistence, Morse complex and the like,
    // 35 kB for prescribed extrema, 29 kB for constraints, filters and the intrinsic Delaunay Laplacian, 27 kB for missing values,
    // stopping, memory that is made sure of, welding with a tolerance and extrema that cannot be avoided, 88 kB for all else.
    limit: 295_000,
  },
  files: {
    ...besideTheMain('files'),
    title: 'the WebAssembly module of the files',
    without: ['operators', 'render', 'smooth', 'solve'],
    limit: 150_000,
  },
  snapshot: {
    ...besideTheMain('snapshot'),
    title: 'the WebAssembly module of the pictures',
    without: ['io', 'load.rs', 'operators', 'smooth', 'solve'],
    // Half of it tiny-skia and png.
    limit: 208_000,
  },
};

/**
 * Entries without a WebAssembly module of their own: `bundles`, `types` and `exports` as above. `standalone`: scripts that need no
 * other file; `embedded`: those that are also there as texts in scripts, by their names. `external`: packages that they import by name,
 * this one included; others than that are optional peer dependencies. `bin`: commands, by the files that they run.
 */
export const others = {
  worker: {
    entry: 'morse-smooth/worker',
    bundles: { 'worker.js': 'worker.js', 'worker-node.mjs': 'worker-node.js', 'worker-node.cjs': 'worker-node.js' },
    standalone: { 'worker-script.js': 'worker-script.js', 'worker-script-node.cjs': 'worker-script-node.js' },
    embedded: { worker: 'worker-script.js', 'worker-node': 'worker-script-node.cjs' },
    types: { worker: ['worker'], 'worker-script': ['worker-script'] },
    exports: {
      './worker': exported('worker', 'worker-node'),
      './worker-script': {
        node: { types: './dist/worker-script.d.cts', default: './dist/worker-script-node.cjs' },
        types: './dist/worker-script.d.ts',
        default: './dist/worker-script.js',
      },
    },
  },
  three: {
    entry: 'morse-smooth/three',
    bundles: { 'three.js': 'three.js', 'three.cjs': 'three.js' },
    external: ['morse-smooth', 'three'],
    types: { three: ['three'] },
    exports: { './three': exported('three', 'three', false) },
  },
  cli: {
    bundles: { 'cli.mjs': 'cli.js' },
    external: ['morse-smooth'],
    types: {},
    exports: {},
    // Without `./`, which npm would take away with a warning.
    bin: { 'morse-smooth': 'dist/cli.mjs' },
  },
};

/** What follows from the name of a module that is another entry's. */
function besideTheMain(name) {
  return {
    entry: `morse-smooth/${name}`,
    name: `morse_smooth_${name}`,
    feature: `wasm-${name}`,
    bindings: `wasm/${name}`,
    bundles: bundled(name, `${name}-node`, `morse-smooth-${name}`),
    global: `MorseSmooth.${name}`,
    types: { [name]: [name] },
    exports: { [`./${name}`]: exported(name, `${name}-node`) },
  };
}

/** The files of an entry for browsers, for Node and for pages without modules. */
function bundled(browser, node, classic) {
  return {
    [`${browser}.js`]: 'browser.js',
    [`${node}.mjs`]: 'node.js',
    [`${node}.cjs`]: 'node.js',
    [`${classic}.iife.js`]: 'classic.js',
  };
}

/**
 * What package.json says of an entry with these files for browsers and for Node, where `import` may get the former all the same.
 *
 * Node takes the same file for `import` and for `require`, so that there is one instance, where it knows `module-sync` (20.19 and
 * newer). Bundlers for browsers know `module`; what requires without it is a test environment such as Jest's, which runs in Node.
 */
function exported(browser, node, isForNode = true) {
  const types = { esm: `./dist/${browser}.d.ts`, cjs: `./dist/${browser}.d.cts` };
  const esm = { types: types.esm, default: `./dist/${browser}.js` };
  const cjs = { types: types.cjs, default: `./dist/${node}.cjs` };
  const nodeEsm = { types: types.esm, default: `./dist/${node}.mjs` };
  const forNode = isForNode ? { node: { 'module-sync': nodeEsm, import: nodeEsm, require: cjs } } : {};
  return { ...forNode, module: esm, require: cjs, ...esm };
}

/** The table, with the name of each module's file in dist/ (`wasm`) and where wasm-pack leaves it (`built`). */
export const modules = Object.fromEntries(
  Object.entries(TABLE).map(([key, module]) => {
    const wasm = `${module.name}_bg.wasm`;
    return [key, { ...module, wasm, built: join(pkg, key, wasm) }];
  }),
);

/**
 * What follows for package.json. All but `exports` is for those that do not know it: Parcel reads `module` and `alias`, TypeScript's
 * older resolution `types` and `typesVersions`; CDNs serve `unpkg` and `jsdelivr`.
 */
export function manifest() {
  const exports = Object.assign({}, ...[...Object.values(modules), ...Object.values(others)].map((row) => row.exports));
  const bin = Object.assign({}, ...Object.values(others).map((row) => row.bin));
  const { '.': main, ...subpaths } = exports;
  const classic = Object.keys(modules.core.bundles).find((name) => name.endsWith('.iife.js'));
  const by = (value) => Object.fromEntries(Object.entries(subpaths).map(([path, entry]) => [path, value(entry)]));
  const withoutDot = (record) => Object.fromEntries(Object.entries(record).map(([path, to]) => [path.slice(2), to]));
  return {
    bin,
    main: main.require.default,
    module: main.default,
    unpkg: `./dist/${classic}`,
    jsdelivr: `./dist/${classic}`,
    types: main.types,
    typesVersions: { '*': withoutDot(by(({ types }) => [types])) },
    alias: by((entry) => entry.default),
    exports: {
      ...exports,
      './*.wasm': './dist/*.wasm',
      './package.json': './package.json',
    },
  };
}

/** What cargo is told to compile a module with, and nothing else. */
export const cargoFeatures = ({ feature }) => ['--no-default-features', '--features', feature];

/** Whether a source file below src/ goes into a module: it need not be built anew for the others. */
export function isMadeFrom(key, file) {
  const others = Object.entries(modules).filter(([other]) => other !== key);
  const foreign = [...modules[key].without, ...others.map(([, { bindings }]) => bindings)];
  return !foreign.some((place) => file === place || file.startsWith(`${place}/`));
}
