// The files of the apps, beside those of tests/package/apps/ that do the work: app.js with use.js, read.js and draw.js on the same thread,
// away.js with remote.js in a worker of the package's own.
import { readFileSync } from 'node:fs';

const read = (name) => readFileSync(new URL(`../package/apps/${name}`, import.meta.url), 'utf8');
const NAMES = ['app.js', 'use.js', 'read.js', 'draw.js', 'away.js', 'remote.js'];
const shared = Object.fromEntries(NAMES.map((name) => [name, read(name)]));
const within = (folder, files) =>
  Object.fromEntries(Object.entries(files).map(([name, text]) => [`${folder}/${name}`, text]));

/** A page with one script. */
const html = (script, type) => `<!doctype html>
<meta charset="utf-8" />
<link rel="icon" href="data:," />
<body><script ${type ? `type="${type}" ` : ''}src="${script}"></script></body>
`;

/** Where the runner finds what came out. */
const tell = `.then(
  (result) => (globalThis.result = result),
  (error) => (globalThis.result = String(error)),
);
`;
const worker = `import { run } from './app.js';

run().then(postMessage, (error) => postMessage(String(error)));
`;
const inWorker = (place) => `new Promise((resolve) => {
    const worker = new Worker(new URL('${place}', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }) => resolve(data);
    worker.onerror = ({ message }) => resolve(message);
  })`;

const inNode = `import { run } from './app.js';
import { away } from './away.js';

async function all() {
  // Without \`init\` first.
  const page = await run(false);
  return { page, again: await run(), connect: await away() };
}
all().then((result) => console.log(JSON.stringify(result)));
`;

const node = {
  ...shared,
  'node.js': inNode,
  'node-cjs.js': inNode,
  'require.cjs': `const api = require('morse-smooth');
const files = require('morse-smooth/files');
const pictures = require('morse-smooth/snapshot');
const workers = require('morse-smooth/worker');

const all = ['use', 'read', 'draw', 'remote'].map((name) => import('./' + name + '.js'));
Promise.all(all).then(async ([{ use }, { read }, { draw }, { remote }]) => {
  const oneError = [files, pictures].every(({ MorseSmoothError }) => MorseSmoothError === api.MorseSmoothError);
  const page = { page: use(api), file: read(files), picture: draw(pictures), oneError };
  console.log(JSON.stringify({ page, connect: await remote(workers) }));
});
`,
};

const script = {
  ...node,
  'page.js': `import { run } from './app.js';
import { away } from './away.js';

run().then(async (page) => ({ page, connect: await away() }))${tell}`,
};

const page = {
  ...node,
  'index.html': html('main.js', 'module'),
  'worker.js': worker,
  'main.js': `import { run } from './app.js';
import { away } from './away.js';

const inWorker = () =>
  ${inWorker('./worker.js')};

run().then(async (page) => ({ page, worker: await inWorker(), connect: await away() }))${tell}`,
};

/** With three.js: three.js with surface.js. */
const surface = Object.fromEntries(['three.js', 'surface.js'].map((name) => [name, read(name)]));
const three = {
  ...surface,
  'node.js': `import { run } from './three.js';

run(false).then((three) => console.log(JSON.stringify({ three })));
`,
  'index.html': html('main.js', 'module'),
  'main.js': `import { run } from './three.js';

run().then((three) => ({ three }))${tell}`,
};

const threeInNext = {
  ...within('app', surface),
  'app/layout.jsx': `export default function Layout({ children }) {
  return <html><body>{children}</body></html>;
}
`,
  'app/page.jsx': `'use client';
import { useEffect } from 'react';
import { run } from './three.js';

export default function Page() {
  useEffect(() => {
    run().then((three) => ({ three }))${tell}
  }, []);
  return <p>client</p>;
}
`,
};

/** The examples for other viewers, beside what tries them. */
const ours = (name) => readFileSync(new URL(name, import.meta.url), 'utf8');
const vtk = { 'vtk.mjs': ours('../../examples/vtk.mjs'), 'vtk-test.mjs': ours('vtk-test.mjs') };
const deck = {
  'deck.mjs': ours('../../examples/deck.mjs'),
  'index.html': html('main.js', 'module'),
  'main.js': ours('deck-page.js'),
};

