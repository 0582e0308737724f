import initCore, { TriMesh } from 'morse-smooth';
import init, { formats, readField, readMesh, writeMesh } from 'morse-smooth/files';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { arraysOf, meshOfFile } from './mesh-of-file.js';
import { random, square, tetrahedron, text } from './meshes.js';

beforeAll(() => Promise.all([init(), initCore()]));

const OFF = 'OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n';
const PLY = (faces = '4 0 1 2 3') => `ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property double heat
element face 1
property list uchar int vertex_indices
end_header
0 0 0 0.1
1 0 0 0.2
1 1 0 0.3
0 1 0 -0.1234567890123456
${faces}
`;

describe('reading', () => {
  it('OFF, recognised by its content', () => {
    const file = readMesh(text(OFF));
    expect(Object.keys(file)).toEqual([
      'positions',
      'triangles',
      'fields',
      'triangleFields',
      'vertexMap',
      'format',
      'warnings',
    ]);
    expect(file.positions).toEqual(Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0));
    expect(file.triangles).toEqual(Uint32Array.of(0, 1, 2, 0, 2, 3));
    expect(file.vertexMap).toBeNull();
    const { mesh, fields, format, warnings } = meshOfFile(text(OFF));
    expect(format).toBe('off');
    expect(fields).toEqual({});
    expect(warnings).toEqual([]);
    expect(mesh).toBeInstanceOf(TriMesh);
    expect([...mesh.triangles()]).toEqual([0, 1, 2, 0, 2, 3]);
    expect(mesh.area).toBe(1);
  });

  it('OBJ, recognised by its name or by option', () => {
    const bytes = text('# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n');
    for (const options of [{ format: 'obj' }, { fileName: 'C:\\meshes\\Square.OBJ' }, undefined]) {
      const { mesh, format } = meshOfFile(bytes, options);
      expect(format).toBe('obj');
      expect([mesh.vertexCount, mesh.triangleCount, mesh.area]).toEqual([4, 2, 1]);
    }
  });

  it('PLY with a field, in the precision of its text, and a polygon', () => {
    const { mesh, fields, format } = meshOfFile(text(PLY()));
    expect(format).toBe('ply');
    expect(mesh.triangleCount).toBe(2);
    expect(Object.keys(fields)).toEqual(['heat']);
    expect(fields.heat).toEqual(Float64Array.of(0.1, 0.2, 0.3, -0.1234567890123456));
  });

  it('a Node Buffer or a part of a larger array', () => {
    const whole = text(`xxxx${OFF}yyyy`);
    expect(meshOfFile(whole.subarray(4, 4 + OFF.length)).mesh.vertexCount).toBe(4);
    if (typeof Buffer !== 'undefined') expect(meshOfFile(Buffer.from(OFF)).mesh.vertexCount).toBe(4);
  });

  it('a field: numbers by line, or a column of a table', () => {
    expect(readField(text('1\n-2.5e3\n0.1\n'))).toEqual(Float64Array.of(1, -2500, 0.1));
    const table = text('id,heat,cold\n0,1.5,9\n1,2.5,8\n');
    expect([...readField(table, { column: 'heat' })]).toEqual([1.5, 2.5]);
    expect([...readField(table, { format: 'csv', column: 2 })]).toEqual([9, 8]);
    // Without a separator only the name tells that each line is a row.
    expect([...readField(text('1\n2\n'), { fileName: 'heat.CSV', column: 0 })]).toEqual([1, 2]);
    expectError(() => readField(text('1 2\n3 4\n'), { fileName: 'heat.csv' }), 'InvalidNumber', { line: 2 });
    expectError(() => readField(text('1 2\n3 4\n'), { fileName: 'heat.txt' }), 'AmbiguousColumn', {
      columns: ['0', '1'],
    });
    expect([...readField(text('1 2\n3\n'), { fileName: 'heat.txt' })]).toEqual([1, 2, 3]);
  });

  it('a field with gaps, which are NaN; what is infinite is refused', () => {
    expect(readField(text('1\nnan\n2\n'))).toEqual(Float64Array.of(1, NaN, 2));
    expect(readField(text('a,b\n1,NaN\n2,3\n'), { column: 'b' })).toEqual(Float64Array.of(NaN, 3));
    expectError(() => readField(text('1\n-inf\n2\n')), 'NonFiniteValue', { vertex: 1 });
  });
});

