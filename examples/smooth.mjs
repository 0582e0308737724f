import { readFileSync } from 'node:fs';
import init, { Smoother, readMesh } from 'morse-smooth';

await init(); // loads the WebAssembly module in a browser; Node has done so on import
const { mesh, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const smoother = new Smoother(mesh);
const { values, report } = smoother.tikhonov(fields.noisy, { epsilon: 0.05 });
const { before, after } = report;
console.log(`minima ${before.minima} → ${after.minima}, maxima ${before.maxima} → ${after.maxima}, of ${values.length}`);
for (const object of [smoother, mesh]) object.free();
