/** A torus and a noisy height on it, from a generator with a fixed seed. */
export function noisyTorus(around, across) {
  const positions = new Float64Array(3 * around * across);
  const triangles = new Uint32Array(6 * around * across);
  const values = new Float64Array(around * across);
  let state = 1;
  for (let i = 0, vertex = 0; i < around; i++) {
    for (let j = 0; j < across; j++, vertex++) {
      const [u, v] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / across];
      const radius = 2 + Math.cos(v);
      positions.set([radius * Math.cos(u), radius * Math.sin(u), Math.sin(v)], 3 * vertex);
      const [a, b, k] = [i * across, ((i + 1) % around) * across, (j + 1) % across];
      triangles.set([a + j, b + j, b + k, a + j, b + k, a + k], 6 * vertex);
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      values[vertex] = positions[3 * vertex] + 0.1 * (state / 2 ** 32 - 0.5);
    }
  }
  return { positions, triangles, values };
}
