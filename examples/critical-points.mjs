// node examples/critical-points.mjs file field: reads a mesh with its fields and prints the critical points of one.
import { readFileSync } from 'node:fs';
import init, { TriMesh } from 'morse-smooth';
import initFiles, { readMesh } from 'morse-smooth/files';

const [file = 'www/public/examples/torus_irregular.ply', name = 'clean'] = process.argv.slice(2);
await Promise.all([init(), initFiles()]); // loads the WebAssembly modules in a browser; Node does so by itself
const { positions, triangles, fields, warnings } = readMesh(readFileSync(file));
const mesh = new TriMesh(positions, triangles);
for (const { message } of [...warnings, ...mesh.warnings]) console.log(`warning: ${message}`);
if (!fields[name]) throw new Error(`${file} has no field ${name}, but ${Object.keys(fields).join(', ')}`);

const { vertices, kinds, counts } = mesh.criticalPoints(fields[name]);
vertices.forEach((vertex, k) => {
  const kind = { '-1': 'minimum', 0: 'saddle', 1: 'maximum' }[kinds[k]];
  console.log(`${kind.padEnd(8)} vertex ${vertex}, value ${fields[name][vertex]}`);
});
const { minima, saddles, maxima } = counts;
console.log(`${minima} − ${saddles} + ${maxima} = ${minima - saddles + maxima}: ${mesh.topology.eulerCharacteristic}`);
mesh.free();
