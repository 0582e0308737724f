// What the topology of a field is, and what dense systems come to, by short and slow ways that have nothing in common with the
// package's.
import { apply, dot } from './meshes.js';

/** Whether a comes before b by (value, vertex number). */
export const isBelow = (values, a, b) => values[a] < values[b] || (values[a] === values[b] && a < b);

const key = (...vertices) => vertices.sort((a, b) => a - b).join(' ');

/** The neighbours of every vertex. */
export function neighbours({ positions, triangles }) {
  const around = Array.from({ length: positions.length / 3 }, () => new Set());
  for (let t = 0; t < triangles.length; t += 3) {
    for (let i = 0; i < 3; i++) {
      const [a, b] = [triangles[t + i], triangles[t + ((i + 1) % 3)]];
      around[a].add(b);
      around[b].add(a);
    }
  }
  return around.map((set) => [...set]);
}

/** How many parts the lower (upper) link of every vertex has. */
export function linkParts({ positions, triangles }, values, down) {
  const links = Array.from({ length: positions.length / 3 }, () => []);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let i = 0; i < 3; i++)
      links[triangles[t + i]].push([triangles[t + ((i + 1) % 3)], triangles[t + ((i + 2) % 3)]]);
  }
  return links.map((edges, v) => {
    const leader = new Map();
    const isIn = (j) => isBelow(values, j, v) === down;
    for (const j of edges.flat()) if (isIn(j)) leader.set(j, j);
    for (const [a, b] of edges) {
      if (!isIn(a) || !isIn(b)) continue;
      const [from, to] = [leader.get(a), leader.get(b)];
      for (const [j, of] of leader) if (of === from) leader.set(j, to);
    }
    return new Set(leader.values()).size;
  });
}

/** Pairs [extremum, vertex of the merger] of all minima (maxima) and the essential ones: union–find over the sorted vertices. */
export function mergers(shape, values, down) {
  const around = neighbours(shape);
  const sorted = around.map((_, v) => v).sort((a, b) => (isBelow(values, a, b) === down ? -1 : 1));
  const rank = [];
  sorted.forEach((v, place) => (rank[v] = place));
  const parent = [];
  const find = (v) => (parent[v] === v ? v : (parent[v] = find(parent[v])));
  const pairs = [];
  for (const v of sorted) {
    parent[v] = v;
    const roots = new Set(around[v].filter((j) => rank[j] < rank[v]).map(find));
    const [oldest, ...others] = [...roots].sort((a, b) => rank[a] - rank[b]);
    for (const younger of others) {
      pairs.push([younger, v]);
      parent[younger] = oldest;
    }
    if (oldest !== undefined) parent[v] = oldest;
  }
  const essential = sorted.filter((v) => parent[v] === v && around[v].length > 0);
  return { pairs, essential: essential.sort((a, b) => a - b) };
}

/**
 * Persistent homology modulo 2 of the sublevel sets, by the reduction of the boundary matrix. `pairs[d]` has the vertices at which
 * a class of dimension d begins and ends, where they differ; `essential[d]` those at which one begins that never ends.
 */
export function homology({ positions, triangles }, values) {
  const rank = [];
  Array.from({ length: positions.length / 3 }, (_, v) => v)
    .sort((a, b) => (isBelow(values, a, b) ? -1 : 1))
    .forEach((v, place) => (rank[v] = place));
  const simplices = new Map();
  const add = (...vertices) => simplices.set(key(...vertices), vertices);
  rank.forEach((_, v) => add(v));
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = triangles.slice(t, t + 3);
    for (const edge of [
      [a, b],
      [b, c],
      [c, a],
    ])
      add(...edge);
    add(a, b, c);
  }
  const ranks = (vertices) => vertices.map((v) => rank[v]).sort((a, b) => b - a);
  const filtration = [...simplices.values()].sort((a, b) => {
    const [x, y] = [ranks(a), ranks(b)];
    if (x[0] !== y[0] || x.length !== y.length) return x[0] - y[0] || x.length - y.length;
    return x[1] - y[1] || x[2] - y[2];
  });
  const place = new Map(filtration.map((simplex, k) => [key(...simplex), k]));
  const highest = (simplex) => simplex.reduce((a, b) => (rank[a] > rank[b] ? a : b));
  const columnWithLowest = new Map();
  const begins = new Set();
  const pairs = [[], [], []];
  filtration.forEach((simplex, k) => {
    const faces = simplex.length > 1 ? simplex.map((_, i) => place.get(key(...simplex.toSpliced(i, 1)))) : [];
    let column = new Set(faces);
    let lowest = Math.max(...column);
    while (columnWithLowest.has(lowest)) {
      for (const row of columnWithLowest.get(lowest)) if (!column.delete(row)) column.add(row);
      lowest = Math.max(...column);
    }
    if (column.size === 0) {
      begins.add(k);
      return;
    }
    columnWithLowest.set(lowest, column);
    begins.delete(lowest);
    const [birth, death] = [highest(filtration[lowest]), highest(simplex)];
    if (birth !== death) pairs[filtration[lowest].length - 1].push([birth, death]);
  });
  const essential = [[], [], []];
  for (const k of begins) essential[filtration[k].length - 1].push(highest(filtration[k]));
  return { pairs, essential };
}

