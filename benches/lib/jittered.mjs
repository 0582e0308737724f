// The jittered torus and the terrain of benches/common/meshes.rs with its field, made in JavaScript, and known fields with noise on them.

/** The generator of src/support/random.rs; a function that returns the next number in [−1, 1). */
export function signed(seed) {
  const mask = (1n << 64n) - 1n;
  let state = BigInt(seed) & mask;
  return () => {
    state = (state + 0x9e3779b97f4a7c15n) & mask;
    let z = state;
    z = ((z ^ (z >> 30n)) * 0xbf58476d1ce4e5b9n) & mask;
    z = ((z ^ (z >> 27n)) * 0x94d049bb133111ebn) & mask;
    return (2 * Number((z ^ (z >> 31n)) >> 11n)) / 2 ** 53 - 1;
  };
}

/** About `size` vertices. The largest lumped mass is 26 times the smallest at 100,000 vertices. */
export function jitteredTorus(size, jitter = 0.58) {
  const around = Math.round(Math.sqrt(2.5 * size));
  const across = Math.round(size / around);
  const random = signed((BigInt(around) << 32n) | BigInt(across));
  const positions = new Float64Array(3 * around * across);
  for (let i = 0, v = 0; i < around; i++) {
    for (let j = 0; j < across; j++, v++) {
      const a = (2 * Math.PI * (i + jitter * random())) / around;
      const b = (2 * Math.PI * (j + jitter * random())) / across;
      const r = 1 + 0.4 * Math.cos(b);
      positions.set([r * Math.cos(a), r * Math.sin(a), 0.4 * Math.sin(b)], 3 * v);
    }
  }
  const at = (i, j) => (i % around) * across + (j % across);
  return { positions, triangles: cells(around, across, at) };
}

/** About `size` vertices of hills above a square, jittered within it. */
export function openTerrain(size) {
  const count = Math.round(Math.sqrt(size));
  const random = signed(count);
  const positions = new Float64Array(3 * count * count);
  for (let i = 0, v = 0; i < count; i++) {
    for (let j = 0; j < count; j++, v++) {
      const [x, y] = [(i + 0.3 * random()) / (count - 1), (j + 0.3 * random()) / (count - 1)];
      const hill = 0.1 * Math.sin(7 * x + 2 * y) + 0.05 * Math.cos(13 * y - 4 * x);
      positions.set([x, y, hill], 3 * v);
    }
  }
  return { positions, triangles: cells(count - 1, count - 1, (i, j) => i * count + j) };
}

function cells(m, n, at) {
  const triangles = new Uint32Array(6 * m * n);
  for (let i = 0, cell = 0; i < m; i++) {
    for (let j = 0; j < n; j++, cell++) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      triangles.set([a, b, c, a, c, d], 6 * cell);
    }
  }
  return triangles;
}

/** A smooth function with noise, that of benches/common/systems.rs. */
export function noisyField(positions) {
  const random = signed(0);
  return Float64Array.from({ length: positions.length / 3 }, (_, v) => {
    const [x, y, z] = positions.subarray(3 * v, 3 * v + 3);
    return x * y + z + 0.2 * random();
  });
}

const FORMULAS = {
  height: (x, y) => y + 0.3 * x,
  waves: (x, y) => Math.sin(9 * x) * Math.cos(7 * y),
  bumps: (x, y, z, centers) => {
    const square = (c) => (x - c[0]) ** 2 + (y - c[1]) ** 2 + (z - c[2]) ** 2;
    return centers.reduce((sum, c) => sum + Math.exp(-square(c) / 0.02), 0);
  },
  crease: (x, y) => Math.abs(x - 0.4) + Math.abs(y - 0.4),
  fine: (x, y) => Math.sin(25 * x) + Math.cos(21 * y),
};

/** From slow to fast, with a kink, each with values from 0 to 1: pairs of names and values. */
export function knownFields(positions) {
  const n = positions.length / 3;
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < 3 * n; i++) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  const side = Math.max(...low.map((from, i) => high[i] - from));
  const point = (v) => low.map((from, i) => (positions[3 * v + i] - from) / side);
  const centers = [0, 1, 2, 3].map((k) => point(k * Math.floor(n / 5)));
  return Object.entries(FORMULAS).map(([name, formula]) => {
    const values = Float64Array.from({ length: n }, (_, v) => formula(...point(v), centers));
    let [min, max] = [Infinity, -Infinity];
    for (const value of values) [min, max] = [Math.min(min, value), Math.max(max, value)];
    return [name, values.map((value) => (value - min) / (max - min))];
  });
}

/** With normal noise of standard deviation `sigma`, by the method of Box and Muller. */
export function withNoise(values, sigma, seed) {
  const random = signed(seed);
  return values.map((value) => {
    const radius = Math.sqrt(-2 * Math.log((1 - random()) / 2));
    return value + sigma * radius * Math.cos(Math.PI * random());
  });
}
