import { TriMesh } from 'morse-smooth';
import { expect, it } from 'vitest';
import { expectError } from './errors.js';
import { random, sphere, tetrahedron } from './meshes.js';

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const noise = ({ positions }, seed) => Float64Array.from({ length: positions.length / 3 }, random(seed));

/** What every function of a mesh and a field owes its callers. `methods`: by name, called with both. */
export function takeAnyValues(methods) {
  it.each(Object.keys(methods))('%s takes every kind of numbers, and gives arrays of the caller’s own', (name) => {
    const mesh = make(sphere(3));
    const single = Float32Array.from(noise(sphere(3), 17));
    const before = Float64Array.from(single);
    const call = (values) => methods[name](mesh, values);
    const result = call(before);
    expect(call(single)).toEqual(result);
    expect(call([...single])).toEqual(result);
    const whole = Float64Array.from(before, (value) => Math.round(100 * value));
    for (const Integers of [Int8Array, Int16Array, Int32Array]) expect(call(Integers.from(whole))).toEqual(call(whole));
    const positive = whole.map((value) => value + 101);
    for (const Integers of [Uint8Array, Uint8ClampedArray, Uint16Array, Uint32Array])
      expect(call(Integers.from(positive))).toEqual(call(positive));
    expect(before).toEqual(Float64Array.from(single));
    for (const array of Object.values(result)) {
      // As long as its buffer: no view of the module's memory, which would go stale.
      expect(array.byteLength).toBe(array.buffer.byteLength);
      array.fill(1);
    }
    expect(call(before)).toEqual(call(single));
    expect(call(before)).not.toEqual(result);
  });

  it.each(Object.keys(methods))('%s refuses other values', (name) => {
    const mesh = make(tetrahedron());
    const method = (values) => methods[name](mesh, values);
    expectError(() => method([1, 2, 3]), 'LengthMismatch', { expected: 4, actual: 3 });
    expectError(() => method(new Float32Array(5)), 'LengthMismatch', { expected: 4, actual: 5 });
    expectError(() => method([1, 2, NaN, 4]), 'NonFiniteValue', { vertex: 2 });
    expectError(() => method([1, 2, 3, -Infinity]), 'NonFiniteValue', { vertex: 3 });
    expectError(() => method([1, '2', 3, 4]), 'InvalidArgument', { argument: 'values', index: 1 });
    expectError(() => method([1, 2, 3, 4n]), 'InvalidArgument', { argument: 'values', index: 3 });
    // The last two are arrays by their prototype alone.
    const pretenders = [Object.create(Float64Array.prototype), new Proxy(new Float64Array(4), {})];
    for (const bad of [
      '1234',
      undefined,
      null,
      {},
      new BigInt64Array(4),
      new DataView(new ArrayBuffer(32)),
      ...pretenders,
    ]) {
      expectError(() => method(bad), 'InvalidArgument', { argument: 'values' });
    }
    expectError(() => method([1e308, -1e308, 0, 0]), 'RangeOverflow');
    expect(() => method([1, 2, 3, 4])).not.toThrow();
    mesh.free();
    expectError(() => method([1, 2, 3, 4]), 'UseAfterFree', { object: 'TriMesh' });
  });
}