/** The steepest of the edges down (up) from v; v itself where there is none. */
export function steepest({ positions }, around, values, v, down) {
  const at = (j) => positions.slice(3 * j, 3 * j + 3);
  const slope = (j) => Math.abs(values[j] - values[v]) / Math.hypot(...at(j).map((x, axis) => x - at(v)[axis]));
  const there = around[v].filter((j) => isBelow(values, j, v) === down);
  return there.reduce((best, j) => {
    if (best === v) return j;
    const more = slope(j) - slope(best);
    return more > 0 || (more === 0 && isBelow(values, j, best) === down) ? j : best;
  }, v);
}

/** The critical vertices at δ = 0 of a closed surface, ascending. */
export function criticalVertices(shape, values) {
  const [lower, upper] = [true, false].map((down) => linkParts(shape, values, down));
  return [...lower.keys()].filter((v) => lower[v] !== 1 || upper[v] !== 1);
}

export const transpose = (matrix) => matrix[0].map((_, j) => matrix.map((row) => row[j]));

export function multiply(a, b) {
  const columns = transpose(b);
  return a.map((row) => columns.map((column) => dot(row, column)));
}

/** The solution of a dense system, by Gaussian elimination with pivots. */
export function solve(matrix, right) {
  const rows = matrix.map((row, i) => [...row, right[i]]);
  const n = rows.length;
  for (let k = 0; k < n; k++) {
    let pivot = k;
    for (let i = k + 1; i < n; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[pivot][k])) pivot = i;
    [rows[k], rows[pivot]] = [rows[pivot], rows[k]];
    for (let i = k + 1; i < n; i++) {
      const factor = rows[i][k] / rows[k][k];
      for (let j = k; j <= n; j++) rows[i][j] -= factor * rows[k][j];
    }
  }
  const x = new Array(n);
  for (let k = n - 1; k >= 0; k--) {
    let rest = rows[k][n];
    for (let j = k + 1; j < n; j++) rest -= rows[k][j] * x[j];
    x[k] = rest / rows[k][k];
  }
  return x;
}

/** The vector x with x = values on `fixed`, and (matrix x)_i = 0 elsewhere. */
export function interpolated(matrix, values, fixed) {
  const free = matrix.map((_, i) => i).filter((i) => !fixed.includes(i));
  const right = free.map((i) => -fixed.reduce((sum, j) => sum + matrix[i][j] * values[j], 0));
  const inner = solve(
    free.map((i) => free.map((j) => matrix[i][j])),
    right,
  );
  const x = [...values];
  free.forEach((i, k) => (x[i] = inner[k]));
  return x;
}

const norm = (x) => Math.sqrt(dot(x, x));

/** The greatest eigenvalue of a positive semi-definite map of n numbers, from below, by power iteration. */
function greatest(n, map) {
  let x = Array.from({ length: n }, (_, i) => Math.sin(i + 1));
  let eigenvalue = 0;
  for (let time = 0; time < 300; time++) {
    const length = norm(x);
    x = map(x.map((entry) => entry / length));
    eigenvalue = norm(x);
  }
  return eigenvalue;
}

/** ‖matrix‖₂ */
export function spectralNorm(matrix) {
  const transposed = transpose(matrix);
  return Math.sqrt(greatest(matrix[0].length, (x) => apply(transposed, apply(matrix, x))));
}

/** The least singular value of a matrix that has an inverse. */
export function leastSingularValue(matrix) {
  const transposed = transpose(matrix);
  return 1 / Math.sqrt(greatest(matrix.length, (x) => solve(matrix, solve(transposed, x))));
}
