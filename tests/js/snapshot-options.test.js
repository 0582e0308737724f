// Options of pictures that are refused: none of them may do harm.
import init, { MorseSmoothError, Scene, sheet, snapshot } from 'morse-smooth/snapshot';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { field, shape, small } from './pictures.js';

const { positions, triangles } = shape;
const vertices = positions.length / 3;
let scene;

beforeAll(async () => {
  await init();
  scene = new Scene(positions, triangles);
});

class Settings {
  direction = [1, 2, 3];
  vertices = Uint32Array.of(1);
  kinds = Int8Array.of(1);
  count = 3;
}
const notPlain = [new Settings(), new Map(), new Date(0), Object.create({ count: 3 }), () => ({}), 5, 'x', Symbol('x')];

/** Expects every function that draws to refuse the options. */
function refused(options, code, detail) {
  const uses = [
    () => scene.snapshot(field, options),
    () => snapshot(positions, triangles, field, options),
    () => scene.sheet(field, field, options),
    () => sheet(positions, triangles, field, field, options),
  ];
  for (const use of uses) expectError(use, code, detail);
}

describe('the options', () => {
  it('must be a plain object', () => {
    for (const options of [null, [], new Float64Array(1), ...notPlain]) {
      refused(options, 'InvalidArgument', { argument: 'options' });
      expectError(() => scene.drawList(field, options), 'InvalidArgument', { argument: 'options' });
    }
  });

  it('have known names only, each where it means something', () => {
    const names = ['with', 'Width', 'colourmap', 'constructor', 'toString', '', 'directions', 'delta'];
    for (const option of names) {
      for (const value of [1, undefined, null]) {
        refused({ [option]: value }, 'UnknownOption', { option });
        expectError(() => scene.drawList(field, { [option]: value }), 'UnknownOption', { option });
      }
    }
    for (const option of ['titles', 'differenceColormap', 'largestDifference']) {
      expectError(() => scene.snapshot(field, { [option]: null }), 'UnknownOption', { option });
      expectError(() => scene.drawList(field, { [option]: null }), 'UnknownOption', { option });
    }
    for (const option of ['width', 'height', 'colorBar', 'title', 'camera']) {
      expectError(() => scene.drawList(field, { [option]: undefined }), 'UnknownOption', { option });
    }
  });

  it.each(['width', 'height'])('%s is a whole number from 1 to 8192', (option) => {
    const wrong = [0, -1, 1.5, 8193, 2 ** 32 + 7, NaN, Infinity, '300', 5n, true, [300], {}, new Map()];
    for (const value of wrong) {
      refused({ [option]: value }, 'InvalidOption', { option, expected: expect.stringContaining('8192') });
    }
  });

  it('the range is two finite numbers, the smaller one first', () => {
    const wrong = [
      [1, 0],
      [1, 1],
      [NaN, 1],
      [0, NaN],
      [0, Infinity],
      [-Infinity, 0],
      [-1e308, 1e308],
      [0],
      [0, 1, 2],
      [],
    ];
    for (const range of wrong) {
      refused({ range }, 'InvalidOption', { option: 'range' });
      expectError(() => scene.drawList(field, { range }), 'InvalidOption', { option: 'range' });
    }
    for (const range of [...notPlain, { 0: 0, 1: 1 }, ['0', '1'], [0, null], new BigInt64Array(2), true]) {
      refused({ range }, 'InvalidArgument', { argument: 'range' });
    }
  });

  it('color maps have names', () => {
    for (const colormap of ['jet', 'Viridis', '', 5, true, ['viridis'], {}, new String('viridis')]) {
      refused({ colormap }, 'InvalidOption', { option: 'colormap' });
      expectError(() => scene.drawList(field, { colormap }), 'InvalidOption', { option: 'colormap' });
      const option = 'differenceColormap';
      expectError(() => scene.sheet(field, field, { [option]: colormap }), 'InvalidOption', { option });
    }
  });

  it.each(['bands', 'colorBar'])('%s is true or false', (option) => {
    for (const value of [0, 1, 'true', {}, [], new Boolean(true)]) {
      refused({ [option]: value }, 'InvalidOption', { option });
    }
  });

  it('titles are texts', () => {
    for (const title of [5, true, ['x'], {}, new String('x')]) refused({ title }, 'InvalidOption', { option: 'title' });
    const wrong = [
      'abc',
      ['a', 'b'],
      ['a', 'b', 'c', 'd'],
      ['a', 'b', 3],
      ['a', , 'c'],
      {},
      new Set(['a', 'b', 'c']),
      5,
    ];
    for (const titles of wrong) {
      expectError(() => scene.sheet(field, field, { titles }), 'InvalidOption', { option: 'titles' });
    }
  });

  it('the largest difference is a positive number', () => {
    for (const largestDifference of [0, -1, NaN, Infinity, '1', [1], {}]) {
      const use = () => scene.sheet(field, field, { ...small, largestDifference });
      expectError(use, 'InvalidOption', { option: 'largestDifference' });
    }
  });
});

