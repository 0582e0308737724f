// Meshes and fields that the tests know everything about.

/** Regular, with edges of length 2√2. */
export const tetrahedron = () => ({
  positions: [1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1],
  triangles: [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2],
});

/** The six unit vectors ±x, ±y, ±z. */
export const octahedron = () => ({
  positions: [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1],
  triangles: [4, 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 5, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3],
});

/** A square of n × n cells of side 1, in the plane z = 0. Vertex i + (n + 1) j is at (i, j). */
export function square(n) {
  const positions = [];
  const triangles = [];
  for (let j = 0; j <= n; j++) for (let i = 0; i <= n; i++) positions.push(i, j, 0);
  for (let j = 0; j < n; j++) {
    for (let i = 0; i < n; i++) {
      const a = i + (n + 1) * j;
      const b = a + n + 1;
      triangles.push(a, a + 1, b + 1, a, b + 1, b);
    }
  }
  return { positions, triangles };
}

/** A torus around the x axis, radii 2 and 1, so that it stands upright: its height z has one minimum, two saddles, one maximum. */
export function torus(around = 48, across = 24) {
  const positions = [];
  const triangles = [];
  for (let i = 0; i < around; i++) {
    for (let j = 0; j < across; j++) {
      // Turned a little, so that no two heights are equal.
      const u = (2 * Math.PI * (i + 0.3)) / around;
      const v = (2 * Math.PI * (j + 0.2)) / across;
      const r = 2 + Math.cos(v);
      positions.push(Math.sin(v), r * Math.cos(u), r * Math.sin(u));
      const [a, b] = [i * across, ((i + 1) % around) * across];
      const k = (j + 1) % across;
      triangles.push(a + j, b + j, b + k, a + j, b + k, a + k);
    }
  }
  return { positions, triangles };
}

/** A sphere: an octahedron whose triangles are cut into four, again and again. */
export function sphere(times = 3) {
  let { positions, triangles } = octahedron();
  for (let time = 0; time < times; time++) {
    const middles = new Map();
    const middle = (a, b) => {
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      if (!middles.has(key)) {
        const point = [0, 1, 2].map((axis) => positions[3 * a + axis] + positions[3 * b + axis]);
        middles.set(key, positions.length / 3);
        positions.push(...point.map((x) => x / Math.hypot(...point)));
      }
      return middles.get(key);
    };
    const finer = [];
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = triangles.slice(t, t + 3);
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      finer.push(a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca);
    }
    triangles = finer;
  }
  return { positions, triangles };
}

/** Two tetrahedra that have vertex 0 in common and nothing else. */
export function pinched() {
  const { positions } = tetrahedron();
  const triangles = [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 0, 4, 5, 0, 6, 4, 0, 5, 6, 4, 6, 5];
  const other = positions.map((x, k) => 2 * positions[k % 3] - x);
  return { positions: [...positions, ...other.slice(3)], triangles };
}

/** A tetrahedron, two vertices of no triangle (4 and 5), an octahedron. */
export function islands() {
  const [first, second] = [tetrahedron(), octahedron()];
  return {
    positions: [...first.positions, 9, 9, 9, -9, 9, 9, ...second.positions.map((x) => x + 5)],
    triangles: [...first.triangles, ...second.triangles.map((v) => v + 6)],
  };
}

/** A Möbius strip of 2n triangles. */
export function moebius(n = 8) {
  const positions = [];
  const triangles = [];
  for (let i = 0; i < n; i++) {
    const u = (2 * Math.PI * i) / n;
    for (const t of [-0.4, 0.4]) {
      const r = 1 + t * Math.cos(u / 2);
      positions.push(r * Math.cos(u), r * Math.sin(u), t * Math.sin(u / 2));
    }
  }
  for (let i = 0; i < n; i++) {
    const [a, b] = [2 * i, 2 * i + 1];
    // The last pair meets the first one upside down.
    const [c, d] = i + 1 < n ? [a + 2, a + 3] : [1, 0];
    triangles.push(a, c, b, b, c, d);
  }
  return { positions, triangles };
}

export const component = (positions, axis) =>
  Float64Array.from({ length: positions.length / 3 }, (_, i) => positions[3 * i + axis]);
export const heights = ({ positions }) => component(positions, 2);

/** Numbers in [0, 1) that are the same in every run. */
export function random(seed = 1) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** A matrix by columns as rows of ordinary arrays. */
export function dense({ rows, columns, columnPointers, rowIndices, values }) {
  const matrix = Array.from({ length: rows }, () => new Array(columns).fill(0));
  for (let j = 0; j < columns; j++) {
    for (let k = columnPointers[j]; k < columnPointers[j + 1]; k++) matrix[rowIndices[k]][j] += values[k];
  }
  return matrix;
}

export const apply = (matrix, x) => matrix.map((row) => row.reduce((sum, entry, j) => sum + entry * x[j], 0));
export const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
export const sum = (values) => values.reduce((total, value) => total + value, 0);
export const text = (string) => new TextEncoder().encode(string);
