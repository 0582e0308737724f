// How long one waits for a call to end after saying stop, in a process of its own.
import { Smoother, TriMesh } from '../../dist/index.js';
import { loadWithMemory } from './memory-size.mjs';
import { noisyTorus } from './noisy-torus.mjs';

/** The long calls: `make` gives what is called, `(f, onProgress)` one call. Constraints are vertices spread over the mesh. */
export const CALLS = [
  ['criticalPoints', (mesh) => (f, onProgress) => mesh.criticalPoints(f, { onProgress })],
  ['deltaHierarchy, skip', (mesh) => (f, onProgress) => mesh.deltaHierarchy(f, { link: 'skip', onProgress })],
  ['persistence', (mesh) => (f, onProgress) => mesh.persistence(f, { onProgress })],
  ['simplify', (mesh) => (f, onProgress) => mesh.simplify(f, { threshold: 0.1, onProgress })],
  ['morseComplex', (mesh) => (f, onProgress) => mesh.morseComplex(f, { onProgress })],
  ['morseHierarchy', (mesh) => (f, onProgress) => mesh.morseHierarchy(f, { onProgress })],
  ['tikhonov (3)', smoothing({}, 'tikhonov', { epsilon: 0.01, metric: 'identity' })],
  ['tikhonov (5)', smoothing({}, 'tikhonov', { epsilon: 0.01 })],
  ['tikhonov (5), single', smoothing({ precision: 'single' }, 'tikhonov', { epsilon: 0.01 })],
  ['tikhonov (5), cg', smoothing({ solver: 'cg' }, 'tikhonov', { epsilon: 0.01 })],
  ['interpolate', constrained({}, 'interpolate', {})],
  ['interpolate, biharmonic', constrained({}, 'interpolate', { energy: 'biharmonic' })],
  ['leastSquares', constrained({}, 'leastSquares', { epsilon: 1 })],
  ['lowPass', smoothing({}, 'lowPass', { iterations: 50 })],
  ['bilateral', smoothing({}, 'bilateral', { iterations: 3, radius: 0.05, sigmaDistance: 0.03, sigmaValue: 0.1 })],
];

/** A new smoother for every call: ordering and analysis are part of it. */
function smoothing(options, method, settings) {
  return (mesh) => (f, onProgress) => {
    const smoother = new Smoother(mesh, { ...options, onProgress });
    try {
      return smoother[method](f, settings);
    } finally {
      smoother.free();
    }
  };
}

function constrained(options, method, settings) {
  return (mesh) => {
    const constraints = Uint32Array.from({ length: 200 }, (_, k) => Math.floor((k * mesh.vertexCount) / 200));
    return smoothing(options, method, { constraints, ...settings })(mesh);
  };
}

const pick = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];

/** Runs one call whole and stops it at places spread over its time. */
export async function run({ name, size, stops, repeats }) {
  const memory = await loadWithMemory();
  const { positions, triangles, values } = noisyTorus(...size);
  const mesh = new TriMesh(positions, triangles);
  const call = CALLS.find(([known]) => known === name)[1](mesh);

  const gaps = [];
  let last = performance.now();
  const since = last;
  call(values, () => {
    const now = performance.now();
    gaps.push(now - last);
    last = now;
  });
  const total = performance.now() - since;
  gaps.push(performance.now() - last);

  // From returning false to the error's arrival.
  const unwinding = [];
  const stopAt = (question) => {
    let count = 0;
    let said;
    try {
      call(values, () => {
        if (count++ !== question) return true;
        said = performance.now();
        return false;
      });
    } catch (error) {
      if (error.code !== 'Cancelled') throw error;
      unwinding.push(performance.now() - said);
    }
  };
  const questions = gaps.length - 1;
  for (let k = 0; k < stops; k++) stopAt(Math.floor((questions * k) / stops));
  const before = memory();
  for (let k = 0; k < repeats; k++) stopAt(Math.floor(questions * ((k * 0.618) % 1)));
  const lost = memory() - before;

  // Whoever says stop at any moment waits for the rest of the gap, and for the unwinding.
  const waits = [];
  for (const gap of gaps) for (let k = 0; k < gap; k += 0.5) waits.push(gap - k);
  waits.sort((a, b) => a - b);
  unwinding.sort((a, b) => a - b);
  const [median, worst] = [pick(waits, 0.5) + (pick(unwinding, 0.5) ?? 0), Math.max(...gaps) + (unwinding.at(-1) ?? 0)];
  return { total, questions, median, worst, lost, stopped: unwinding.length };
}
