// What a command is given: a mesh with its fields, out of a file or the standard input, and a field from another file.
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { about, misuse } from './failures.js';

/** The bytes of a file, or of the standard input. */
async function bytesOf(path) {
  if (path !== '-') return about(path, () => readFileSync(path));
  const chunks = [];
  for await (const chunk of process.stdin) chunks.push(chunk);
  return Buffer.concat(chunks);
}

/**
 * A mesh file with all that a command needs of it: the arrays and fields of `readMesh`, `own` for the fields that are in the file
 * itself, `chosen` for the name of one from another file, `make()` for its `TriMesh`. `notes` is told what was put right.
 */
export async function readInput(input, given, notes) {
  checkSources(input, given);
  const entry = await import('morse-smooth/files');
  const bytes = await bytesOf(input);
  const { format, triangleFields, field } = given;
  const options = { ...(format && { format }), ...(input !== '-' && { fileName: basename(input) }) };
  const read = (more) => about(input, () => recognised(entry, () => entry.readMesh(bytes, { ...options, ...more })));
  let file = read(triangleFields && { triangleFields });
  // A field on triangles that is asked for by its name becomes one on vertices.
  const isOnTriangles = (name) => !Object.hasOwn(file.fields, name) && Object.hasOwn(file.triangleFields ?? {}, name);
  if ([field ?? []].flat().some(isOnTriangles)) file = read({ triangleFields: 'average' });
  notes.warn(input, file.warnings);
  const own = file.fields;
  if (given.values === undefined) return welded({ ...file, own, chosen: null }, input, given, notes);
  const { name, values } = await readValues(given, file);
  return welded({ ...file, own, fields: { ...own, [name]: values }, chosen: name }, input, given, notes);
}

/** Says which formats there are where none is recognised. */
function recognised({ formats }, read) {
  try {
    return read();
  } catch (error) {
    if (error.code === 'UnknownFormat') {
      const names = formats()
        .flatMap(({ name, reads }) => (reads ? [name] : []))
        .join(', ');
      const list = error.message.includes(names) ? '' : `there are ${names}; `;
      error.advice = `${list}values without a mesh go beside one, by --values`;
    }
    throw error;
  }
}

/** Refuses options that mean nothing beside others. */
function checkSources(input, { field, values, column }) {
  if (values === '-' && input === '-') throw misuse('the mesh and the values cannot both be the standard input');
  if (values === undefined && column !== undefined) throw misuse('--column goes with --values');
  // A list of them is what a command writes.
  if (values !== undefined && typeof field === 'string')
    throw misuse('--field and --values are two fields', 'give one of them');
}

/** A field from another file: one value for each vertex of the mesh, or for each of its file where some were left out. */
async function readValues({ values: path, column }, { positions, triangles, vertexMap }) {
  const vertices = positions.length / 3;
  const { readField, readTable } = await import('morse-smooth/files');
  const bytes = await bytesOf(path);
  const options = path === '-' ? {} : { fileName: basename(path) };
  const chosen = column === undefined ? {} : { column: /^\d+$/.test(column) ? Number(column) : column };
  return about(path, () => {
    const base = path === '-' ? 'values' : basename(path).replace(/\.[^.]*$/, '');
    const name = typeof chosen.column === 'number' ? `${base}_${column}` : (column ?? base);
    if (column === undefined) {
      const columns = columnsOf(() => readTable(bytes, options), vertices);
      if (columns.length > 1) throw misuse(`there are several columns: ${columns.join(', ')}`, 'name one by --column');
    }
    const values = withColumns(
      () => readField(bytes, { ...options, ...chosen }),
      () => columnsOf(() => readTable(bytes, options)),
    );
    if (vertexMap && values.length > vertices) return { name, values: Float64Array.from(vertexMap, (v) => values[v]) };
    if (values.length === vertices) return { name, values };
    const perTriangle = values.length === triangles.length / 3 ? ', as many as the mesh has triangles' : '';
    const message = `${vertices} values are needed, one for each vertex, but there are ${values.length}${perTriangle}`;
    throw Object.assign(new Error(message), {
      code: 'LengthMismatch',
      detail: { expected: vertices, actual: values.length },
    });
  });
}

/** Says which columns there are where one is asked for that is not among them. */
function withColumns(read, list) {
  try {
    return read();
  } catch (error) {
    if (error.code === 'UnknownColumn') error.advice = `there are ${list().join(', ')}`;
    throw error;
  }
}

/** The names of the columns of a table, of those with so many rows where that is known. */
function columnsOf(read, rows) {
  try {
    const isLong = ({ length }) => rows === undefined || length === rows;
    return Object.entries(read().columns).flatMap(([name, values]) => (isLong(values) ? [name] : []));
  } catch {
    // No table; whatever else it is, reading the field says what is wrong with it.
    return [];
  }
}

/** The file with a way to make its mesh; joins vertices where that is asked for, with the fields on them. */
async function welded(file, input, { weld, tolerance }, notes) {
  const { TriMesh } = await import('morse-smooth');
  const isWelded = weld || tolerance !== undefined;
  const options = isWelded ? { weld: tolerance === undefined ? true : { tolerance } } : {};
  const make = () => about(input, () => new TriMesh(file.positions, file.triangles, options));
  if (!isWelded) return { ...file, make };
  const mesh = make();
  const map = mesh.vertexMap();
  if (map === null) return { ...file, make: () => mesh };
  const count = mesh.vertexCount;
  const fields = Object.entries(file.fields).map(([name, values]) => [name, carried(values, map, count)]);
  notes.say(`${map.length - count} vertices became others by welding; values at the same place became their mean`);
  const arrays = { positions: mesh.positions(), triangles: mesh.triangles() };
  return { ...file, ...arrays, fields: Object.fromEntries(fields), make: () => mesh };
}

/** For each vertex of a welded mesh the mean of the values that came to it; equal ones stay as they are. */
function carried(values, map, count) {
  const [first, sums, numbers] = [new Float64Array(count), new Float64Array(count), new Uint32Array(count)];
  map.forEach((vertex, from) => {
    if (numbers[vertex]++ === 0) first[vertex] = values[from];
    else sums[vertex] += values[from] - first[vertex];
  });
  return first.map((value, vertex) => value + sums[vertex] / numbers[vertex]);
}

/** The field that a command is about: the one that is named, or the only one. */
export function chooseField({ fields, own, chosen, triangleFields }, { field }, input) {
  const name = chosen ?? field ?? (Object.keys(own).length === 1 ? Object.keys(own)[0] : undefined);
  if (name !== undefined && Object.hasOwn(fields, name)) return { name, values: fields[name] };
  const names = Object.keys(own).join(', ');
  const place = input === '-' ? 'the mesh' : input;
  if (name !== undefined) {
    throw misuse(
      `${place} has no field ‘${name}’`,
      names ? `it has ${names}` : 'give one from another file by --values',
    );
  }
  const onTriangles = Object.keys(triangleFields ?? {}).join(', ');
  if (names === '' && onTriangles !== '') {
    throw misuse(
      `${place} has fields on triangles alone: ${onTriangles}`,
      'name one by --field, for its means on vertices',
    );
  }
  if (names === '') throw misuse(`${place} has no field`, 'give one from another file by --values');
  throw misuse(`${place} has several fields: ${names}`, 'name one by --field');
}