describe('writing', () => {
  const shape = square(3);
  const positions = shape.positions.map((x, k) => x / 3 + (k % 3 === 2 ? Math.PI : 0));
  const heat = Array.from({ length: 16 }, random(1));
  const mesh = { positions, triangles: shape.triangles };

  it.each([
    ['off', false, false],
    ['obj', false, false],
    ['ply', false, true],
    ['ply', true, true],
    ['vtk', false, true],
    ['vtk', true, true],
  ])('%s, binary %s, gives back what went in, to the last bit', (format, binary, takesFields) => {
    const options = takesFields ? { format, binary, fields: { heat, cold: Float32Array.from(heat) } } : { format };
    const bytes = writeMesh(mesh, options);
    expect(bytes).toBeInstanceOf(Uint8Array);
    const back = readMesh(bytes, { fileName: `mesh.${format}` });
    expect(back.format).toBe(format);
    expect([...back.positions]).toEqual(positions);
    expect([...back.triangles]).toEqual(shape.triangles);
    if (takesFields) {
      expect([...back.fields.heat]).toEqual(heat);
      expect([...back.fields.cold]).toEqual([...Float32Array.from(heat)]);
    }
  });

  it('values that are missing, where that is asked for', () => {
    const fields = { f: Float64Array.from({ length: 16 }, (_, v) => (v === 2 ? NaN : v)) };
    for (const format of ['ply', 'vtk'])
      for (const binary of [false, true]) {
        expectError(() => writeMesh(mesh, { format, fields, binary }), 'NonFiniteValue', { vertex: 2 });
        const read = readMesh(writeMesh(mesh, { format, fields, binary, missing: 'omit' }));
        expect(read.fields).toEqual(fields);
      }
    expectError(() => writeMesh(mesh, { format: 'ply', missing: 'fill' }), 'InapplicableOption', { option: 'missing' });
  });

  it('refuses what does not fit', () => {
    const write = (options) => () => writeMesh(mesh, options);
    expectError(write(), 'InvalidOption', { option: 'format' });
    expectError(write({ format: 'xyz' }), 'InvalidOption', { option: 'format' });
    expectError(write({ format: 'vtu' }), 'UnsupportedFormat', { format: 'vtu' });
    expectError(write({ format: 'ply', bin: true }), 'UnknownOption', { option: 'bin' });
    expectError(write({ format: 'off', fields: { heat } }), 'FieldsNotSupported', { format: 'off' });
    expectError(write({ format: 'off', binary: true }), 'BinaryNotSupported', { format: 'off' });
    expectError(write({ format: 'ply', fields: [heat] }), 'InvalidArgument', { argument: 'fields' });
    expectError(write({ format: 'ply', fields: { heat: 'x' } }), 'InvalidArgument', { argument: 'fields.heat' });
    expectError(write({ format: 'ply', fields: { heat: [1] } }), 'LengthMismatch', { expected: 16, actual: 1 });
    expectError(() => writeMesh({}, { format: 'ply' }), 'InvalidArgument', { argument: 'mesh' });
    const freed = new TriMesh(positions, shape.triangles);
    // Its arrays are asked for by methods.
    expectError(() => writeMesh(freed, { format: 'ply' }), 'InvalidArgument', { argument: 'mesh' });
    freed.free();
    expectError(() => writeMesh(arraysOf(freed), { format: 'ply' }), 'UseAfterFree');
    expect(write({ format: 'ply' })().length).toBeGreaterThan(100);
  });
});

