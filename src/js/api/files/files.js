import { isRecord, toBytes, toNumbers, toOptions, toTriangles } from '../../runtime/convert.js';
import { invalidArgument } from '../../runtime/error.js';
import { files } from './module.js';

export function formats() {
  return files.instance.work((glue) => glue.formats());
}

export function readMesh(bytes, options) {
  return read('readMesh', bytes, options);
}

export function readField(bytes, options) {
  return read('readField', bytes, options);
}

export function readTable(bytes, options) {
  return read('readTable', bytes, options);
}

export function writeMesh(mesh, options) {
  const { instance } = files;
  const { positions, triangles } = toMesh(mesh);
  const settings = toOptions(options);
  if (settings?.fields !== undefined) settings.fields = toFields(settings.fields);
  return instance.work((glue) => glue.writeMesh(positions, triangles, settings));
}

/** What a function of the module of that name makes of a file. */
function read(name, bytes, options) {
  const { instance } = files;
  const input = toBytes(bytes);
  const settings = toOptions(options);
  return instance.work((glue) => glue[name](input, settings));
}

/** The arrays of a mesh as the module takes them. An object of the main entry has methods of these names. */
function toMesh(mesh) {
  const { positions, triangles } = mesh ?? {};
  const isGiven = (array) => array !== undefined && typeof array !== 'function';
  if (!isGiven(positions) || !isGiven(triangles)) {
    const ofTriMesh = '{ positions: mesh.positions(), triangles: mesh.triangles() }';
    throw invalidArgument(
      'mesh',
      `an object with the arrays \`positions\` and \`triangles\`; of a TriMesh, ${ofTriMesh}`,
    );
  }
  const numbers = toNumbers(positions, 'positions');
  return { positions: numbers, triangles: toTriangles(triangles, Math.floor(numbers.length / 3)) };
}

/** Fields to be written: every one as numbers, under its name. */
function toFields(value) {
  if (!isRecord(value)) throw invalidArgument('fields', 'a plain object of arrays by name');
  return Object.fromEntries(Object.entries(value).map(([name, field]) => [name, toNumbers(field, `fields.${name}`)]));
}
