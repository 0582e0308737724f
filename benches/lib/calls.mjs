// Whole calls of the package beside CHOLMOD on the real matrix of the same equation.
import { join } from 'node:path';
import { Stopwatch } from './clock.mjs';
import { runCholmod, writeSystem } from './cholmod.mjs';
import { instantiate } from './peers.mjs';

const EQUATIONS = [
  { system: 'A3', metric: 'identity' },
  { system: 'A', metric: 'mass' },
];
const EPSILON = 1;
/** What somebody who drags a slider asks for next. */
const NEXT_EPSILON = 0.1;

export async function run({ wasm, mesh: name, size, rounds, clock, cholmod, folder }) {
  const { Smoother, TriMesh } = await import('../../dist/node.mjs');
  const watch = new Stopwatch(clock);
  const instance = await instantiate(wasm, name, size);
  const mesh = new TriMesh(instance.array('positions').slice(), instance.array('triangles').slice());
  for (const equation of EQUATIONS) {
    instance.system(equation.system, EPSILON);
    equation.field = instance.array('rightHandSides').slice(0, mesh.vertexCount);
    equation.file = cholmod && join(folder, `${name}-${size}-${equation.system}.bin`);
    if (cholmod) writeSystem(equation.file, instance.matrix());
  }
  for (let round = 0; round < rounds; round++) {
    for (const { system, metric, field, file } of EQUATIONS) {
      const smoother = watch.time(`${system}/first`, () => {
        const made = new Smoother(mesh);
        made.tikhonov(field, { epsilon: EPSILON, metric });
        return made;
      });
      watch.time(`${system}/next`, () => smoother.tikhonov(field, { epsilon: NEXT_EPSILON, metric }));
      smoother.free();
      if (!file) continue;
      const { analyse, factor, refactor, solve1 } = runCholmod(cholmod, file, clock);
      watch.add(`${system}/cholmod-first`, analyse + factor + solve1);
      watch.add(`${system}/cholmod-next`, refactor + solve1);
    }
  }
  return { samples: watch.samples, facts: { vertices: mesh.vertexCount } };
}
