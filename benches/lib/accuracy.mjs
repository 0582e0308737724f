// Errors against references of twice the precision.
import { METRICS, instantiate } from './peers.mjs';

export const EPSILONS = [1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

export async function run({ wasm, mesh, size }) {
  const instance = await instantiate(wasm, mesh, size);
  instance.accuracy_start();
  const rows = [];
  for (const epsilon of EPSILONS) {
    for (const bits of [64, 32]) {
      for (const metric of METRICS) {
        rows.push({ route: 'real', metric, epsilon, bits, errors: instance.realErrors(metric, epsilon, bits) });
      }
      const errors = instance.complexErrors(epsilon, bits);
      const [steps, refined] = errors ? errors.splice(-2) : [];
      rows.push({ route: 'complex', metric: 'lumped', epsilon, bits, errors, steps, refined });
    }
  }
  return { facts: { vertices: instance.vertices }, rows };
}
