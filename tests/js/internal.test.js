// What cannot be brought about from outside: failures that would be bugs of ours.
import { describe, expect, it } from 'vitest';
import { MorseSmoothError, attempt } from '../../src/js/runtime/error.js';

const thrownBy = (call) => {
  try {
    attempt(call);
  } catch (error) {
    return error;
  }
};

describe('a failure inside the module', () => {
  it('that is a trap becomes an InternalError with its cause', () => {
    // (module (func (export "f") unreachable))
    const code = [
      0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 7, 5, 1, 1, 102, 0, 0, 10, 5, 1, 3, 0, 0, 11,
    ];
    const { f } = new WebAssembly.Instance(new WebAssembly.Module(Uint8Array.from(code))).exports;
    const error = thrownBy(f);
    expect(error).toBeInstanceOf(MorseSmoothError);
    expect(error).toMatchObject({ code: 'InternalError', detail: {} });
    expect(error.cause).toBeInstanceOf(WebAssembly.RuntimeError);
    expect(error.message).toContain('unreachable');
  });

  it('that the module does not know by name becomes one, too', () => {
    for (const thrown of [new Error('recursive use of an object'), 'text', undefined, null, { code: 5 }]) {
      const error = thrownBy(() => {
        throw thrown;
      });
      expect(error).toMatchObject({ code: 'InternalError', cause: thrown });
    }
  });

  it('that it reports keeps its code, message and detail', () => {
    const error = thrownBy(() => {
      throw { code: 'ZeroArea', message: 'all triangles have zero area', detail: { triangle: 3 } };
    });
    expect(error).toBeInstanceOf(MorseSmoothError);
    expect(error).toMatchObject({ code: 'ZeroArea', message: 'all triangles have zero area', detail: { triangle: 3 } });
  });
});
