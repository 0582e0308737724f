// Errors of calls in a worker: the same as without one, whatever comes in, and the connection goes on.
import init, { MorseSmoothError, Smoother, TriMesh, smooth } from 'morse-smooth';
import initFiles, * as files from 'morse-smooth/files';
import initPictures, * as pictures from 'morse-smooth/snapshot';
import * as worker from 'morse-smooth/worker';
import { connect } from 'morse-smooth/worker';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { fromReport, toReport } from '../../src/js/api/worker/reports.js';
import types from '../../src/js/types/package.d.ts?raw';
import { expectRejection } from './errors.js';
import { heights, islands, octahedron, random, sphere, square, text } from './meshes.js';
import { same } from './same.js';
import { wasmBytes, withPages, withTrap } from './wasm-bytes.js';

const shape = sphere(2);
const values = heights(shape);
const bumpy = Float64Array.from({ length: values.length }, random(7));

let remote;
beforeAll(async () => {
  await Promise.all([init(), initFiles(), initPictures()]);
  remote = await connect();
});
afterAll(() => remote.close());

/** What is called alike here and there: what differs is how objects are made. */
const here = {
  mesh: (...given) => new TriMesh(...given),
  smoother: (...given) => new Smoother(...given),
  scene: (...given) => new pictures.Scene(...given),
  smooth,
  ...files,
  ...pictures,
};
const there = (remote) => ({
  ...remote,
  mesh: remote.createMesh,
  smoother: remote.createSmoother,
  scene: remote.createScene,
});

async function failureOf(action, api) {
  try {
    await action(api);
  } catch (error) {
    expect(error).toBeInstanceOf(MorseSmoothError);
    const { name, code, message, detail } = error;
    return { name, code, message, detail };
  }
  return null;
}

const onMesh = (call) => async (api) => call(await api.mesh(shape.positions, shape.triangles), api);
const onSmoother = (call) => onMesh(async (mesh, api) => call(await api.smoother(mesh), mesh));
const onIslands = (call) => async (api) => {
  const { positions, triangles } = islands();
  return call(await api.smoother(await api.mesh(positions, triangles)), heights(islands()));
};
const set = (field, vertex, value) => field.with(vertex, value);

/** Calls that fail, by the code that they fail with. */
const failing = {
  EmptyFile: (api) => api.readMesh(new Uint8Array()),
  UnknownFormat: (api) => api.readMesh(text('?')),
  UnsupportedFormat: (api) => api.writeMesh(octahedron(), { format: 'vtu' }),
  DamagedData: (api) => api.readTable(text('1'), { format: 'npy' }),
  AmbiguousColumn: (api) => api.readField(text('a,b\n1,2\n')),
  WrongRowCount: (api) => api.readField(text('1\n2\n'), { vertices: 3 }),
  Truncated: (api) => api.readMesh(text('OFF\n3 1 0\n0 0 0\n')),
  InvalidNumber: (api) => api.readField(text('1\ntwo\n3\n')),
  UnknownColumn: (api) => api.readField(text('a,b\n1,2\n'), { column: 'c' }),
  FieldsNotSupported: (api) => api.writeMesh(octahedron(), { format: 'off', fields: { a: values } }),
  BinaryNotSupported: (api) => api.writeMesh(octahedron(), { format: 'obj', binary: true }),
  EmptyMesh: (api) => api.mesh([], []),
  PositionsNotTriples: (api) => api.mesh([1, 2], []),
  TrianglesNotTriples: (api) => api.mesh([1, 2, 3], [0, 0]),
  NonFinitePosition: (api) => api.mesh([0, 0, NaN, 1, 0, 0, 0, 1, 0], [0, 1, 2]),
  IndexOutOfBounds: (api) => api.mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 7]),
  LengthMismatch: onMesh((mesh) => mesh.criticalPoints([1, 2])),
  NonFiniteValue: onMesh((mesh) => mesh.persistence(set(values, 5, Infinity))),
  MissingValue: onMesh((mesh) => mesh.constrainedVertices(set(values, 5, NaN), [5], { missing: 'omit' })),
  RangeOverflow: onMesh((mesh) => mesh.criticalPoints(values.map((_, k) => (k % 2 ? 1.7e308 : -1.7e308)))),
  NonFiniteLevel: onMesh((mesh) => mesh.levelSets(values, [0, NaN])),
  NotAnExtremum: onMesh((mesh) => mesh.simplify(values, { keep: [10] })),
  Unconstrained: onIslands((smoother, field) => smoother.interpolate(field, { constraints: [0] })),
  InvalidWeight: onSmoother((smoother) =>
    smoother.leastSquares(values, { epsilon: 1, constraints: [1, 2], weights: [1, -1] }),
  ),
  ConflictingExtremum: onSmoother((smoother) =>
    smoother.prescribe(values, { epsilon: 1, extrema: { minima: [1], maxima: [1] } }),
  ),
  TooFewExtrema: onSmoother((smoother) =>
    smoother.prescribe(values, { epsilon: 1, extrema: { from: 'persistence', minima: 9, maxima: 9 } }),
  ),
  ConstantField: onSmoother((smoother) =>
    smoother.prescribe(
      values.map(() => 1),
      { epsilon: 1 },
    ),
  ),
  UnknownOption: onMesh((mesh) => mesh.criticalPoints(values, { epsilon: 1 })),
  InvalidOption: onMesh((mesh) => mesh.criticalPoints(values, { delta: -1 })),
  InapplicableOption: onSmoother((smoother) => smoother.tikhonov(values, { cutoffWavelength: 1 })),
  InvalidArgument: onMesh((mesh) => mesh.criticalPoints('values')),
  Cancelled: onSmoother((smoother) => smoother.tikhonov(values, { epsilon: 1, onProgress: () => false })),
  OutOfMemory: async (api) => {
    const { positions, triangles } = square(150);
    const mesh = await api.mesh(positions, triangles);
    return mesh.levelSets(Float64Array.from({ length: 151 * 151 }, random(1)), { count: 10_000 });
  },
  UseAfterFree: onMesh((mesh) => (mesh.free(), mesh.persistence(values))),
};