describe('writing takes plain arrays', () => {
  const { positions, triangles } = tetrahedron();
  const write = (mesh, options) => writeMesh(mesh, { format: 'ply', binary: true, ...options });

  it('of every kind, and what reading gave', () => {
    const bytes = write({ positions, triangles });
    for (const Triangles of [Uint8Array, Uint16Array, Uint32Array, Int16Array, Int32Array])
      expect(write({ positions, triangles: Triangles.from(triangles) })).toEqual(bytes);
    for (const Positions of [Float64Array, Float32Array, Int8Array])
      expect(write({ positions: Positions.from(positions), triangles })).toEqual(bytes);
    const mesh = new TriMesh(positions, triangles);
    expect(write(arraysOf(mesh))).toEqual(bytes);
    mesh.free();
    expect(write(readMesh(bytes))).toEqual(bytes);
  });

  it('that make a mesh: what does not is refused with the ids of the trouble', () => {
    const refused = (changes, code, detail) =>
      expectError(() => write({ positions, triangles, ...changes }), code, detail);
    refused({ positions: 'x' }, 'InvalidArgument', { argument: 'positions' });
    refused({ positions: [...positions.slice(1), '1'] }, 'InvalidArgument', { argument: 'positions', index: 11 });
    refused({ positions: positions.slice(1) }, 'PositionsNotTriples', { length: 11 });
    refused({ positions: positions.with(7, NaN) }, 'NonFinitePosition', { vertex: 2 });
    refused({ positions: positions.with(7, -Infinity) }, 'NonFinitePosition', { vertex: 2 });
    refused({ triangles: new Float64Array(12) }, 'InvalidArgument', { argument: 'triangles' });
    refused({ triangles: new BigInt64Array(12) }, 'InvalidArgument', { argument: 'triangles' });
    refused({ triangles: triangles.slice(1) }, 'TrianglesNotTriples', { length: 11 });
    for (const index of [4, -1, 2 ** 32 - 1, 2 ** 33, 1.5])
      refused({ triangles: triangles.with(5, index) }, 'IndexOutOfBounds', { triangle: 1, index, vertices: 4 });
    refused({ positions: [], triangles: [] }, 'EmptyMesh', { vertices: 0, triangles: 0 });
    refused({ triangles: [] }, 'EmptyMesh', { vertices: 4, triangles: 0 });
    for (const mesh of [undefined, null, 5, [], positions, { positions }, { triangles }])
      expectError(() => write(mesh), 'InvalidArgument', { argument: 'mesh' });
    expect(write({ positions, triangles }).length).toBeGreaterThan(100);
  });
});

/** The code of what a call throws. */
function codeOf(call) {
  try {
    call();
  } catch ({ code }) {
    return code;
  }
}

describe('fields on triangles', () => {
  const ROOF = PLY('4 0 1 2 3 7')
    .replace('uchar int vertex_indices\n', 'uchar int vertex_indices\nproperty int load\n')
    .replace('property double heat\n', '')
    .replaceAll(/ -?0\.\d+$/gm, '');

  it('stay there', () => {
    const { fields, triangleFields, warnings } = readMesh(text(ROOF));
    expect(fields).toEqual({});
    expect(triangleFields).toEqual({ load: Float64Array.of(7, 7) });
    expect(warnings.map(({ code }) => code)).toEqual(['PolygonTriangulated']);
  });

  it('become means on vertices where that is asked for', () => {
    const { fields, warnings } = readMesh(text(ROOF), { triangleFields: 'average' });
    expect(fields).toEqual({ load: Float64Array.of(7, 7, 7, 7) });
    expect(warnings.map(({ code }) => code)).toContain('AveragedField');
    expectError(() => readMesh(text(ROOF), { triangleFields: 'sum' }), 'InvalidOption', { option: 'triangleFields' });
  });
});

describe('vertices that are left out', () => {
  it('have no place in the map', () => {
    const file = readMesh(text('v nan nan nan\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n'));
    expect(file.vertexMap).toEqual(Uint32Array.of(1, 2, 3));
    expect(file.warnings.map(({ code }) => code)).toEqual(['DroppedVertex']);
  });
});

