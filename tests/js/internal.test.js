// What cannot be brought about from outside: failures that would be bugs of ours.
import { describe, expect, it } from 'vitest';
import { MorseSmoothError } from '../../src/js/runtime/error.js';
import { Instance } from '../../src/js/runtime/instance.js';

/** An instance whose module does nothing but what a call does. */
const empty = () => new Instance({ setAside: () => 0, abandon() {} }, 'a module');

const thrownBy = (call, instance = empty()) => {
  try {
    instance.call(call);
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
    const report = () => {
      throw { code: 'ZeroArea', message: 'all triangles have zero area', detail: { triangle: 3 } };
    };
    const instance = empty();
    const error = thrownBy(report, instance);
    expect(error).toBeInstanceOf(MorseSmoothError);
    expect(error).toMatchObject({ code: 'ZeroArea', message: 'all triangles have zero area', detail: { triangle: 3 } });
    expect(instance.isLost).toBe(false);
    expect(thrownBy(report, instance)).toMatchObject({ code: 'ZeroArea' });
  });

  it('that it does not report loses the instance', () => {
    const instance = empty();
    thrownBy(() => {
      throw new RangeError('Maximum call stack size exceeded');
    }, instance);
    expect(instance.isLost).toBe(true);
    expect(thrownBy(() => 1, instance)).toMatchObject({ code: 'InstanceLost' });
  });
});
