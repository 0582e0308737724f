// What callers may hand over, and what they are told of the rest.
import init, { MorseSmoothError, Smoother, TriMesh, smooth } from 'morse-smooth';
import initFiles, { readField, readMesh, readTable } from 'morse-smooth/files';
import initPictures, { Scene } from 'morse-smooth/snapshot';
import { beforeAll, describe, expect, it } from 'vitest';
import { options as coreOptions } from '../../src/js/api/core/options.js';
import { options as fileOptions } from '../../src/js/api/files/options.js';
import { options as pictureOptions } from '../../src/js/api/snapshot/options.js';
import { expectError } from './errors.js';
import { heights, sphere, text } from './meshes.js';

const OFF = 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n';
const shape = sphere(1);
const values = heights(shape);
let mesh;
let smoother;
let scene;

beforeAll(async () => {
  await Promise.all([init(), initFiles(), initPictures()]);
  mesh = new TriMesh(shape.positions, shape.triangles);
  smoother = new Smoother(mesh);
  scene = new Scene(shape.positions, shape.triangles);
});

/** What a call throws, or nothing. */
function thrownBy(call) {
  try {
    call();
    return null;
  } catch (error) {
    expect(error).toBeInstanceOf(MorseSmoothError);
    return error;
  }
}

describe('bytes', () => {
  it('are taken as buffers and as every view of bytes', () => {
    const bytes = text(OFF);
    const expected = readMesh(bytes);
    const { buffer } = Uint8Array.from(bytes);
    const padded = new Uint8Array(bytes.length + 7);
    padded.set(bytes, 3);
    const part = [padded.buffer, 3, bytes.length];
    const all = [buffer, new Int8Array(buffer), new Uint8ClampedArray(...part), new DataView(...part)];
    for (const given of all) expect(readMesh(given)).toEqual(expected);
    expect(readField(text('1\n2\n').buffer)).toEqual(Float64Array.of(1, 2));
    expect(readTable(text('a\n2\n').buffer).columns).toEqual({ a: Float64Array.of(2) });
  });
});

describe('arrays', () => {
  const detached = (array) => {
    structuredClone(array.buffer, { transfer: [array.buffer] });
    return array;
  };

  it('that are detached are named as such', () => {
    const expected = (argument) => ['InvalidArgument', { argument, detached: true }];
    expectError(() => mesh.criticalPoints(detached(new Float32Array(6))), ...expected('values'));
    expectError(() => new TriMesh(detached(new Float64Array(9)), [0, 1, 2]), ...expected('positions'));
    expectError(() => new TriMesh(new Float64Array(9), detached(new Uint32Array(3))), ...expected('triangles'));
    expectError(() => mesh.constrainedVertices(values, detached(new Int16Array(3))), ...expected('constraints'));
    for (const bytes of [
      detached(new Uint8Array(4)),
      detached(new Uint8Array(4)).buffer,
      detached(new DataView(new ArrayBuffer(4))),
    ])
      expectError(() => readMesh(bytes), ...expected('bytes'));
    expect(thrownBy(() => mesh.criticalPoints(detached(new Float32Array(6)))).message).toContain('transferred');
  });

  it('are not mistaken for detached ones when they are empty', () => {
    expectError(() => mesh.criticalPoints(new Float64Array(0)), 'LengthMismatch', { actual: 0 });
  });

  it('are made of buffers by the caller, who is told so', () => {
    expectError(() => mesh.criticalPoints(new ArrayBuffer(48)), 'InvalidArgument', { argument: 'values' });
    expect(thrownBy(() => mesh.criticalPoints(new ArrayBuffer(48))).message).toContain('new Float32Array(buffer)');
  });
});

