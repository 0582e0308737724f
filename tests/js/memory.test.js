// A module whose memory cannot grow beyond 64 megabytes: what does not fit is an error, and everything goes on.
import { beforeAll, describe, expect, it } from 'vitest';
// The entry for browsers, also in Node: it takes the code that it is given.
import init, { Smoother, TriMesh, smooth } from 'morse-smooth/inline';
import { random, square, tetrahedron } from './meshes.js';
import { same } from './same.js';
import { wasmBytes, withPages } from './wasm-bytes.js';

/** 64 MiB. */
const PAGES = 1024;
const LEVELS = 50;

beforeAll(async () => init({ wasm: withPages(await wasmBytes(), PAGES) }));

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const typed = ({ positions, triangles }) => ({
  positions: Float64Array.from(positions),
  triangles: Uint32Array.from(triangles),
});

/** The code of a failure, which must be a shortage of memory, or nothing. */
function shortage(call) {
  try {
    call();
    return null;
  } catch (error) {
    expect(error.code, error.message).toBe('OutOfMemory');
    expect(error.detail.bytes).toBeGreaterThan(0);
    return error;
  }
}

/** Meshes of one shape until no more fits. */
function fill(shape, meshes = []) {
  while (shortage(() => meshes.push(make(shape))) === null);
  return meshes;
}

const small = typed(square(10));
const middle = typed(square(40));
const field = Float64Array.from({ length: 41 * 41 }, random(3));
const colors = Float64Array.from({ length: 3 * 41 * 41 }, random(4));
const constraints = { from: 'criticalPoints', delta: 0.4 };
/** A family that is soon there. */
const loose = { tolerance: 0.01, epsilonRange: [0.01, 1], factorizations: 2 };

/** Everything there is, by name: what it gives for a mesh. */
const calls = {
  'new TriMesh': () => freed(make(middle), (mesh) => mesh.vertexCount),
  'new TriMesh, welded': () =>
    freed(new TriMesh(middle.positions, middle.triangles, { weld: { tolerance: 1e-6 } }), (mesh) => mesh.vertexCount),
  'new TriMesh, a soup': () =>
    freed(new TriMesh(middle.positions.subarray(0, 9 * 500), null, { weld: true }), (mesh) => mesh.vertexMap()),
  positions: (mesh) => mesh.positions(),
  triangles: (mesh) => mesh.triangles(),
  topology: (mesh) => freed(make(middle), (other) => ({ ...other.topology, of: mesh.triangleCount })),
  warnings: (mesh) => mesh.warnings,
  withoutMissing: (mesh) => {
    const part = mesh.withoutMissing(field.with(700, NaN));
    return freed(part.mesh, (mesh) => [mesh.triangles(), part.vertices]);
  },
  criticalPoints: (mesh) => mesh.criticalPoints(field),
  'criticalPoints, δ': (mesh) => mesh.criticalPoints(field, { delta: 0.1, link: 'skip' }),
  'criticalPoints, missing': (mesh) => mesh.criticalPoints(field.with(700, NaN), { missing: 'omit' }),
  deltaHierarchy: (mesh) => mesh.deltaHierarchy(field),
  persistence: (mesh) => mesh.persistence(field),
  persistenceCurve: (mesh) => mesh.persistenceCurve(field),
  simplify: (mesh) => mesh.simplify(field, { threshold: 0.3 }),
  morseComplex: (mesh) => mesh.morseComplex(field),
  morseHierarchy: (mesh) => mesh.morseHierarchy(field),
  basins: (mesh) => mesh.basins(field, { persistence: 0.1 }),
  levelSets: (mesh) => mesh.levelSets(field, { count: 6 }),
  'levelSets, saddles': (mesh) => mesh.levelSets(field, { saddles: [100, 700] }),
  bands: (mesh) => mesh.bands(field, { count: 6 }),
  constrainedVertices: (mesh) => mesh.constrainedVertices(field, constraints),
  'constrainedVertices, k-means': (mesh) => mesh.constrainedVertices(field, { from: 'kMeans', clusters: 20 }),
  smoothness: (mesh) => mesh.smoothness(field),
  laplacian: (mesh) => mesh.laplacian(),
  'laplacian, intrinsic': (mesh) => mesh.laplacian({ weights: 'intrinsicDelaunay' }),
  mass: (mesh) => mesh.mass(),
  'new Smoother': (mesh) => freed(new Smoother(mesh), () => 0),
  tikhonov: (mesh) => freed(new Smoother(mesh), (smoother) => smoother.tikhonov(colors, { epsilon: 0.1, channels: 3 })),
  'tikhonov, cg': (mesh) => smooth(mesh, field, { epsilon: 0.1, solver: 'cg' }),
  'tikhonov, cholesky': (mesh) => smooth(mesh, field, { epsilon: 0.1, solver: 'cholesky', metric: 'lumped' }),
  'tikhonov, fem': (mesh) => smooth(mesh, field, { cutoffWavelength: 3, operator: 'fem', bounds: true }),
  interpolate: (mesh) => smooth(mesh, field, { method: 'interpolate', constraints }),
  'interpolate, biharmonic': (mesh) =>
    smooth(mesh, field, { method: 'interpolate', constraints, energy: 'biharmonic' }),
  leastSquares: (mesh) => smooth(mesh, field, { epsilon: 1, constraints }),
  prescribe: (mesh) => smooth(mesh, field, { method: 'prescribe', epsilon: 0.1 }),
  family: (mesh) =>
    freed(new Smoother(mesh), (smoother) =>
      freed(smoother.family(field, loose), (family) => {
        const found = [family.choose().rule, family.lives({ perDecade: 1 }).kinds.length > 0, family.sweep().epsilons];
        return [...found, [...family.values(0.1)].map((value) => value.toFixed(1))];
      }),
    ),
  lowPass: (mesh) => freed(new Smoother(mesh), (smoother) => smoother.lowPass(field, { iterations: 4 })),
  bilateral: (mesh) =>
    freed(new Smoother(mesh), (smoother) =>
      smoother.bilateral(field, { iterations: 2, radius: 2, sigmaDistance: 1, sigmaValue: 1 }),
    ),
};