describe('the camera', () => {
  it('is a plain object with known names', () => {
    for (const camera of [...notPlain, [], true]) refused({ camera }, 'InvalidArgument', { argument: 'camera' });
    refused({ camera: { position: [1, 2, 3] } }, 'UnknownOption', { option: 'camera.position' });
    refused({ camera: { Up: undefined } }, 'UnknownOption', { option: 'camera.Up' });
  });

  it.each(['direction', 'up'])('has three finite numbers as its %s', (name) => {
    const wrong = [[0, 0, 0], [-0, 0, 0], [NaN, 0, 1], [0, Infinity, 1], [1, 2], [1, 2, 3, 4], [], new Float32Array(3)];
    for (const value of wrong) {
      refused({ camera: { [name]: value } }, 'InvalidOption', { option: `camera.${name}` });
    }
    for (const value of ['front', 1, {}, [1, 2, '3'], [1, , 3], new BigInt64Array(3), new Set([1, 2, 3]), true]) {
      refused({ camera: { [name]: value } }, 'InvalidArgument', { argument: `camera.${name}` });
    }
  });

  it('does not look along what points upwards', () => {
    for (const direction of [
      [1, 2, 3],
      [-1, -2, -3],
      [1e-200, 2e-200, 3e-200],
    ]) {
      refused({ camera: { direction, up: [2, 4, 6] } }, 'InvalidOption', { option: 'camera.up' });
    }
    // What is up by default gives way.
    for (const direction of [
      [0, 1, 0],
      [0, -1, 0],
      [0, 0, 1],
      [1, 0, 0],
    ]) {
      expect(() => scene.snapshot(field, { ...small, camera: { direction } })).not.toThrow();
    }
  });
});