describe('channels', () => {
  const calls = {
    tikhonov: (channels) => smoother.tikhonov(values, { epsilon: 1, channels }),
    lowPass: (channels) => smoother.lowPass(values, { iterations: 1, channels }),
    family: (channels) => smoother.family(values, { channels }),
    sweep: (channels) => smoother.sweep(values, { channels }),
    smooth: (channels) => smooth(mesh, values, { channels }),
    constrainedVertices: (channels) => mesh.constrainedVertices(values, [1], { channels }),
  };

  it.each(Object.keys(calls))('must be a positive integer, and have their values: %s', (name) => {
    for (const channels of [1.5, 0, -1, NaN, Infinity, '2', 2n, {}]) {
      expectError(() => calls[name](channels), 'InvalidOption', { option: 'channels', expected: 'a positive integer' });
    }
    const actual = values.length;
    for (const channels of [2 ** 32, 2 ** 40])
      expectError(() => calls[name](channels), 'InvalidOption', { option: 'channels' });
    for (const channels of [2, 1e9, 2 ** 32 - 1]) {
      expectError(() => calls[name](channels), 'LengthMismatch', { expected: channels * actual, actual });
    }
  });
});

describe('an unknown option', () => {
  it('that is one elsewhere is said to be so', () => {
    const error = thrownBy(() => smoother.tikhonov(values, { epsilon: 1, energy: 'harmonic' }));
    expect(error).toMatchObject({
      code: 'UnknownOption',
      detail: { option: 'energy', belongsTo: ['interpolate', 'smooth'] },
    });
    expect(error.message).toContain('`interpolate`');
    const nested = thrownBy(() => smoother.interpolate(values, { constraints: [1], stars: true }));
    expect(nested.detail).toEqual({ option: 'stars', belongsTo: ['constraints'] });
    const drawn = thrownBy(() => scene.drawList(values, { title: 'heat' }));
    expect(drawn.detail).toEqual({ option: 'title', belongsTo: ['snapshot', 'sheet'] });
  });

  it.each([
    ['epsilom', 'epsilon'],
    ['espilon', 'epsilon'],
    ['Epsilon', 'epsilon'],
    ['onprogress', 'onProgress'],
    ['mass_scale', 'massScale'],
    ['channel s', 'channels'],
  ])('%s that is a slip is said to mean %s', (option, meant) => {
    const error = thrownBy(() => smoother.tikhonov(values, { epsilon: 1, [option]: 1 }));
    expect(error).toMatchObject({ code: 'UnknownOption', detail: { option, meant } });
    expect(error.message).toContain(`\`${meant}\``);
  });

  it('within another one is told, too', () => {
    const constraints = { from: 'criticalPoints', star: true };
    const error = thrownBy(() => smoother.interpolate(values, { constraints }));
    expect(error.detail).toEqual({ option: 'constraints.star', meant: 'stars' });
    expect(thrownBy(() => readMesh(text(OFF), { filename: 'x' })).detail).toEqual({
      option: 'filename',
      meant: 'fileName',
    });
  });

  it('that is like none is told as it is', () => {
    const error = thrownBy(() => smoother.tikhonov(values, { epsilon: 1, colour: 1 }));
    expect(error.detail).toEqual({ option: 'colour' });
    expect(thrownBy(() => smoother.tikhonov(values, { epsilon: 1, q: 1 })).detail).toEqual({ option: 'q' });
  });
});

