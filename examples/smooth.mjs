import { readFileSync } from 'node:fs';
import init, { readMesh, smooth } from 'morse-smooth';

await init(); // loads the WebAssembly module in a browser; Node has done so on import
const { mesh, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const { values, report } = smooth(mesh, fields.noisy, { epsilon: 0.05 });
const { before, after } = report;
const counts = `minima ${before.minima} → ${after.minima}, maxima ${before.maxima} → ${after.maxima}`;
console.log(`${counts}, of ${values.length}`);
mesh.free();
