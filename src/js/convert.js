import { MorseSmoothError, invalidArgument } from './error.js';

const NUMBERS = 'a Float64Array, a Float32Array or an array of numbers';
const IDS = 'a Uint32Array, a Uint16Array or an array of whole numbers';
const LARGEST_ID = 2 ** 32 - 1;

/** The name of a typed array's class, also for arrays of another realm (a frame, a vm context). */
const typedArrayName = (value) => (ArrayBuffer.isView(value) ? value[Symbol.toStringTag] : undefined);

/** Values as the wasm module takes them. A Float64Array passes through: the call copies it into wasm memory anyway. */
export function toNumbers(value, argument) {
  const name = typedArrayName(value);
  if (name === 'Float64Array') return value;
  if (name === 'Float32Array') return Float64Array.from(value);
  if (!Array.isArray(value)) throw invalidArgument(argument, NUMBERS);
  const numbers = new Float64Array(value.length);
  for (let index = 0; index < value.length; index++) {
    const entry = value[index];
    if (typeof entry !== 'number') throw invalidArgument(argument, NUMBERS, { index });
    numbers[index] = entry;
  }
  return numbers;
}

/** Triangles as the wasm module takes them; whether the ids name vertices of the mesh is checked there. */
export function toTriangles(value, vertices) {
  const name = typedArrayName(value);
  if (name === 'Uint32Array') return value;
  if (name === 'Uint16Array') return Uint32Array.from(value);
  if (!Array.isArray(value)) throw invalidArgument('triangles', IDS);
  const ids = new Uint32Array(value.length);
  for (let index = 0; index < value.length; index++) {
    const id = value[index];
    if (typeof id !== 'number') throw invalidArgument('triangles', IDS, { index });
    if (!Number.isInteger(id) || id < 0 || id > LARGEST_ID) {
      const triangle = Math.floor(index / 3);
      throw new MorseSmoothError(
        'IndexOutOfBounds',
        `triangle ${triangle} names vertex ${id}, but there are ${vertices} vertices, numbered from 0`,
        { triangle, index: id, vertices },
      );
    }
    ids[index] = id;
  }
  return ids;
}

/** Bytes of a file: a Uint8Array, which a Node Buffer is too. */
export function toBytes(value) {
  if (typedArrayName(value) === 'Uint8Array') return value;
  throw invalidArgument('bytes', 'a Uint8Array');
}

/** An options object or nothing. Its keys and values are checked by the wasm module. */
export function toOptions(value) {
  if (value === undefined || isRecord(value)) return value;
  throw invalidArgument('options', 'an object');
}

/** Fields to be written: every one as numbers, under its name. */
export function toFields(value) {
  if (!isRecord(value)) throw invalidArgument('fields', 'an object of arrays by name');
  return Object.fromEntries(Object.entries(value).map(([name, field]) => [name, toNumbers(field, `fields.${name}`)]));
}

/** Levels by value, or `{ count }`. */
export function toLevels(value) {
  return isRecord(value) ? value : toNumbers(value, 'levels');
}

function isRecord(value) {
  return typeof value === 'object' && value !== null && !Array.isArray(value) && !ArrayBuffer.isView(value);
}
