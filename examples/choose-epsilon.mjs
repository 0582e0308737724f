// node examples/choose-epsilon.mjs: chooses ε for a field with noise, and compares it with the best one, which a known field tells.
import { readFileSync } from 'node:fs';
import init, { Smoother, TriMesh } from 'morse-smooth';
import initFiles, { readMesh } from 'morse-smooth/files';

await Promise.all([init(), initFiles()]); // loads the WebAssembly modules in a browser; Node does so by itself
const { positions, triangles, fields } = readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const mesh = new TriMesh(positions, triangles);
const smoother = new Smoother(mesh);
const family = smoother.family(fields.noisy); // every ε from 1e-6 to 1e4

const errorOf = (epsilon) => Math.hypot(...family.values(epsilon).map((value, i) => value - fields.clean[i]));
const { epsilon, reason } = family.choose();
console.log(reason);

const curve = family.sweep({ counts: true });
const best = Math.min(...curve.epsilons.map(errorOf));
console.log(`error ${(errorOf(epsilon) / best).toFixed(2)} times that of the best ε`);
for (let k = 0; k < curve.epsilons.length; k += 4) {
  const { epsilons, minima, saddles, maxima } = curve;
  console.log(`ε = ${epsilons[k].toExponential(0)}: ${minima[k]} minima, ${saddles[k]} saddles, ${maxima[k]} maxima`);
}

const { kinds, lastVertices, leastEpsilons } = family.lives();
for (let k = 0; k < 4; k++) {
  const kind = kinds[k] === 1 ? 'maximum' : 'minimum';
  console.log(`${kind} from ε = ${leastEpsilons[k].toExponential(0)} on, there at vertex ${lastVertices[k]}`);
}
for (const object of [family, smoother, mesh]) object.free();