describe('what hints know of options', () => {
  const constraints = { from: 'criticalPoints' };
  /** What is known there and never wanted: another error says why. */
  const refused = {
    prescribe: ['channels'],
    family: ['cutoffWavelength'],
    sweep: ['cutoffWavelength'],
    drawList: ['camera'],
  };
  /** Every function, with options under which it takes others: some are known with some methods alone. */
  const functions = {
    'new TriMesh': [(given) => new TriMesh(shape.positions, shape.triangles, given)],
    ...of(
      [
        'criticalPoints',
        'deltaHierarchy',
        'persistence',
        'persistenceCurve',
        'morseComplex',
        'morseHierarchy',
        'basins',
        'smoothness',
      ],
      (name) => (given) => mesh[name](values, given),
    ),
    ...of(['levelSets', 'bands'], (name) => (given) => mesh[name](values, [1], given)),
    simplify: [
      (given) => mesh.simplify(values, { threshold: 0.1, ...given }),
      (given) => mesh.simplify(values, { keep: [0], ...given }),
    ],
    constrainedVertices: [(given) => mesh.constrainedVertices(values, [1], given)],
    ...of(['laplacian', 'mass'], (name) => (given) => mesh[name](given)),
    'new Smoother': [(given) => new Smoother(mesh, given)],
    tikhonov: [{}, { missing: 'fill' }].map(
      (base) => (given) => smoother.tikhonov(values, { epsilon: 1, ...base, ...given }),
    ),
    ...of(['interpolate', 'leastSquares'], (name) => (given) => smoother[name](values, { constraints, ...given })),
    lowPass: [(given) => smoother.lowPass(values, { iterations: 1, ...given })],
    bilateral: [
      (given) => smoother.bilateral(values, { iterations: 1, radius: 1, sigmaDistance: 1, sigmaValue: 1, ...given }),
    ],
    prescribe: [{}, { constraints }].map(
      (base) => (given) => smoother.prescribe(values, { epsilon: 1, ...base, ...given }),
    ),
    ...of(['family', 'sweep'], (name) => (given) => smoother[name](values, { factorizations: 1, ...given })),
    smooth: ['tikhonov', 'interpolate', 'leastSquares', 'prescribe'].map(
      (method) => (given) =>
        smooth(mesh, values, { method, ...(method === 'tikhonov' ? {} : { constraints }), ...given }),
    ),
    'family.sweep': [(given) => smoother.family(values, { factorizations: 1 }).sweep(given)],
    'family.lives': [(given) => smoother.family(values, { factorizations: 1 }).lives(given)],
    ...of(
      ['readMesh', 'readField', 'readTable'],
      (name) => (given) => ({ readMesh, readField, readTable })[name](text(OFF), given),
    ),
    ...of(['drawList', 'snapshot'], (name) => (given) => scene[name](values, given)),
    sheet: [(given) => scene.sheet(values, values, given)],
  };

  function of(names, call) {
    return Object.fromEntries(names.map((name) => [name, [call(name)]]));
  }

  it.each(Object.keys(functions))('is what %s takes, and no more', (place) => {
    const table = [coreOptions, fileOptions, pictureOptions].find((options) => place in options);
    const all = new Set(Object.values(table).flatMap((names) => names.split(' ')));
    const isKnown = (name) =>
      functions[place].some((call) => {
        const error = thrownBy(() => call({ [name]: 'x' }));
        return error?.code !== 'UnknownOption';
      });
    const expected = [...table[place].split(' '), ...(refused[place] ?? [])];
    expect([...all].filter(isKnown).sort()).toEqual(expected.sort());
  });
});

describe('an error', () => {
  const error = new MorseSmoothError('IndexOutOfBounds', 'there is no vertex 7', { index: 7, vertices: 3 });

  it('goes to other threads and comes back', async () => {
    const { port1, port2 } = new MessageChannel();
    const arrived = new Promise((resolve) => port2.addEventListener('message', ({ data }) => resolve(data)));
    port2.start();
    port1.postMessage(error.toJSON());
    const there = MorseSmoothError.from(await arrived);
    port1.close();
    port2.close();
    for (const again of [
      there,
      MorseSmoothError.from(structuredClone(error.toJSON())),
      MorseSmoothError.from(JSON.parse(JSON.stringify(error))),
    ]) {
      expect(again).toBeInstanceOf(MorseSmoothError);
      expect(again).toEqual(error);
      expect({ ...again }).toEqual({ code: 'IndexOutOfBounds', detail: { index: 7, vertices: 3 } });
      expect(String(again)).toBe('MorseSmoothError: there is no vertex 7');
    }
  });

  it('as it is loses all but its message on the way, as the platform has it', () => {
    expect(structuredClone(error)).toMatchObject({ name: 'Error', message: error.message });
    expect(structuredClone(error).code).toBeUndefined();
  });
});
