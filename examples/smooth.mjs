import { readFileSync } from 'node:fs';
import init, { TriMesh, smooth } from 'morse-smooth';
import initFiles, { readMesh } from 'morse-smooth/files';

await Promise.all([init(), initFiles()]); // loads the WebAssembly modules in a browser; Node does so by itself
const { positions, triangles, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const mesh = new TriMesh(positions, triangles);
const { values, report } = smooth(mesh, fields.noisy, { epsilon: 0.05 });
const { before, after } = report;
console.log(`minima ${before.minima} → ${after.minima}, maxima ${before.maxima} → ${after.maxima}, of`, values.length);