describe('ingredients', () => {
  const levels = (change) => ({
    levels: {
      points: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1],
      offsets: [0, 2, 4],
      levels: [0.5, 1],
      closed: Uint8Array.of(0, 1),
      ...change,
    },
  });
  const points = (change) => ({ criticalPoints: { vertices: [0, 5], kinds: Int8Array.of(-1, 1), ...change } });
  const complex = (change) => ({
    morseComplex: { vertices: [0, 1, 2, 3], offsets: [0, 2, 4], kinds: Int8Array.of(-1, 1), ...change },
  });
  /** Sheets have nothing of one field, whatever is in it. */
  const refusedHere = (options, code, detail) => {
    expectError(() => scene.snapshot(field, options), code, detail);
    expectError(() => snapshot(positions, triangles, field, options), code, detail);
    expectError(() => scene.drawList(field, options), code, detail);
    expect(() => scene.sheet(field, field, options)).toThrow(MorseSmoothError);
  };

  it('that are well-formed are drawn', () => {
    for (const options of [levels(), points(), complex()]) {
      expect(() => scene.snapshot(field, { ...small, ...options })).not.toThrow();
      expect(() => scene.drawList(field, options)).not.toThrow();
    }
  });

  it('are of the kinds that the types say', () => {
    for (const value of [...notPlain, [], [0, 1], Uint32Array.of(1)]) {
      refusedHere({ criticalPoints: value }, 'InvalidArgument', { argument: 'criticalPoints' });
      refusedHere({ morseComplex: value }, 'InvalidArgument', { argument: 'morseComplex' });
    }
    for (const value of [...notPlain, true, false, ['0.5'], [0.5, null], BigInt64Array.of(1n)]) {
      refusedHere({ levels: value }, 'InvalidArgument', { argument: 'levels' });
    }
  });

  it('counts are whole and few', () => {
    for (const count of [-1, 1.5, NaN, Infinity, 10_001, 2 ** 32, '3', true, [3], {}]) {
      refusedHere({ levels: { count } }, 'InvalidOption', { option: 'levels.count' });
    }
    refusedHere({ levels: {} }, 'InvalidOption', { option: 'levels' });
    refusedHere({ levels: { count: undefined } }, 'InvalidOption', { option: 'levels' });
    for (const option of ['cuont', 'saddles', 'offset', 'offsets']) {
      refusedHere({ levels: { [option]: [1] } }, 'UnknownOption', { option: `levels.${option}` });
      refusedHere({ levels: { count: 3, [option]: [1] } }, 'UnknownOption', { option: `levels.${option}` });
    }
  });

  it('levels are finite', () => {
    refusedHere({ levels: [0, NaN] }, 'NonFiniteLevel');
    refusedHere({ levels: [Infinity] }, 'NonFiniteLevel');
  });

  it('persistence is not negative', () => {
    for (const persistence of [-1, NaN, Infinity, '0.1', true, [1], {}]) {
      refusedHere({ morseComplex: { persistence } }, 'InvalidOption', { option: 'morseComplex.persistence' });
    }
    refusedHere({ morseComplex: {} }, 'InvalidOption', { option: 'morseComplex' });
    const known = { persistence: 0.1, persistenceIs: 'absolute' };
    refusedHere({ morseComplex: known }, 'UnknownOption', { option: 'morseComplex.persistenceIs' });
    refusedHere({ morseComplex: { threshold: 1 } }, 'UnknownOption', { option: 'morseComplex.threshold' });
  });

  it.each([
    ['no offsets', levels({ offsets: [] }), 'levels'],
    ['offsets that begin late', levels({ offsets: [1, 2, 4] }), 'levels'],
    ['offsets that end early', levels({ offsets: [0, 2, 3] }), 'levels'],
    ['offsets beyond the points', levels({ offsets: [0, 2, 5] }), 'levels'],
    ['offsets that descend', levels({ offsets: [0, 5, 4] }), 'levels'],
    ['too few lines', levels({ offsets: [0, 4] }), 'levels'],
    ['too few levels', levels({ levels: [1] }), 'levels'],
    ['a level that is no number', levels({ levels: [1, NaN] }), 'levels'],
    ['too many flags', levels({ closed: new Uint8Array(3) }), 'levels'],
    ['a lost coordinate', levels({ points: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0] }), 'levels'],
    ['NaN', levels({ points: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, NaN] }), 'levels'],
    ['infinity', levels({ points: [0, 0, 0, 1, 0, 0, 0, -Infinity, 0, 0, 0, 1] }), 'levels'],
    ['a line without flags', levels({ closed: undefined }), 'levels.closed'],
    ['lines without offsets', levels({ offsets: null }), 'levels.offsets'],
    ['an offset between numbers', levels({ offsets: [0, 1.5, 4] }), 'levels.offsets'],
    ['a negative offset', levels({ offsets: [0, -1, 4] }), 'levels.offsets'],
    ['no kinds', points({ kinds: undefined }), 'criticalPoints.kinds'],
    ['no vertices', points({ vertices: undefined }), 'criticalPoints.vertices'],
    ['too few kinds', points({ kinds: Int8Array.of(1) }), 'criticalPoints.kinds'],
    ['too few vertices', points({ vertices: [1] }), 'criticalPoints.kinds'],
    ['a kind that there is not', points({ kinds: Int8Array.of(1, 2) }), 'criticalPoints.kinds'],
    ['another', points({ kinds: Int8Array.of(-128, 0) }), 'criticalPoints.kinds'],
    ['lines of that kind', complex({ kinds: Int8Array.of(1, 3) }), 'morseComplex.kinds'],
    ['lines without kinds', complex({ kinds: undefined }), 'morseComplex.kinds'],
    ['too few kinds of lines', complex({ kinds: Int8Array.of(1) }), 'morseComplex'],
    ['lines that end nowhere', complex({ offsets: [0, 2, 9] }), 'morseComplex'],
    ['lines that go back', complex({ offsets: [0, 5, 4] }), 'morseComplex'],
    ['no offset', complex({ offsets: [] }), 'morseComplex'],
    ['offsets missing', complex({ offsets: undefined }), 'morseComplex.offsets'],
  ])('with %s are refused', (_, options, option) => {
    refusedHere(options, 'InvalidOption', { option });
  });

  it('name vertices of the mesh', () => {
    for (const make of [points, complex]) {
      const ids = (last) => (make === points ? [0, last] : [0, 1, 2, last]);
      for (const index of [vertices, 2 ** 32 - 1, 2 ** 32, -1, 0.5, NaN]) {
        refusedHere(make({ vertices: ids(index) }), 'IndexOutOfBounds', { index, vertices });
      }
      refusedHere(make({ vertices: Uint32Array.from(ids(vertices)) }), 'IndexOutOfBounds', { index: vertices });
    }
  });

  it('are arrays of their classes', () => {
    const wrong = ['x', 5, {}, new Set([1]), new DataView(new ArrayBuffer(8)), true];
    for (const value of wrong) {
      refusedHere(levels({ points: value }), 'InvalidArgument', { argument: 'levels.points' });
      refusedHere(levels({ offsets: value }), 'InvalidArgument', { argument: 'levels.offsets' });
      refusedHere(levels({ levels: value }), 'InvalidArgument', { argument: 'levels.levels' });
      refusedHere(complex({ offsets: value }), 'InvalidArgument', { argument: 'morseComplex.offsets' });
    }
    for (const value of [...wrong, [1, 1], new Float32Array(2), new Uint8ClampedArray(2)]) {
      refusedHere(levels({ closed: value }), 'InvalidArgument', { argument: 'levels.closed' });
      refusedHere(points({ kinds: value }), 'InvalidArgument', { argument: 'criticalPoints.kinds' });
      refusedHere(complex({ kinds: value }), 'InvalidArgument', { argument: 'morseComplex.kinds' });
    }
    refusedHere(points({ vertices: ['0', 1] }), 'InvalidArgument', { argument: 'criticalPoints.vertices', index: 0 });
  });

  it('that were refused leave the scene as it was', () => {
    expect(scene.snapshot(field, small)).toEqual(snapshot(positions, triangles, field, small));
  });
});
