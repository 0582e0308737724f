import { isRecord, toIds, toNumbers, toOptions, toVertices, typedArrayName } from '../../runtime/convert.js';
import { invalidArgument, invalidOption } from '../../runtime/error.js';

/**
 * Options as the wasm module takes them, with copies of the objects in them; it checks all that is left. `vertices` are those of the
 * mesh.
 */
export function toPictureOptions(options, vertices) {
  const settings = toOptions(options);
  convert(settings, '', {
    range: toNumbers,
    levels: toLevels,
    criticalPoints: (value) => toChoice(value, 'criticalPoints', vertices),
    morseComplex: (value) => toChoice(value, 'morseComplex', vertices),
    camera: toCamera,
    titles: toTexts,
  });
  return settings;
}

/** Replaces what is given of a copied object by what the functions of that name make of it. */
function convert(record, place, functions) {
  for (const [name, to] of Object.entries(functions)) {
    const value = record?.[name];
    if (value !== undefined && value !== null) record[name] = to(value, place + name);
  }
  return record;
}

/** Values, a count, or lines as `TriMesh.levelSets` returns them. */
function toLevels(value, option) {
  if (!isRecord(value)) return toNumbers(value, option);
  const closed = (flags, argument) => toBytes(flags, argument, 'Uint8Array');
  return convert({ ...value }, `${option}.`, { points: toNumbers, offsets: toOffsets, levels: toNumbers, closed });
}

/** Yes, no, or an object with vertices and kinds in it, as `TriMesh` returns it. */
function toChoice(value, option, count) {
  if (typeof value === 'boolean') return value;
  const vertices = (ids, argument) => toVertices(ids, argument, count);
  const kinds = (signs, argument) => toBytes(signs, argument, 'Int8Array');
  return convert(toRecord(value, option, 'true, false or a plain object'), `${option}.`, {
    vertices,
    offsets: toOffsets,
    kinds,
  });
}

function toCamera(value, option) {
  return convert(toRecord(value, option, 'a plain object'), `${option}.`, { direction: toNumbers, up: toNumbers });
}

function toRecord(value, argument, expected) {
  if (isRecord(value)) return { ...value };
  throw invalidArgument(argument, expected);
}

/** Where lines start. */
function toOffsets(value, option) {
  return toIds(value, option, () => invalidOption(option, 'whole numbers from 0'));
}

/** A copy of a list; the module looks at what is in it. */
function toTexts(value) {
  return Array.isArray(value) ? [...value] : value;
}

/** An array of the class that `TriMesh` gives. */
function toBytes(value, argument, name) {
  if (typedArrayName(value) !== name) throw invalidArgument(argument, `of class ${name}`);
  return value instanceof globalThis[name] ? value : new globalThis[name](value);
}