describe('an error', () => {
  it.each(Object.keys(failing))('%s arrives as it is', async (code) => {
    const expected = await failureOf(failing[code], here);
    expect(expected?.code).toBe(code);
    expect(await failureOf(failing[code], there(remote))).toEqual(expected);
  });

  it('has any of the codes that there are, with code, message, detail and cause', () => {
    const list = types.slice(types.indexOf('Names the failure'), types.indexOf('readonly code'));
    const codes = [...list.matchAll(/`([A-Z]\w+)`/g)].map(([, code]) => code);
    expect(codes).toEqual(expect.arrayContaining([...Object.keys(failing), 'ConnectionClosed', 'WorkerLost']));
    for (const code of codes) {
      const detail = { vertex: 3, expected: 'a, b', list: [1, 2], nothing: null };
      const error = new MorseSmoothError(code, `about ${code}`, detail, { cause: new RangeError('deep') });
      const arrived = fromReport(structuredClone(toReport(error)));
      expect(arrived).toMatchObject({ name: 'MorseSmoothError', code, message: `about ${code}`, detail });
      expect(arrived.cause).toBe('RangeError: deep');
    }
    // What is no error of this package is a defect of ours.
    for (const thrown of [new TypeError('x is not a function'), 'text', null])
      expect(fromReport(structuredClone(toReport(thrown)))).toMatchObject({ code: 'InternalError' });
    expect(worker.MorseSmoothError).toBe(MorseSmoothError);
  });

  it.each([
    ['lists of something else', (mesh) => mesh.criticalPoints([1, 'a'])],
    ['holes', (mesh) => mesh.criticalPoints([1, , 3])], // eslint-disable-line no-sparse-arrays
    ['nothing', (mesh) => mesh.criticalPoints()],
    ['null', (mesh) => mesh.criticalPoints(null)],
    ['big integers', (mesh) => mesh.criticalPoints(new BigInt64Array(4))],
    ['a DataView', (mesh) => mesh.criticalPoints(new DataView(new ArrayBuffer(8)))],
    ['a function', (mesh) => mesh.criticalPoints(() => values)],
    ['a symbol', (mesh) => mesh.criticalPoints(Symbol('values'))],
    ['functions in a list', (mesh) => mesh.criticalPoints([() => 1])],
    ['a map', (mesh) => mesh.criticalPoints(values, new Map([['delta', 1]]))],
    ['an object of a class', (mesh) => mesh.criticalPoints(values, new (class Options {})())],
    ['options that are none', (mesh) => mesh.criticalPoints(values, 'delta')],
    ['a function as an option', (mesh) => mesh.criticalPoints(values, { delta: () => 1 })],
    ['a symbol as an option', (mesh) => mesh.criticalPoints(values, { link: Symbol('skip') })],
    ['a mesh as values', (mesh) => mesh.criticalPoints(mesh)],
    ['a promise', (mesh) => mesh.criticalPoints(Promise.resolve(values))],
    ['a class as levels', (mesh) => mesh.levelSets(values, new (class Levels {})())],
    ['bad progress', (mesh) => mesh.criticalPoints(values, { onProgress: 'tell me' })],
    ['no mesh', (mesh, api) => api.smoother({})],
    ['no mesh at all', (mesh, api) => api.smooth()],
  ])('of %s is the same', async (_, call) => {
    const expected = await failureOf(onMesh(call), here);
    expect(expected?.code).toMatch(/^[A-Z]/);
    const found = await failureOf(onMesh(call), there(remote));
    // Of a mesh, what is expected is said in other words.
    expect({ ...found, message: '' }).toEqual({ ...expected, message: '' });
  });

  it('of input that has no equal is told, too', async () => {
    const mesh = await remote.createMesh(shape.positions, shape.triangles);
    const gone = new Float64Array(4);
    structuredClone(gone, { transfer: [gone.buffer] });
    const expected = await failureOf(
      onMesh((mesh) => mesh.criticalPoints(gone)),
      here,
    );
    expect(await failureOf(() => mesh.criticalPoints(gone))).toEqual(expected);
    const circle = {};
    circle.circle = circle;
    await expectRejection(mesh.criticalPoints(values, circle), 'UnknownOption', { option: 'circle' });
    const mine = new RangeError('mine');
    const trap = {
      get delta() {
        throw mine;
      },
    };
    await expect(mesh.criticalPoints(values, trap)).rejects.toBe(mine);
    await expectRejection(mesh.positions({ missing: 'omit' }), 'UnknownOption', { option: 'missing' });
    await expectRejection(mesh.positions(5), 'InvalidArgument', { argument: 'options' });
    await expectRejection(mesh.criticalPoints(values, { signal: {} }), 'InvalidOption', { option: 'signal' });
    await expectRejection(mesh.criticalPoints(values, { latest: 1 }), 'InvalidOption', { option: 'latest' });
    await expectRejection(mesh.criticalPoints(values, { transfer: [] }), 'InvalidOption', { option: 'transfer' });
    await expectRejection(mesh.criticalPoints.call({}, values), 'InvalidArgument', { argument: 'this' });
    expect((await mesh.criticalPoints(values)).counts.maxima).toBe(1);
  });

  it('of `connect` is told', async () => {
    await expectRejection(connect({ pool: 2 }), 'UnknownOption', { option: 'pool' });
    await expectRejection(connect({ wasm: { other: 'x' } }), 'UnknownOption', { option: 'wasm.other' });
    await expectRejection(connect('x'), 'InvalidArgument', { argument: 'options' });
    await expectRejection(connect({ worker: 'worker.js' }), 'InvalidOption', { option: 'worker' });
    for (const workers of [0, 1.5, '2', 65])
      await expectRejection(connect({ workers }), 'InvalidOption', { option: 'workers' });
    const one = { postMessage() {}, terminate() {} };
    await expectRejection(connect({ worker: one, workers: 2 }), 'InapplicableOption', { option: 'workers' });
    await expectRejection(connect({ signal: 'x' }), 'InvalidOption', { option: 'signal' });
    await expectRejection(connect({ wasm: { core: Uint8Array.of(1, 2) } }), 'LoadFailed');
    await expectRejection(connect({ wasm: { core: await wasmBytes('morse_smooth_files_bg.wasm') } }), 'LoadFailed');
    await expectRejection(connect({ wasm: { core: 5 } }), 'InvalidOption', { option: 'wasm' });
  });

  it('of a module that cannot be loaded later is one of that call', async () => {
    const other = await connect({ wasm: { snapshot: Uint8Array.of(1, 2, 3) } });
    await expectRejection(other.createScene(shape.positions, shape.triangles), 'LoadFailed');
    const mesh = await other.createMesh(shape.positions, shape.triangles);
    expect(mesh.vertexCount).toBe(values.length);
    other.close();
  });
});

