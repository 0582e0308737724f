import { MorseSmoothError, invalidArgument } from './error.js';

const NUMBERS = 'an array of numbers: a Float64Array, a Float32Array, a typed array of integers or an ordinary array';
const IDS = 'an array of whole numbers: a Uint32Array, another typed array of integers or an ordinary array';
const LARGEST_ID = 2 ** 32 - 1;

/** Typed arrays whose entries are ids at once, and those that can be negative. */
const UNSIGNED = ['Uint8Array', 'Uint8ClampedArray', 'Uint16Array', 'Uint32Array'];
const SIGNED = ['Int8Array', 'Int16Array', 'Int32Array'];
const TYPED_NUMBERS = ['Float64Array', 'Float32Array', ...UNSIGNED, ...SIGNED];

/** Arrays that are the bytes of a file as they are. */
const BYTES = ['Uint8Array', 'Uint8ClampedArray', 'Int8Array', 'DataView'];

/** The name of a typed array's class, also for arrays of another realm (a frame, a vm context). */
export const typedArrayName = (value) => (ArrayBuffer.isView(value) ? value[Symbol.toStringTag] : undefined);

/**
 * Values as the wasm module takes them. A Float64Array passes through: the call copies it into wasm memory anyway. One of another
 * realm does not, as the module tells arrays by their class.
 */
export function toNumbers(value, argument) {
  refuseDetached(value, argument);
  if (value instanceof Float64Array && typedArrayName(value) === 'Float64Array') return value;
  if (TYPED_NUMBERS.includes(typedArrayName(value))) return new Float64Array(value);
  if (!Array.isArray(value)) throw noArray(value, argument, NUMBERS);
  const numbers = new Float64Array(value.length);
  for (let index = 0; index < value.length; index++) {
    const entry = value[index];
    if (typeof entry !== 'number') throw invalidArgument(argument, NUMBERS, { index });
    numbers[index] = entry;
  }
  return numbers;
}

/**
 * Vertex numbers and the like as the wasm module takes them; whether they name vertices of the mesh is checked there. For those
 * that it cannot be asked about, `refuse` gives the error.
 */
export function toIds(value, argument, refuse) {
  refuseDetached(value, argument);
  const name = typedArrayName(value);
  if (name === 'Uint32Array' && value instanceof Uint32Array) return value;
  if (UNSIGNED.includes(name)) return new Uint32Array(value);
  const isTyped = SIGNED.includes(name);
  if (!isTyped && !Array.isArray(value)) throw noArray(value, argument, IDS);
  const ids = new Uint32Array(value.length);
  for (let index = 0; index < value.length; index++) {
    const id = value[index];
    if (typeof id !== 'number') throw invalidArgument(argument, IDS, { index });
    if (!Number.isInteger(id) || id < 0 || id > LARGEST_ID) throw refuse(id, index);
    ids[index] = id;
  }
  return ids;
}

/** The triangles of a mesh. */
export function toTriangles(value, vertices) {
  return toIds(value, 'triangles', (id, place) => {
    const triangle = Math.floor(place / 3);
    return new MorseSmoothError(
      'IndexOutOfBounds',
      `triangle ${triangle} names vertex ${id}, but there are ${vertices} vertices, numbered from 0`,
      { triangle, index: id, vertices },
    );
  });
}

/** Vertices of a mesh that has so many. */
export function toVertices(value, argument, vertices) {
  return toIds(value, argument, (id) => {
    const message = `there is no vertex ${id}: there are ${vertices} vertices, numbered from 0`;
    return new MorseSmoothError('IndexOutOfBounds', message, { index: id, vertices });
  });
}

/** Bytes of a file: a Uint8Array, which a Node Buffer is too, or others that hold bytes. */
export function toBytes(value) {
  refuseDetached(value, 'bytes');
  if (typedArrayName(value) === 'Uint8Array') return value;
  if (isBuffer(value)) return new Uint8Array(value);
  if (BYTES.includes(typedArrayName(value))) return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  throw invalidArgument('bytes', 'an ArrayBuffer, a Uint8Array or another view with one byte per entry');
}

/** An ArrayBuffer, also of another realm. */
const isBuffer = (value) => Object.prototype.toString.call(value) === '[object ArrayBuffer]';

/** A buffer alone does not say what its bytes are. */
function noArray(value, argument, expected) {
  const more = isBuffer(value) ? '; of an ArrayBuffer make one, by `new Float32Array(buffer)` say' : '';
  return invalidArgument(argument, expected + more);
}

/** A buffer that was transferred, to a worker, say, has no bytes any more, and neither have the arrays on it: no wonder to its owner. */
function refuseDetached(value, argument) {
  if (!ArrayBuffer.isView(value) && !isBuffer(value)) return;
  try {
    new Uint8Array(value.buffer ?? value);
  } catch {
    const message = `\`${argument}\` is detached: its buffer was transferred, by \`postMessage\` say, and nothing is left here`;
    throw new MorseSmoothError('InvalidArgument', message, { argument, detached: true });
  }
}

/**
 * An options object or nothing. Its keys and values are checked by the wasm module, on a copy: a getter that throws, or that calls
 * back into this package, must not do so from within the module, which would keep the objects of that call borrowed for ever.
 */
export function toOptions(value) {
  if (value === undefined) return undefined;
  if (isRecord(value)) return { ...value };
  throw invalidArgument('options', 'a plain object');
}

/**
 * A plain object, also of another realm. The entries of a Map, or what a class inherits, would be passed over in silence: such
 * values are refused instead.
 */
export function isRecord(value) {
  if (typeof value !== 'object' || value === null) return false;
  const prototype = Object.getPrototypeOf(value);
  return prototype === null || Object.getPrototypeOf(prototype) === null;
}
