// Whole calls of the package beside CHOLMOD on the real matrix of the same equation, and several channels beside one.
import { join } from 'node:path';
import { Stopwatch } from './clock.mjs';
import { runCholmod, writeSystem } from './cholmod.mjs';
import { principal, squared } from './matrices.mjs';
import { instantiate } from './peers.mjs';

const EPSILON = 1;
/** What somebody who drags a slider asks for next. */
const NEXT_EPSILON = 0.1;
export const CHANNELS = 8;

/** One vertex in so many is constrained, with its star. */
const SPARSENESS = 200;

/** `next` is left out where nothing depends on ε. */
export const EQUATIONS = [
  { system: 'A3', name: 'equation (3), metric identity', next: true },
  { system: 'A', name: 'equation (5), metric mass', next: true },
  { system: 'A7', name: 'equation (7), least squares', next: true },
  { system: 'L6', name: 'equation (6), harmonic' },
  { system: 'A6', name: 'equation (6), biharmonic' },
];

export async function run({ wasm, mesh: name, size, rounds, clock, cholmod, folder }) {
  const { Smoother, TriMesh } = await import('../../dist/node.mjs');
  const watch = new Stopwatch(clock);
  const instance = await instantiate(wasm, name, size);
  const mesh = new TriMesh(instance.array('positions').slice(), instance.array('triangles').slice());
  const n = mesh.vertexCount;
  instance.system('A3', EPSILON);
  const fields = instance.array('rightHandSides').slice();
  const field = fields.slice(0, n);
  const channels = interleaved(fields, n);
  const constraints = { from: 'vertices', vertices: spread(n) };
  const calls = {
    A3: (smoother, values, options) => smoother.tikhonov(values, { ...options, metric: 'identity' }),
    A: (smoother, values, options) => smoother.tikhonov(values, { ...options, metric: 'mass' }),
    A7: (smoother, values, options) => smoother.leastSquares(values, { ...options, constraints }),
    L6: (smoother, values, { epsilon, ...options }) => smoother.interpolate(values, { ...options, constraints }),
    A6: (smoother, values, { epsilon, ...options }) =>
      smoother.interpolate(values, { ...options, constraints, energy: 'biharmonic' }),
  };
  const files = cholmod
    ? write(instance, mesh, field, constraints, (system) => join(folder, `${name}-${size}-${system}.bin`))
    : {};
  for (let round = 0; round < rounds; round++) {
    for (const { system, next } of EQUATIONS) {
      const call = calls[system];
      const first = (values, options) => {
        const made = new Smoother(mesh);
        call(made, values, { epsilon: EPSILON, ...options });
        return made;
      };
      const smoother = watch.time(`${system}/first`, () => first(field));
      if (next) watch.time(`${system}/next`, () => call(smoother, field, { epsilon: NEXT_EPSILON }));
      smoother.free();
      watch.time(`${system}/channels`, () => first(channels, { channels: CHANNELS })).free();
      if (!files[system]) continue;
      const { analyse, factor, refactor, solve1 } = runCholmod(cholmod, files[system], clock);
      watch.add(`${system}/cholmod-first`, analyse + factor + solve1);
      watch.add(`${system}/cholmod-next`, refactor + solve1);
    }
  }
  return { samples: watch.samples, facts: { vertices: n } };
}

/** Writes the matrices, each with one right-hand side of its size: what it is does not matter to the time. */
function write(instance, mesh, field, constraints, path) {
  const files = {};
  const save = (system, matrix) => {
    files[system] = path(system);
    const unknowns = matrix.offsets.length - 1;
    writeSystem(files[system], { ...matrix, rightHandSides: field.slice(0, unknowns) });
  };
  for (const system of ['A3', 'A']) {
    instance.system(system, EPSILON);
    const { offsets, rows, values } = instance.matrix();
    save(system, { offsets: offsets.slice(), rows: rows.slice(), values: values.slice() });
  }
  const laplacian = mesh.laplacian();
  const fixed = mesh.constrainedVertices(field, constraints);
  const diagonal = new Float64Array(mesh.vertexCount);
  const free = new Uint8Array(mesh.vertexCount).fill(1);
  for (const v of fixed) [diagonal[v], free[v]] = [EPSILON, 0];
  save('A7', squared(laplacian, diagonal));
  save('L6', principal(laplacian, free));
  const { offsets, rows, values } = squared(laplacian, new Float64Array(mesh.vertexCount));
  const gram = { rows: mesh.vertexCount, columnPointers: offsets, rowIndices: rows, values };
  save('A6', principal(gram, free));
  return files;
}

/** Vertices all over the mesh, from a generator with a fixed seed. */
function spread(n) {
  const vertices = new Uint32Array(Math.ceil(n / SPARSENESS));
  let state = 1;
  for (let i = 0; i < vertices.length; i++) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    vertices[i] = Math.floor((state / 2 ** 32) * n);
  }
  return vertices;
}

function interleaved(fields, n) {
  const values = new Float64Array(n * CHANNELS);
  for (let c = 0; c < CHANNELS; c++) for (let i = 0; i < n; i++) values[i * CHANNELS + c] = fields[c * n + i];
  return values;
}