/** What `read` finds out about an object, which is then freed. */
function freed(object, read) {
  try {
    return read(object);
  } finally {
    object.free();
  }
}

/** What does not depend on how much memory there is: with less, a system may be solved in another way. */
function comparable(result) {
  if (result?.report === undefined) return result;
  return { values: [...result.values].map((value) => value.toFixed(6)), before: result.report.before };
}

describe('memory that runs out', () => {
  it('leaves everything usable: meshes until none fits, one freed, and then every call', () => {
    const mesh = make(middle);
    const meshes = fill(typed(square(120)));
    expect(meshes.length).toBeGreaterThan(3);
    meshes.pop().free();
    for (const call of Object.values(calls)) call(mesh);
    for (const rest of meshes) rest.free();
    mesh.free();
  });

  it(`is a result or OutOfMemory at ${LEVELS} levels of free memory, whatever is called`, () => {
    const mesh = make(middle);
    const expected = Object.fromEntries(Object.entries(calls).map(([name, call]) => [name, comparable(call(mesh))]));
    // Full to the brim; then a little is freed at a time, of pieces small and large.
    const ballast = fill(small, fill(middle));
    const seen = Object.fromEntries(Object.keys(calls).map((name) => [name, { short: 0, done: 0 }]));
    for (let level = 0; level < LEVELS; level++) {
      for (const [name, call] of Object.entries(calls)) {
        let result;
        const error = shortage(() => {
          result = comparable(call(mesh));
        });
        if (error === null && !same(result, expected[name])) {
          expect(result, `${name} at level ${level}`).toEqual(expected[name]);
        }
        seen[name][error === null ? 'done' : 'short']++;
      }
      ballast.pop()?.free();
      if (level > 15) for (let k = 0; k < (level - 15) / 8; k++) ballast.shift()?.free();
    }
    // At the first levels there is room for nothing, at the last for everything.
    expect(Object.values(seen).filter(({ short }) => short > 0).length).toBeGreaterThan(30);
    for (const [name, { done }] of Object.entries(seen)) expect(done, name).toBeGreaterThan(0);
    for (const rest of ballast) rest.free();
    for (const [name, call] of Object.entries(calls))
      expect(same(comparable(call(mesh)), expected[name]), name).toBe(true);
    mesh.free();
  });

  it('is given back, however often a call has none', () => {
    const large = typed(square(700));
    for (let k = 0; k < 50; k++) expect(shortage(() => make(large).free())).not.toBeNull();
    expect(freed(make(tetrahedron()), (mesh) => mesh.vertexCount)).toBe(4);
    for (const call of Object.values(calls)) freed(make(middle), call);
  });
});
