import initCore, { MorseSmoothError as CoreError, TriMesh } from 'morse-smooth';
import init, { MorseSmoothError, Scene, sheet, snapshot } from 'morse-smooth/snapshot';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { random, square, tetrahedron } from './meshes.js';
import { field, header, shape, small } from './pictures.js';

const { positions, triangles } = shape;
const vertexCount = positions.length / 3;
let scene;
let mesh;
const draw = (options) => scene.snapshot(field, { ...small, ...options });

beforeAll(async () => {
  await Promise.all([init(), initCore()]);
  scene = new Scene(positions, triangles);
  mesh = new TriMesh(positions, triangles);
});

describe('a snapshot', () => {
  it.each([
    [1200, 900, undefined],
    [1200, 900, {}],
    [1200, 900, { width: undefined, height: null }],
    [300, 900, { width: 300 }],
    [1200, 40, { height: 40 }],
    [1, 1, { width: 1, height: 1 }],
    [8192, 1, { width: 8192, height: 1 }],
    [1, 8192, { width: 1, height: 8192 }],
    [123, 457, { width: 123, height: 457 }],
  ])('is a PNG file of %i × %i pixels with %o', (width, height, options) => {
    const png = snapshot(positions, triangles, field, options);
    expect(png).toBeInstanceOf(Uint8Array);
    expect(header(png)).toEqual({ width, height, bits: 8, colorType: 2 });
    // As long as its buffer: no view of the module's memory, which would go stale.
    expect(png.byteLength).toBe(png.buffer.byteLength);
  });

  it('is the same every time, once or from a scene', () => {
    const first = snapshot(positions, triangles, field, small);
    expect(draw()).toEqual(first);
    const other = scene.snapshot(field.map(Math.cos), { width: 50 });
    expect(draw()).toEqual(first);
    expect(scene.snapshot(field.map(Math.cos), { width: 50 })).toEqual(other);
    expect(other).not.toEqual(first);
  });

  it('is the same from every kind of numbers', () => {
    const [places, values] = [Float32Array.from(positions), Float32Array.from(field)];
    const expected = snapshot(Float64Array.from(places), Uint32Array.from(triangles), Float64Array.from(values), small);
    expect(snapshot([...places], triangles, [...values], small)).toEqual(expected);
    expect(snapshot(places, Uint16Array.from(triangles), values, small)).toEqual(expected);
    expect(Array.from(places)).toEqual(Array.from(Float32Array.from(positions)));
  });

  it('has the defaults of the types', () => {
    const defaults = {
      width: 1200,
      height: 900,
      colormap: 'viridis',
      range: [Math.min(...field), Math.max(...field)],
      levels: { count: 15 },
      bands: false,
      criticalPoints: true,
      morseComplex: false,
      colorBar: true,
      title: '',
      camera: {},
    };
    const png = scene.snapshot(field);
    expect(scene.snapshot(field, defaults)).toEqual(png);
    for (const nothing of [undefined, null]) {
      const options = Object.fromEntries(Object.keys(defaults).map((name) => [name, nothing]));
      expect(scene.snapshot(field, options)).toEqual(png);
    }
    expect(draw({ camera: { direction: undefined, up: null } })).toEqual(draw());
  });

  it.each([
    { width: 121 },
    { colormap: 'cividis' },
    { range: [-1, 2] },
    { levels: { count: 3 } },
    { levels: [0.5] },
    { levels: [] },
    { bands: true },
    { criticalPoints: false },
    { morseComplex: true },
    { morseComplex: { persistence: 0.1 } },
    { camera: { direction: [0, 0, 1] } },
    { camera: { up: [1, 0, 0] } },
  ])('is another one with %o', (options) => {
    expect(draw(options)).not.toEqual(draw());
  });

  it('of every color map is a picture of its own', () => {
    const names = ['viridis', 'cividis', 'magma', 'inferno', 'plasma', 'coolWarm', 'blueRed', 'purpleGreen'];
    const pictures = names.map((colormap) => draw({ colormap }).join());
    expect(new Set(pictures).size).toBe(names.length);
  });

  it('takes directions of any length', () => {
    const expected = draw({ camera: { direction: [1, -2, 3], up: [0, 1, 1] } });
    for (const size of [2 ** -500, 0.25, 2 ** 900]) {
      const direction = Float64Array.of(size, -2 * size, 3 * size);
      expect(draw({ camera: { direction, up: [0, size, size] } })).toEqual(expected);
    }
  });

  it('is drawn of a constant field', () => {
    expect(header(scene.snapshot(new Float64Array(vertexCount).fill(7), small))).toMatchObject(small);
  });
});

