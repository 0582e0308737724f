import { readFileSync } from 'node:fs';
import init, { Smoother, TriMesh } from 'morse-smooth';
import initFiles, { readMesh } from 'morse-smooth/files';

await Promise.all([init(), initFiles()]); // loads the WebAssembly modules in a browser; Node does so by itself
const { positions, triangles, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const mesh = new TriMesh(positions, triangles);
const smoother = new Smoother(mesh);

// A torus can do with four critical points, and far above the noise there are no others.
const constraints = { from: 'persistence', threshold: 0.2 };
const { values, report } = smoother.interpolate(fields.noisy, { constraints });
console.log(`kept ${report.preserved} of ${report.constrainedCriticalPoints} critical points`);
console.log(`extrema elsewhere: ${report.freeExtrema}`);

const fixed = mesh.constrainedVertices(fields.noisy, constraints);
console.log(`fixed at ${fixed.length} vertices: ${fixed.every((v) => values[v] === fields.noisy[v])}`);

// Least squares let go of critical points, and stay closer to the field where all of them are constrained.
const pulled = smoother.leastSquares(fields.noisy, { constraints: { from: 'criticalPoints' }, epsilon: 0.05 });
for (const [name, { before, after, lInfinity }] of Object.entries({ interpolated: report, pulled: pulled.report })) {
  const counts = [before, after].map(({ minima, maxima, saddles }) => `${minima}, ${maxima}, ${saddles}`);
  console.log(`${name}: ${counts.join(' → ')}, changed by at most ${(100 * lInfinity).toFixed(1)} %`);
}
for (const object of [smoother, mesh]) object.free();
