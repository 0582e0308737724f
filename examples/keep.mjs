// node examples/keep.mjs output.ply: smooths a field, keeps its important critical points and writes both fields with their mesh.
import { readFileSync, writeFileSync } from 'node:fs';
import init, { Smoother, readMesh, writeMesh } from 'morse-smooth';

const [output = 'kept.ply'] = process.argv.slice(2);
await init(); // loads the WebAssembly module in a browser; Node has done so on import
const { mesh, fields } = readMesh(readFileSync('www/public/examples/lysozyme_potential.ply'));
const [name, field] = Object.entries(fields)[0];

const smoother = new Smoother(mesh, { weights: 'intrinsicDelaunay' });
const { values, report } = smoother.interpolate(field, { constraints: { from: 'persistence', threshold: 0.1 } });
console.log(`${name}: kept ${report.preserved} of ${report.constrainedCriticalPoints} critical points`);
console.log(
  `minima ${report.before.minima} → ${report.after.minima}, maxima ${report.before.maxima} → ${report.after.maxima}`,
);

writeFileSync(output, writeMesh(mesh, { format: 'ply', binary: true, fields: { [name]: field, smooth: values } }));
console.log(`wrote ${output}`);
for (const object of [smoother, mesh]) object.free();