describe('what TriMesh has found', () => {
  const levels = [-1.5, -0.25, 0, 0.125, 2];

  it('is drawn as if it were found here', () => {
    expect(draw({ criticalPoints: mesh.criticalPoints(field) })).toEqual(draw());
    expect(draw({ levels: mesh.levelSets(field, levels) })).toEqual(draw({ levels }));
    expect(draw({ bands: true, levels: mesh.levelSets(field, levels) })).toEqual(draw({ bands: true, levels }));
    for (const persistence of [0, 0.2]) {
      const morseComplex = mesh.morseComplex(field, { persistence, paths: 'merged' });
      expect(draw({ morseComplex })).toEqual(draw({ morseComplex: { persistence } }));
      if (persistence === 0) expect(draw({ morseComplex })).toEqual(draw({ morseComplex: true }));
    }
  });

  it('may have come by a message, or be made by hand', () => {
    const { vertices, kinds } = mesh.criticalPoints(field);
    const { points, offsets, levels: at, closed } = mesh.levelSets(field, levels);
    const complex = mesh.morseComplex(field);
    const cloned = structuredClone({ criticalPoints: { vertices, kinds }, morseComplex: complex });
    const made = {
      criticalPoints: { vertices: [...vertices], kinds },
      morseComplex: { vertices: [...complex.vertices], offsets: [...complex.offsets], kinds: complex.kinds },
    };
    expect(draw(made)).toEqual(draw(cloned));
    const lines = { points: [...points], offsets: [...offsets], levels: [...at], closed };
    expect(draw({ levels: lines })).toEqual(draw({ levels }));
  });

  it('may be part of what there is, or nothing', () => {
    const { vertices, kinds } = mesh.criticalPoints(field);
    const some = draw({ criticalPoints: { vertices: vertices.slice(1), kinds: kinds.slice(1) } });
    expect(some).not.toEqual(draw());
    const none = { vertices: [], kinds: new Int8Array() };
    expect(draw({ criticalPoints: none })).toEqual(draw({ criticalPoints: false }));
    const lines = { points: [], offsets: [0], levels: [], closed: new Uint8Array() };
    expect(draw({ levels: lines })).toEqual(draw({ levels: [] }));
    expect(draw({ morseComplex: { vertices: [], offsets: [0], kinds: new Int8Array() } })).toEqual(draw());
  });
});

describe('a sheet', () => {
  const after = field.map((value) => 0.8 * value);
  const own = (options) => scene.sheet(field, after, { ...small, ...options });

  it('is a PNG file with three pictures beside each other', () => {
    const png = own();
    const { width, height, bits, colorType } = header(png);
    expect([bits, colorType]).toEqual([8, 2]);
    expect(width).toBeGreaterThanOrEqual(3 * small.width);
    expect(height).toBeGreaterThanOrEqual(small.height);
    expect(sheet(positions, triangles, field, after, small)).toEqual(png);
    expect(header(scene.sheet(field, after)).width).toBeGreaterThanOrEqual(1800);
  });

  it('has the defaults of the types', () => {
    const defaults = {
      titles: ['before', 'after', 'difference'],
      differenceColormap: 'coolWarm',
      largestDifference: Math.max(...after.map((value, vertex) => Math.abs(value - field[vertex]))),
    };
    expect(own(defaults)).toEqual(own());
    expect(own({ titles: null, differenceColormap: undefined, largestDifference: null })).toEqual(own());
  });

  it.each([
    { differenceColormap: 'purpleGreen' },
    { largestDifference: 10 },
    { colormap: 'magma' },
    { range: [-9, 9] },
    { levels: [0] },
    { camera: { direction: [0, 0, 1] } },
  ])('is another one with %o', (options) => {
    expect(own(options)).not.toEqual(own());
  });

  it('has nothing of one field only', () => {
    const found = {
      levels: mesh.levelSets(field, { count: 3 }),
      criticalPoints: mesh.criticalPoints(field),
      morseComplex: mesh.morseComplex(field),
    };
    for (const [option, value] of Object.entries(found)) {
      expectError(() => own({ [option]: value }), 'InapplicableOption', { option });
    }
  });

  it('refuses fields that do not fit', () => {
    const call = (before, later) => () => scene.sheet(before, later, small);
    expectError(call(field, [1, 2]), 'LengthMismatch', { expected: vertexCount, actual: 2 });
    expectError(call(field.with(3, NaN), after), 'NonFiniteValue', { vertex: 3 });
    expectError(call(field, after.with(5, Infinity)), 'NonFiniteValue', { vertex: 5 });
    expectError(call('x', after), 'InvalidArgument', { argument: 'before' });
    expectError(call(field, null), 'InvalidArgument', { argument: 'after' });
    expectError(call(field), 'InvalidArgument', { argument: 'after' });
  });
});

