import { readFileSync } from 'node:fs';
import init, { TriMesh } from 'morse-smooth';
import initFiles, { readMesh } from 'morse-smooth/files';

await Promise.all([init(), initFiles()]); // loads the WebAssembly modules in a browser; Node does so by itself
const { positions, triangles, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const mesh = new TriMesh(positions, triangles);
const { minima, maxima, saddles } = mesh.criticalPoints(fields.noisy).counts;
console.log(`${minima} minima, ${maxima} maxima, ${saddles} saddles`);

// The least threshold that leaves one minimum and one maximum: a torus can do with no less.
const curve = mesh.persistenceCurve(fields.noisy);
const row = curve.minima.findIndex((count, k) => count + curve.maxima[k] <= 2);
const threshold = curve.threshold[row];
console.log(`one of each from threshold ${threshold.toFixed(2)} on`);

const { values: simple } = mesh.simplify(fields.noisy, { threshold, thresholdIs: 'absolute' });
const left = mesh.criticalPoints(simple).counts;
console.log(`${left.minima} minimum, ${left.maxima} maximum, ${left.saddles} saddles`);
const change = simple.reduce((most, value, v) => Math.max(most, Math.abs(value - fields.noisy[v])), 0);
console.log(`changed by at most ${change.toFixed(2)}`);
console.log(`${mesh.morseComplex(simple).kinds.length} lines of the Morse complex`);
mesh.free();
