import { readFileSync } from 'node:fs';
import init, { readMesh } from 'morse-smooth';

await init(); // loads the WebAssembly module in a browser; Node has done so on import
const { mesh, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
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
