import { readFileSync } from 'node:fs';
import init, { Smoother, readMesh } from 'morse-smooth';

await init(); // loads the WebAssembly module in a browser; Node has done so on import
const { mesh, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const smoother = new Smoother(mesh);
const { values, report } = smoother.tikhonov(fields.noisy, { epsilon: 0.05 });
const { before, after } = report;
console.log(`minima ${before.minima} → ${after.minima}, maxima ${before.maxima} → ${after.maxima}`);
console.log(`changed by at most ${(100 * report.lInfinity).toFixed(1)} % of the range`);
console.log(`${mesh.levelSets(values, { count: 20 }).levels.length} lines on 20 levels`);
for (const object of [smoother, mesh]) object.free();