describe('a scene', () => {
  it('refuses meshes as TriMesh does', () => {
    const { positions, triangles } = tetrahedron();
    const make = (places, ids) => () => new Scene(places, ids);
    expectError(make([], []), 'EmptyMesh');
    expectError(make(positions, []), 'EmptyMesh');
    expectError(make(positions.with(5, NaN), triangles), 'NonFinitePosition', { vertex: 1 });
    expectError(make(positions.slice(1), triangles), 'PositionsNotTriples', { length: 11 });
    expectError(make(positions, triangles.slice(1)), 'TrianglesNotTriples', { length: 11 });
    expectError(make(positions, triangles.with(11, 4)), 'IndexOutOfBounds', { triangle: 3, index: 4, vertices: 4 });
    expectError(make(positions, triangles.with(11, -1)), 'IndexOutOfBounds', { triangle: 3, index: -1 });
    for (const bad of [undefined, null, 'x', {}, new Map(), new BigInt64Array(12)]) {
      expectError(make(bad, triangles), 'InvalidArgument', { argument: 'positions' });
      expectError(make(positions, bad), 'InvalidArgument', { argument: 'triangles' });
      expectError(() => snapshot(bad, triangles, [1, 2, 3, 4]), 'InvalidArgument', { argument: 'positions' });
      expectError(() => sheet(positions, bad, [1, 2, 3, 4], [1, 2, 3, 4]), 'InvalidArgument', {
        argument: 'triangles',
      });
    }
    expectError(make(new TriMesh(positions, triangles)), 'InvalidArgument', { argument: 'positions' });
  });

  it('refuses values as TriMesh does', () => {
    const { positions, triangles } = tetrahedron();
    const own = new Scene(positions, triangles);
    const methods = [
      (values) => own.snapshot(values, small),
      (values) => own.sheet(values, values, small),
      (values) => own.drawList(values),
      (values) => snapshot(positions, triangles, values, small),
    ];
    for (const method of methods) {
      expectError(() => method([1, 2, 3]), 'LengthMismatch', { expected: 4, actual: 3 });
      expectError(() => method(new Float32Array(5)), 'LengthMismatch', { expected: 4, actual: 5 });
      expectError(() => method([1, 2, NaN, 4]), 'NonFiniteValue', { vertex: 2 });
      expectError(() => method([1, 2, 3, -Infinity]), 'NonFiniteValue', { vertex: 3 });
      expectError(() => method([1e308, -1e308, 0, 0]), 'RangeOverflow');
      for (const bad of ['1234', undefined, null, {}, new BigInt64Array(4), [1, 2, 3, 4n]]) {
        expectError(() => method(bad), 'InvalidArgument');
      }
      expect(() => method([1, 2, 3, 4])).not.toThrow();
    }
  });

  it('copies what it is given', () => {
    const [places, ids] = [Float64Array.from(positions), Uint32Array.from(triangles)];
    const own = new Scene(places, ids);
    places.fill(0);
    ids.fill(0);
    expect(own.snapshot(field, small)).toEqual(draw());
  });

  it('takes meshes with boundary, of no thickness, and with isolated vertices', () => {
    const flat = square(4);
    const noise = Float64Array.from({ length: 26 }, random(3));
    const own = new Scene([...flat.positions, 9, 9, 9], flat.triangles);
    expect(header(own.snapshot(noise, small))).toMatchObject(small);
  });

  it('ends with free, once or twice', () => {
    const own = new Scene(positions, triangles);
    own.free();
    own.free();
    const uses = [
      () => own.snapshot(field),
      () => own.sheet(field, field),
      () => own.surface(),
      () => own.drawList(field),
    ];
    for (const use of uses) expectError(use, 'UseAfterFree', { object: 'Scene' });
  });

  it('ends with dispose', () => {
    const own = new Scene(positions, triangles);
    own[Symbol.dispose]();
    expectError(() => own.surface(), 'UseAfterFree', { object: 'Scene' });
  });

  it('may be used by the getters of its options', () => {
    const own = new Scene(positions, triangles);
    const options = {
      ...small,
      get camera() {
        return {
          get up() {
            own.surface();
            return [0, 1, 0];
          },
        };
      },
    };
    expect(own.snapshot(field, options)).toEqual(draw({ camera: { up: [0, 1, 0] } }));
    const last = {
      get width() {
        own.free();
        return 3;
      },
    };
    expectError(() => own.snapshot(field, last), 'UseAfterFree', { object: 'Scene' });
  });
});

describe('failures', () => {
  it('are of one class with those of the main entry', () => {
    expect(MorseSmoothError).toBe(CoreError);
    expectError(() => draw({ width: 0 }), 'InvalidOption', { option: 'width' });
  });
});