describe('the list of formats', () => {
  it('says what there is', () => {
    for (const { name, extensions, reads, writes, description } of formats()) {
      expect(extensions).toContain(name);
      expect(reads).toBe(true);
      expect(description.length, name).toBeGreaterThan(10);
      const write = () => writeMesh(tetrahedron(), { format: name });
      if (writes) expect(readMesh(write(), { fileName: `mesh.${extensions[0]}` }).format).toBe(name);
      else expect(codeOf(write), name).toMatch(/^(InvalidOption|UnsupportedFormat)$/);
    }
    const meshes = ['obj', 'off', 'ply', 'stl', 'vtk', 'vtp', 'vtu', 'glb', 'msh', 'gii', 'freesurfer', 'asc'];
    expect(formats().map(({ name }) => name)).toEqual([...meshes, 'csv', 'txt', 'npy', 'curv']);
  });

  it('is the caller’s own', () => {
    formats()[0].extensions.push('x');
    formats()[0].name = 'x';
    expect(formats()[0]).toMatchObject({ name: 'obj', extensions: ['obj'] });
  });
});

describe('malformed input is refused, and the next call works', () => {
  const binaryHeader = (vertices) =>
    text(`ply\nformat binary_little_endian 1.0\nelement vertex ${vertices}\nproperty float x\nproperty float y\nproperty float z
element face 1\nproperty list uchar int vertex_indices\nend_header\n`);

  it.each([
    ['no bytes', '', undefined, 'EmptyFile', {}],
    ['no known format', 'hello, world', undefined, 'UnknownFormat', {}],
    ['a format that the content is not of', 'solid x', { format: 'stl' }, 'Truncated', { available: 7 }],
    ['damaged data', '<VTKFile type="PolyData"><Piece NumberOfPoints="x"/>', undefined, 'DamagedData', {}],
    ['a cut off text', OFF.slice(0, 30), undefined, 'Truncated', { expected: 27, available: 20 }],
    ['a word among numbers', OFF.replace('1 1 0', '1 one 0'), undefined, 'InvalidNumber', { line: 5 }],
    ['an index out of range', OFF.replace('3 0 2 3', '3 0 2 4'), undefined, 'FaceIndexOutOfBounds', { index: 4 }],
    ['a negative index', PLY('3 0 1 -2'), undefined, 'FaceIndexOutOfBounds', { index: -2 }],
    ['a position that is not a number', OFF.replace('1 1 0', '1 nan 0'), undefined, 'NonFinitePosition', { vertex: 2 }],
    ['no faces', 'OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n', undefined, 'MissingElement', {}],
  ])('%s', (_, content, options, code, detail) => {
    expectError(() => meshOfFile(text(content), options), code, detail);
    expect(meshOfFile(text(OFF)).mesh.vertexCount).toBe(4);
  });

  it('a header that promises 4e9 vertices', () => {
    expectError(() => readMesh(binaryHeader(4_000_000_000)), 'Truncated', { expected: 48_000_000_000, available: 0 });
    expectError(() => readMesh(text('OFF\n4000000000 1 0\n0 0 0\n')), 'Truncated', { available: 6 });
    expect(meshOfFile(text(OFF)).mesh.vertexCount).toBe(4);
  });

  it('random bytes, and files with bytes changed or lost: an error with a code or a sound mesh', () => {
    const next = random(99);
    const byte = () => Math.floor(256 * next());
    const good = [OFF, PLY()].map(text);
    good.push(writeMesh(tetrahedron(), { format: 'ply', binary: true, fields: { f: [1, 2, 3, 4] } }));
    good.push(writeMesh(tetrahedron(), { format: 'vtk', binary: true, fields: { f: [1, 2, 3, 4] } }));
    const codes = new Set();
    for (let round = 0; round < 2000; round++) {
      let bytes = good[round % good.length].slice();
      if (round % 5 === 0) bytes = Uint8Array.from({ length: byte() }, byte);
      else if (round % 3 === 0) bytes = bytes.slice(0, Math.floor(bytes.length * next()));
      else for (let k = 0; k < 3; k++) bytes[Math.floor(bytes.length * next())] = byte();
      try {
        const { mesh, fields } = meshOfFile(bytes, {
          format: round % 2 ? undefined : ['off', 'ply', 'obj', 'vtk'][round % 4],
        });
        expect([...mesh.positions()].every(Number.isFinite)).toBe(true);
        expect(Number.isInteger(mesh.topology.eulerCharacteristic)).toBe(true);
        for (const values of Object.values(fields)) expect(values.length).toBe(mesh.vertexCount);
        mesh.free();
      } catch (error) {
        expect(error.code, error.stack).toEqual(expect.any(String));
        codes.add(error.code);
      }
    }
    expect(codes).not.toContain('InternalError');
    expect(codes.size).toBeGreaterThan(3);
    expect(meshOfFile(text(OFF)).mesh.vertexCount).toBe(4);
  });

  it('arguments and options of readMesh', () => {
    for (const bytes of [OFF, undefined, null, [1, 2], new Uint16Array(8), new Float64Array(3)]) {
      expectError(() => readMesh(bytes), 'InvalidArgument', { argument: 'bytes' });
      expectError(() => readField(bytes), 'InvalidArgument', { argument: 'bytes' });
    }
    expectError(() => readMesh(text(OFF), { format: 'xyz' }), 'InvalidOption', { option: 'format' });
    expectError(() => readMesh(text(OFF), { filename: 'x.off' }), 'UnknownOption', { option: 'filename' });
    expectError(() => readMesh(text(OFF), { fileName: 5 }), 'InvalidOption', { option: 'fileName' });
    expectError(() => readMesh(text(OFF), 'off'), 'InvalidArgument', { argument: 'options' });
    expect(meshOfFile(text(OFF), { format: undefined, weld: true }).mesh.vertexCount).toBe(4);
  });

  it('no field name, whatever it means to JavaScript', () => {
    const mesh = readMesh(text(OFF));
    for (const name of ['__proto__', 'constructor', 'length']) {
      const fields = Object.fromEntries([[name, [1, 2, 3, 4]]]);
      const read = readMesh(writeMesh(mesh, { format: 'ply', fields })).fields;
      expect(Object.entries(read)).toEqual([[name, Float64Array.of(1, 2, 3, 4)]]);
      expect(Object.getPrototypeOf(read)).toBe(Object.prototype);
    }
  });

  it('fields', () => {
    expectError(() => readField(text('1\n'), { filename: 'x.csv' }), 'UnknownOption', { option: 'filename' });
    expectError(() => readField(text('1\n'), { fileName: 5 }), 'InvalidOption', { option: 'fileName' });
    expectError(() => readField(text('')), 'EmptyFile');
    expectError(() => readField(text('1\ntwo\n3\n')), 'InvalidNumber', { line: 2 });
    expectError(() => readField(text('a,b\n1,2\n'), { column: 'c' }), 'UnknownColumn', { column: 'c' });
    expectError(() => readField(text('a,b\n1,2\n'), { column: 7 }), 'UnknownColumn');
    expectError(() => readField(text('1\n'), { format: 'npy' }), 'DamagedData');
    expectError(() => readField(text('1\n2\n'), { vertices: 3, triangles: 2 }), 'WrongRowCount', {
      expected: 3,
      actual: 2,
    });
    expect([...readField(text('1\n2\n'), { vertices: 2 })]).toEqual([1, 2]);
    expectError(() => readField(text('1\n'), { format: 'xls' }), 'InvalidOption', { option: 'format' });
    expectError(() => readField(text('1\n'), { colunm: 1 }), 'UnknownOption', { option: 'colunm' });
    expect([...readField(text('1\n'))]).toEqual([1]);
  });
});
