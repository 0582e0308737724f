// Critical points of a million vertices, at δ = 0 and for all δ, beside sorting as many numbers: the aim is to be faster than the
// sort.
import { TriMesh } from '../dist/node.mjs';

const [AROUND, ACROSS] = [1250, 800];
const ROUNDS = 7;

function torus() {
  const positions = new Float64Array(3 * AROUND * ACROSS);
  const triangles = new Uint32Array(6 * AROUND * ACROSS);
  for (let i = 0, vertex = 0; i < AROUND; i++) {
    for (let j = 0; j < ACROSS; j++, vertex++) {
      const [u, v] = [(2 * Math.PI * i) / AROUND, (2 * Math.PI * j) / ACROSS];
      const radius = 2 + Math.cos(v);
      positions.set([radius * Math.cos(u), radius * Math.sin(u), Math.sin(v)], 3 * vertex);
      const [a, b, k] = [i * ACROSS, ((i + 1) % AROUND) * ACROSS, (j + 1) % ACROSS];
      triangles.set([a + j, b + j, b + k, a + j, b + k, a + k], 6 * vertex);
    }
  }
  return { positions, triangles };
}

/** Height plus noise from a generator with a fixed seed. */
function noisyHeight(positions) {
  let state = 1;
  const values = new Float64Array(positions.length / 3);
  for (let i = 0; i < values.length; i++) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    values[i] = positions[3 * i] + 0.1 * (state / 2 ** 32 - 0.5);
  }
  return values;
}

function time(work) {
  const since = performance.now();
  const result = work();
  return { result, milliseconds: performance.now() - since };
}

const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

const { positions, triangles } = torus();
const values = noisyHeight(positions);
const built = time(() => new TriMesh(positions, triangles));
const mesh = built.result;

const classify = () => mesh.criticalPoints(values).counts;
const hierarchy = (link) => mesh.deltaHierarchy(values, { link }).delta.length;
const counts = classify();
const rows = hierarchy('consecutive');
const times = { classify: [], consecutive: [], skip: [], sort: [] };
for (let round = 0; round < ROUNDS; round++) {
  times.classify.push(time(classify).milliseconds);
  for (const link of ['consecutive', 'skip']) times[link].push(time(() => hierarchy(link)).milliseconds);
  const copy = values.slice();
  times.sort.push(time(() => copy.sort()).milliseconds);
}

const count = mesh.vertexCount;
const [classified, ordered, skipped, sorted] = Object.values(times).map(median);
const line = (what, text) => console.log(`${what.padEnd(36)}${text}`);
const rate = (milliseconds) =>
  `${milliseconds.toFixed(0).padStart(6)} ms${(count / milliseconds / 1000).toFixed(1).padStart(8)} M/s`;
line('mesh', `${count} vertices, ${mesh.triangleCount} triangles, made in ${built.milliseconds.toFixed(0)} ms`);
line(
  'critical points',
  `${counts.minima} minima, ${counts.saddles} saddles, ${counts.maxima} maxima, index sum ${counts.indexSum}`,
);
line(`criticalPoints, median of ${ROUNDS}`, rate(classified));
line('δ hierarchy', `${rows} rows of the curve`);
line(`deltaHierarchy, median of ${ROUNDS}`, rate(ordered));
line('deltaHierarchy with link skip', rate(skipped));
line(`Float64Array.sort, median of ${ROUNDS}`, rate(sorted));
line('criticalPoints / sort', `${(classified / sorted).toFixed(2)} (below 1: faster than sorting)`);
line('deltaHierarchy / sort', (ordered / sorted).toFixed(2));
