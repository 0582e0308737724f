// node examples/keep.mjs output.ply: smooths a field, keeps its important critical points and writes both fields with their mesh.
import { readFileSync, writeFileSync } from 'node:fs';
import init, { Smoother, TriMesh } from 'morse-smooth';
import initFiles, { readMesh, writeMesh } from 'morse-smooth/files';

const [output = 'kept.ply'] = process.argv.slice(2);
await Promise.all([init(), initFiles()]); // loads the WebAssembly modules in a browser; Node does so by itself
const file = readMesh(readFileSync('www/public/examples/lysozyme_potential.ply'));
const mesh = new TriMesh(file.positions, file.triangles);
const [name, field] = Object.entries(file.fields)[0];

const smoother = new Smoother(mesh, { weights: 'intrinsicDelaunay' });
const { values, report } = smoother.interpolate(field, { constraints: { from: 'persistence', threshold: 0.1 } });
console.log(`${name}: kept ${report.preserved} of ${report.constrainedCriticalPoints} critical points`);
console.log(
  `minima ${report.before.minima} → ${report.after.minima}, maxima ${report.before.maxima} → ${report.after.maxima}`,
);

writeFileSync(output, writeMesh(file, { format: 'ply', binary: true, fields: { [name]: field, smooth: values } }));
console.log(`wrote ${output}`);
for (const object of [smoother, mesh]) object.free();