const next = {
  ...within('app', shared),
  'app/worker.js': worker,
  'app/layout.jsx': `export default function Layout({ children }) {
  return <html><body>{children}</body></html>;
}
`,
  'app/page.jsx': `import { run } from './app.js';
import { away } from './away.js';
import { Client } from './client.jsx';

export const dynamic = 'force-dynamic';

export default async function Page() {
  const server = { server: await run(false), serverConnect: await away() };
  return <><pre id="server">{JSON.stringify(server)}</pre><Client /></>;
}
`,
  'app/client.jsx': `'use client';
import { useEffect } from 'react';
import { run } from './app.js';
import { away } from './away.js';

export function Client() {
  useEffect(() => {
    const inWorker = () =>
      ${inWorker('./worker.js')};
    const server = () => JSON.parse(document.querySelector('#server').textContent);
    run().then(async (page) => ({ page, ...server(), worker: await inWorker(), connect: await away() }))${tell}
  }, []);
  return <p>client</p>;
}
`,
};

const svelte = {
  ...within('src/lib', shared),
  'src/app.html': `<!doctype html>
<html><head><link rel="icon" href="data:," />%sveltekit.head%</head><body>%sveltekit.body%</body></html>
`,
  'src/routes/+page.server.js': `import { run } from '$lib/app.js';
import { away } from '$lib/away.js';

export const load = async () => ({ server: await run(false), serverConnect: await away() });
`,
  'src/routes/+page.svelte': `<script>
  import { onMount } from 'svelte';
  import { run } from '$lib/app.js';
  import { away } from '$lib/away.js';

  let { data } = $props();
  onMount(() => {
    run().then(async (page) => ({ page, ...data, connect: await away() }))${tell}
  });
</script>
`,
  'svelte.config.js': `import adapter from '@sveltejs/adapter-node';

export default { kit: { adapter: adapter() } };
`,
  'vite.config.js': `import { sveltekit } from '@sveltejs/kit/vite';

export default { plugins: [sveltekit()] };
`,
};

const astro = {
  ...within('src', shared),
  'src/pages/index.astro': `---
import { run } from '../app.js';
import { away } from '../away.js';
const server = { server: await run(false), serverConnect: await away() };
---
<html><head><link rel="icon" href="data:," /></head><body>
<pre id="server">{JSON.stringify(server)}</pre>
<script>
  import { run } from '../app.js';
  import { away } from '../away.js';
  const server = () => JSON.parse(document.querySelector('#server').textContent);
  run().then(async (page) => ({ page, ...server(), connect: await away() }))${tell}
</script>
</body></html>
`,
};

const asCommonJs = (text) =>
  text
    .replace(/^import init(\w*), \* as (\w+) from ('[^']*');$/gm, 'const $2 = require($3);\nconst init$1 = $2.default;')
    .replace(/^import \* as (\w+) from ('[^']*');$/gm, 'const $1 = require($2);')
    .replace(/^import (\{.*\}) from ('[^']*');$/gm, 'const $1 = require($2);')
    .replace(/^export const (\w+)/gm, 'const $1 = exports.$1')
    .replace(/^export (async )?function (\w+)/gm, 'exports.$2 = $2;\n$1function $2');

const jest = {
  ...Object.fromEntries(Object.entries(shared).map(([name, text]) => [name, asCommonJs(text)])),
  'app.test.js': `const { writeFileSync } = require('node:fs');
// What plays a browser has none, and the app makes its files from text.
globalThis.TextEncoder ??= require('node:util').TextEncoder;
const { run } = require('./app.js');
const { away } = require('./away.js');

it('runs', async () => {
  const page = await run(false);
  writeFileSync('result.json', JSON.stringify({ page, again: await run(), connect: await away() }));
});
`,
};

const vitest = {
  ...shared,
  'app.test.js': `import { writeFileSync } from 'node:fs';
import { it } from 'vitest';
import { run } from './app.js';
import { away } from './away.js';

it('runs', async () => {
  const page = await run(false);
  writeFileSync('result.json', JSON.stringify({ page, again: await run(), connect: await away() }));
});
`,
};

const types = {
  'app.ts': `import init, { TriMesh, smooth } from 'morse-smooth';
import initInline from 'morse-smooth/inline';
import initFiles, { readMesh } from 'morse-smooth/files';
import { snapshot } from 'morse-smooth/snapshot';
import { connect } from 'morse-smooth/worker';

export async function app(bytes: ArrayBuffer): Promise<Uint8Array> {
  await Promise.all([init({ wasm: new Uint8Array(8) }), initInline(), initFiles()]);
  const { positions, triangles, fields } = readMesh(bytes);
  const mesh = new TriMesh(positions, triangles);
  await (await connect()).createMesh(positions, triangles);
  return snapshot(positions, triangles, smooth(mesh, fields['heat'] ?? []).values);
}
`,
};

export const files = {
  types,
  html,
  node,
  script,
  page,
  three,
  threeInNext,
  vtk,
  deck,
  next,
  svelte,
  astro,
  jest,
  vitest,
};
