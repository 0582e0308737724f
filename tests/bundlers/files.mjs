// The files of the apps, beside the four of tests/package/apps/ that do the work: app.js, use.js, read.js, draw.js.
import { readFileSync } from 'node:fs';

const read = (name) => readFileSync(new URL(`../package/apps/${name}`, import.meta.url), 'utf8');
const shared = Object.fromEntries(['app.js', 'use.js', 'read.js', 'draw.js'].map((name) => [name, read(name)]));
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

const node = {
  ...shared,
  // Without \`init\` first.
  'node.js': `import { run } from './app.js';

run(false).then((first) => run().then((second) => console.log(JSON.stringify({ page: first, again: second }))));
`,
  'node-cjs.js': `import { run } from './app.js';

run(false).then((first) => run().then((second) => console.log(JSON.stringify({ page: first, again: second }))));
`,
  'require.cjs': `const api = require('morse-smooth');
const files = require('morse-smooth/files');
const pictures = require('morse-smooth/snapshot');

const all = ['use', 'read', 'draw'].map((name) => import('./' + name + '.js'));
Promise.all(all).then(([{ use }, { read }, { draw }]) => {
  const oneError = [files, pictures].every(({ MorseSmoothError }) => MorseSmoothError === api.MorseSmoothError);
  console.log(JSON.stringify({ page: { page: use(api), file: read(files), picture: draw(pictures), oneError } }));
});
`,
};

const script = { ...node, 'page.js': `import { run } from './app.js';\n\nrun().then((page) => ({ page }))${tell}` };

const page = {
  ...node,
  'index.html': html('main.js', 'module'),
  'worker.js': worker,
  'main.js': `import { run } from './app.js';

const inWorker = () =>
  ${inWorker('./worker.js')};

run().then(async (page) => ({ page, worker: await inWorker() }))${tell}`,
};

const next = {
  ...within('app', shared),
  'app/worker.js': worker,
  'app/layout.jsx': `export default function Layout({ children }) {
  return <html><body>{children}</body></html>;
}
`,
  'app/page.jsx': `import { run } from './app.js';
import { Client } from './client.jsx';

export const dynamic = 'force-dynamic';

export default async function Page() {
  const server = await run(false);
  return <><pre id="server">{JSON.stringify(server)}</pre><Client /></>;
}
`,
  'app/client.jsx': `'use client';
import { useEffect } from 'react';
import { run } from './app.js';

export function Client() {
  useEffect(() => {
    const inWorker = () =>
      ${inWorker('./worker.js')};
    const server = () => JSON.parse(document.querySelector('#server').textContent);
    run().then(async (page) => ({ page, server: server(), worker: await inWorker() }))${tell}
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

export const load = async () => ({ server: await run(false) });
`,
  'src/routes/+page.svelte': `<script>
  import { onMount } from 'svelte';
  import { run } from '$lib/app.js';

  let { data } = $props();
  onMount(() => {
    run().then((page) => ({ page, server: data.server }))${tell}
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
const server = await run(false);
---
<html><head><link rel="icon" href="data:," /></head><body>
<pre id="server">{JSON.stringify(server)}</pre>
<script>
  import { run } from '../app.js';
  const server = () => JSON.parse(document.querySelector('#server').textContent);
  run().then((page) => ({ page, server: server() }))${tell}
</script>
</body></html>
`,
};

const asCommonJs = (text) =>
  text
    .replace(/^import init(\w*), \* as (\w+) from ('[^']*');$/gm, 'const $2 = require($3);\nconst init$1 = $2.default;')
    .replace(/^import (\{.*\}) from ('[^']*');$/gm, 'const $1 = require($2);')
    .replace(/^export (async )?function (\w+)/gm, 'exports.$2 = $2;\n$1function $2');

const jest = {
  ...Object.fromEntries(Object.entries(shared).map(([name, text]) => [name, asCommonJs(text)])),
  'app.test.js': `const { writeFileSync } = require('node:fs');
// What plays a browser has none, and the app makes its files from text.
globalThis.TextEncoder ??= require('node:util').TextEncoder;
const { run } = require('./app.js');

it('runs', async () => {
  const page = await run(false);
  writeFileSync('result.json', JSON.stringify({ page, again: await run() }));
});
`,
};

const vitest = {
  ...shared,
  'app.test.js': `import { writeFileSync } from 'node:fs';
import { it } from 'vitest';
import { run } from './app.js';

it('runs', async () => {
  const page = await run(false);
  writeFileSync('result.json', JSON.stringify({ page, again: await run() }));
});
`,
};

const types = {
  'app.ts': `import init, { TriMesh, smooth } from 'morse-smooth';
import initInline from 'morse-smooth/inline';
import initFiles, { readMesh } from 'morse-smooth/files';
import { snapshot } from 'morse-smooth/snapshot';

export async function app(bytes: ArrayBuffer): Promise<Uint8Array> {
  await Promise.all([init({ wasm: new Uint8Array(8) }), initInline(), initFiles()]);
  const { positions, triangles, fields } = readMesh(bytes);
  const mesh = new TriMesh(positions, triangles);
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
  next,
  svelte,
  astro,
  jest,
  vitest,
};