describe('a worker', () => {
  it('whose module fails is followed by another, with the same objects', async () => {
    const core = withTrap(await wasmBytes(), 'rawtrimesh_basins');
    const other = await connect({ wasm: { core } });
    const mesh = await other.createMesh(shape.positions, shape.triangles);
    const smoother = await other.createSmoother(mesh);
    const expected = await smoother.tikhonov(bumpy, { epsilon: 0.1 });
    await expectRejection(mesh.basins(bumpy), 'InternalError');
    expect(same(await smoother.tikhonov(bumpy, { epsilon: 0.1 }), expected)).toBe(true);
    await expectRejection(mesh.basins(bumpy), 'InternalError');
    const all = [mesh.persistence(bumpy), mesh.basins(bumpy), smoother.tikhonov(bumpy, { epsilon: 0.1 })];
    const [first, second, third] = await Promise.allSettled(all);
    expect(first.value.kinds.length).toBeGreaterThan(1);
    expect(second.reason.code).toBe('InternalError');
    expect(same(third.value, expected)).toBe(true);
    other.close();
  });

  it('that is short of memory says so and goes on', async () => {
    const other = await connect({ wasm: { core: withPages(await wasmBytes(), 1024) } });
    const { positions, triangles } = square(60);
    const field = Float64Array.from({ length: 61 * 61 }, random(2));
    const meshes = [await other.createMesh(positions, triangles)];
    const expected = await meshes[0].persistence(field);
    let error = null;
    while (error === null && meshes.length < 1000)
      await other.createMesh(positions, triangles).then(
        (mesh) => meshes.push(mesh),
        (thrown) => (error = thrown),
      );
    expect(error).toMatchObject({ code: 'OutOfMemory', detail: { bytes: expect.any(Number) } });
    for (const mesh of meshes.splice(1)) mesh.free();
    expect(same(await meshes[0].persistence(field), expected)).toBe(true);
    // There is room again.
    meshes.push(await other.createMesh(positions, triangles));
    expect(same(await meshes[1].persistence(field), expected)).toBe(true);
    other.close();
  });
});
