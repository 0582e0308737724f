// How near the rules come to the best ε on one mesh, where the field without its noise is known; in a process of its own.
import { Smoother, TriMesh } from '../../dist/node.mjs';
import { jitteredTorus, knownFields, openTerrain, withNoise } from './jittered.mjs';

export const MESHES = { closed: jitteredTorus, open: openTerrain };
export const LEVELS = [0.01, 0.05, 0.2];
export const RULES = ['gcv', 'lCurve', 'discrepancy'];
/** Exact enough to tell errors apart. */
const TOLERANCE = 1e-4;
/** The best of so many ε, ten in each decade, is what the rules are compared with. */
const TRIED = 101;

export async function run({ kind, size }) {
  const { positions, triangles } = MESHES[kind](size);
  const smoother = new Smoother(new TriMesh(positions, triangles));
  const rows = [];
  for (const [k, [field, truth]] of knownFields(positions).entries()) {
    for (const [j, sigma] of LEVELS.entries()) {
      const family = smoother.family(withNoise(truth, sigma, 100 * k + j + 1), { tolerance: TOLERANCE });
      const error = (epsilon) => distance(family.values(epsilon), truth);
      const [from, to] = family.epsilonRange;
      let best = Infinity;
      for (let i = 0; i < TRIED; i++) best = Math.min(best, error(from * (to / from) ** (i / (TRIED - 1))));
      const row = { field, sigma, quotients: {} };
      for (const rule of RULES) {
        const { epsilon, noise } = family.choose({ rule });
        row.quotients[rule] = error(epsilon) / best;
        if (rule === 'discrepancy') {
          row.noise = noise.standardDeviation / sigma;
          row.confidence = noise.confidence;
        }
      }
      rows.push(row);
      family.free();
    }
  }
  return { vertices: positions.length / 3, rows };
}

function distance(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += (a[i] - b[i]) ** 2;
  return Math.sqrt(sum);
}
