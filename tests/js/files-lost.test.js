// The module of the files where an instance is lost, and where its memory cannot grow beyond ten megabytes.
import { describe, expect, it } from 'vitest';
// The entry for browsers, also in Node: it takes the code that it is given.
import init, { formats, readField, readMesh, readTable, writeMesh } from '../../dist/files.js';
import { random, square, text } from './meshes.js';
import { wasmBytes, withPages, withTrap } from './wasm-bytes.js';

/** 10 MiB. */
const PAGES = 160;
/** Cells along the side of a square: up to 260,000 vertices. */
const SIZES = [5, 20, 50, 100, 150, 200, 250, 300, 400, 510];

const module = () => wasmBytes('morse_smooth_files_bg.wasm');
// Not by `expectError`: in Node the class of errors of this entry is another one than that of the main entry.
const thrownBy = (call) => {
  try {
    call();
  } catch (error) {
    return error;
  }
};
const expectCode = (call, code) => expect(thrownBy(call)).toMatchObject({ name: 'MorseSmoothError', code });

// They run in order.
describe('an instance that fails', () => {
  it('is lost, and init makes another', async () => {
    await init({ wasm: withTrap(await module(), 'readTable') });
    expect(readField(text('1\n2\n'))).toEqual(Float64Array.of(1, 2));
    const thrown = thrownBy(() => readTable(text('1,2\n')));
    expect(thrown).toMatchObject({ code: 'InternalError', detail: {} });
    expect(thrown.cause).toBeInstanceOf(WebAssembly.RuntimeError);
    const { positions, triangles } = square(2);
    for (const call of [
      () => readField(text('1\n2\n')),
      () => readMesh(text('OFF')),
      () => readTable(text('1')),
      () => writeMesh({ positions, triangles }, { format: 'ply' }),
      () => formats(),
    ])
      expectCode(call, 'InstanceLost');
    expect(() => formats()).toThrow('morse-smooth/files');
    const again = init();
    expect(init()).toBe(again);
    await again;
    expect(readField(text('1\n2\n'))).toEqual(Float64Array.of(1, 2));
    expectCode(() => readTable(text('1')), 'InternalError');
  });
});

describe('memory that runs out', () => {
  /** The result of a call, or null where there was a shortage of memory. */
  const unlessShort = (call) => {
    try {
      return call();
    } catch (error) {
      expect(error.code, error.message).toBe('OutOfMemory');
      expect(error.detail.bytes).toBeGreaterThan(0);
      return null;
    }
  };

  it('is an error, whatever is called, and the next call works', async () => {
    await init({ wasm: withPages(await module(), PAGES) });
    const next = random(8);
    const seen = {};
    const count = (name, result) => {
      seen[name] ??= { done: 0, short: 0 };
      seen[name][result === null ? 'short' : 'done']++;
      return result;
    };
    for (const size of SIZES) {
      const { positions, triangles } = square(size);
      const mesh = { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
      const field = Float64Array.from({ length: positions.length / 3 }, next);
      for (const binary of [false, true]) {
        const write = () => writeMesh(mesh, { format: 'ply', binary, fields: { field } });
        const bytes = count(`write, ${binary}`, unlessShort(write));
        if (bytes === null) continue;
        for (const weld of [false, { tolerance: 1e-9 }]) {
          const file = count(
            `read, ${binary}`,
            unlessShort(() => readMesh(bytes, { weld })),
          );
          if (file === null) continue;
          expect(file.triangles.length).toBe(triangles.length);
          expect(file.fields.field.at(-1)).toBe(field.at(-1));
        }
      }
      const numbers = text([...field, ...field].join('\n'));
      const column = count(
        'field',
        unlessShort(() => readField(numbers)),
      );
      if (column !== null) expect(column.at(-1)).toBe(field.at(-1));
      const rows = text([...field].map((value) => `${value},1,${value}`).join('\n'));
      const table = count(
        'table',
        unlessShort(() => readTable(rows).columns),
      );
      if (table !== null) expect(table[2].at(-1)).toBe(field.at(-1));
      expect(readField(text('1\n2\n'))).toEqual(Float64Array.of(1, 2));
    }
    expect(unlessShort(() => readMesh(new Uint8Array(12 << 20)))).toBeNull();
    expect(unlessShort(() => readField(new Uint8Array(12 << 20)))).toBeNull();
    expect(unlessShort(() => readTable(new Uint8Array(12 << 20)))).toBeNull();
    expect(Object.keys(seen)).toHaveLength(6);
    for (const [name, { done, short }] of Object.entries(seen)) {
      expect(done, name).toBeGreaterThan(0);
      if (!name.startsWith('read')) expect(short, name).toBeGreaterThan(0);
    }
  });
});
