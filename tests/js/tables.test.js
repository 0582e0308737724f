import init, { readField, readTable } from 'morse-smooth/files';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { random, text } from './meshes.js';

beforeAll(() => init());

/** The columns as ordinary arrays, and the codes of the warnings. */
function read(content, options) {
  const { columns, warnings } = readTable(text(content), options);
  for (const values of Object.values(columns)) expect(values).toBeInstanceOf(Float64Array);
  const lists = Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, [...values]]));
  return { columns: lists, codes: warnings.map(({ code }) => code) };
}

describe('a table', () => {
  it.each([
    ['commas', 'id,heat,cold\n0,1.5,9\n1,-2.5e3,8\n'],
    ['semicolons and decimal commas', 'id;heat;cold\n0;1,5;9\n1;-2,5e3;8\n'],
    ['tabs', 'id\theat\tcold\r\n0\t1.5\t9\r\n1\t-2.5e3\t8\r\n'],
    ['blanks', '# a comment\n id   heat cold\n0 1.5 9 # and another\n\n 1 -2.5e3   8'],
    ['quotes', '"id","heat","cold"\n"0","1.5","9"\n1,-2.5e3,8\n'],
  ])('with %s has its columns by their names', (_, content) => {
    expect(read(content)).toEqual({ columns: { id: [0, 1], heat: [1.5, -2500], cold: [9, 8] }, codes: [] });
  });

  it('without a header has them by their numbers', () => {
    for (const content of ['1,2\n3,4\n', '1 2\n3 4\n', '1;2\n3;4', '1\t2\n3\t4'])
      expect(read(content)).toEqual({ columns: { 0: [1, 3], 1: [2, 4] }, codes: [] });
    expect(read('7\n8\n9\n').columns).toEqual({ 0: [7, 8, 9] });
    expect(read('5 6').columns).toEqual({ 0: [5], 1: [6] });
    expect(read('5,6', { format: 'csv' }).columns).toEqual({ 0: [5], 1: [6] });
  });

  it('has NaN where values are missing, and says so', () => {
    const { columns, warnings } = readTable(text('stress,temp\n,20\n1.5,nan\n2.5,22\n'));
    expect(columns).toEqual({ stress: Float64Array.of(NaN, 1.5, 2.5), temp: Float64Array.of(20, NaN, 22) });
    expect(warnings.map(({ code, count, examples }) => [code, count, examples])).toEqual([
      ['NonFiniteValue', 1, [0]],
      ['NonFiniteValue', 1, [1]],
    ]);
    expect(read(',1\n2,3\n').columns).toEqual({ 0: [NaN, 2], 1: [1, 3] });
  });

  it('loses columns of text and of nothing, with a warning', () => {
    expect(read('name,x,none\na,1,\nb,2,\n')).toEqual({
      columns: { x: [1, 2] },
      codes: ['SkippedData', 'SkippedData'],
    });
    // The first line is no header, for the only column of numbers has a number there.
    expect(read('a,1\nb,2\n')).toEqual({ columns: { 1: [1, 2] }, codes: ['SkippedData'] });
    expect(read('x,y\n1,2\nthree,4\n').columns).toEqual({ y: [2, 4] });
  });

  it('keeps apart what has one name, or none', () => {
    expect(read('f,f,,__proto__\n1,2,3,4\n')).toEqual({
      columns: Object.fromEntries([
        ['f', [1]],
        ['f_2', [2]],
        ['2', [3]],
        ['__proto__', [4]],
      ]),
      codes: ['RenamedField'],
    });
  });

  it('agrees with readField on every column', () => {
    const next = random(5);
    const rows = Array.from({ length: 500 }, () => [next(), 1e9 * next() - 5e8, 1e-9 * next()]);
    const content = `a,b,c\n${rows.map((row) => row.join(',')).join('\n')}\n`;
    const { columns } = readTable(text(content));
    for (const column of ['a', 'b', 'c']) expect(columns[column]).toEqual(readField(text(content), { column }));
    expect(columns.b).toEqual(Float64Array.from(rows, (row) => row[1]));
  });

  it('may have a cell too many at the end of a line, if it is empty', () => {
    expect(read('a,b\n1,2,\n3,4,,\n').columns).toEqual({ a: [1, 3], b: [2, 4] });
  });
});

describe('what is no table is refused', () => {
  it.each([
    ['no bytes', '', undefined, 'EmptyFile', {}],
    ['blanks', ' \n\t\n', undefined, 'EmptyFile', {}],
    ['a row too short', 'a,b\n1,2\n3\n', undefined, 'InvalidSyntax', { line: 3 }],
    ['a row too long', 'a b\n1 2\n3 4 5\n', undefined, 'InvalidSyntax', { line: 3 }],
    ['no numbers', 'a,b\nc,d\n', undefined, 'MissingElement', {}],
    ['a header alone', 'a,b\n', undefined, 'MissingElement', {}],
    ['a comment alone', '# 1 2 3\n', undefined, 'MissingElement', {}],
    ['what NumPy does not write', '\x93NUMPY', { format: 'npy' }, 'DamagedData', {}],
    ['an unknown format', '1,2', { format: 'xls' }, 'InvalidOption', { option: 'format' }],
    ['an unknown option', '1,2', { column: 1 }, 'UnknownOption', { option: 'column' }],
  ])('%s', (_, content, options, code, detail) => {
    expectError(() => readTable(text(content), options), code, detail);
    expect(read('1').columns).toEqual({ 0: [1] });
  });

  it('arguments that are no bytes', () => {
    for (const bytes of ['1', undefined, null, [1, 2], new Uint16Array(8)])
      expectError(() => readTable(bytes), 'InvalidArgument', { argument: 'bytes' });
  });

  it('random bytes: an error with a code or columns of one length', () => {
    const next = random(77);
    const letters = [...'0123456789,;\t \n\n\n".-e#x'];
    for (let round = 0; round < 2000; round++) {
      const length = Math.floor(60 * next());
      const content = Array.from({ length }, () => letters[Math.floor(letters.length * next())]).join('');
      try {
        const lengths = Object.values(readTable(text(content)).columns).map((values) => values.length);
        expect(new Set(lengths).size, content).toBe(1);
      } catch (error) {
        expect(['EmptyFile', 'InvalidSyntax', 'MissingElement'], `${error.stack}\n${content}`).toContain(error.code);
      }
    }
  });
});
