// Arguments on their way to a worker. What arrives is refused there as it would be here: nothing is checked twice.
import { isRecord, typedArrayName } from '../../runtime/convert.js';

/** The name of the only entry of what stands for something that cannot be sent. */
const MARK = 'morse-smooth:';
/** How deep objects of arguments are looked into; none that is meant for this package is as deep. */
const DEEPEST = 16;

/**
 * Copies of arguments that can be posted, and nothing of the caller's in them. `objectOf(value)` gives the number of an object that
 * lives in workers. With `takesOver` whole arrays are taken from the caller instead of being copied.
 */
export function encode(args, takesOver, objectOf) {
  const walk = (value, depth) => {
    if (typeof value === 'function' || typeof value === 'symbol') return { [MARK]: typeof value };
    if (typeof value !== 'object' || value === null) return value;
    if (ArrayBuffer.isView(value)) return encodeView(value, takesOver);
    if (isBuffer(value)) return encodeBuffer(value, takesOver);
    const object = objectOf(value);
    if (object !== undefined) return { [MARK]: 'object', object };
    if (depth > DEEPEST) return { [MARK]: 'foreign' };
    if (Array.isArray(value)) {
      return value.every(isSimple) ? value.slice() : Array.from(value, (entry) => walk(entry, depth + 1));
    }
    if (!isRecord(value)) return { [MARK]: 'foreign' };
    return mapped(value, (entry) => walk(entry, depth + 1));
  };
  return args.map((value) => walk(value, 0));
}

/** The arguments as the worker passes them on; `objects` are those that live there, by number. */
export function decode(args, objects) {
  const walk = (value) => {
    if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value) || isBuffer(value)) return value;
    if (Array.isArray(value)) return value.every(isSimple) ? value : value.map(walk);
    return MARK in value ? revived(value, objects) : mapped(value, walk);
  };
  return args.map(walk);
}

/** The buffers of all typed arrays in a value, each once. */
export function buffersIn(value, found = new Set()) {
  if (ArrayBuffer.isView(value)) {
    if (isBuffer(value.buffer)) found.add(value.buffer);
  } else if (isBuffer(value)) found.add(value);
  else if (typeof value === 'object' && value !== null) {
    const entries = Array.isArray(value) && value.every(isSimple) ? [] : Object.values(value);
    for (const entry of entries) buffersIn(entry, found);
  }
  return found;
}

/** A class that no argument is of. */
class Foreign {}

function revived(value, objects) {
  switch (value[MARK]) {
    case 'object':
      return objects.get(value.object);
    case 'function':
      return () => {};
    case 'symbol':
      return Symbol('symbol');
    case 'detached': {
      const array = new globalThis[value.name](8);
      structuredClone(array, { transfer: [array.buffer ?? array] });
      return array;
    }
    default:
      return new Foreign();
  }
}

function encodeView(view, takesOver) {
  const name = typedArrayName(view);
  // No array, and nothing that is taken.
  if (name === 'DataView') return { [MARK]: 'foreign' };
  const { buffer } = view;
  if (view.byteLength === 0 && isDetached(buffer)) return { [MARK]: 'detached', name };
  const isWhole = takesOver && isBuffer(buffer) && view.byteLength === buffer.byteLength;
  return (isWhole && taken(view, buffer)) || new globalThis[name](view);
}

function encodeBuffer(buffer, takesOver) {
  if (buffer.byteLength === 0 && isDetached(buffer)) return { [MARK]: 'detached', name: 'ArrayBuffer' };
  return (takesOver && taken(buffer, buffer)) || buffer.slice(0);
}

/** What the caller had; nothing where the buffer is one of those that cannot be taken away, such as a WebAssembly memory. */
function taken(value, buffer) {
  try {
    return structuredClone(value, { transfer: [buffer] });
  } catch {
    return null;
  }
}

function isDetached(buffer) {
  try {
    return new Uint8Array(buffer) === null;
  } catch {
    return true;
  }
}

const isBuffer = (value) => Object.prototype.toString.call(value) === '[object ArrayBuffer]';

/** What may stay as it is. */
const isSimple = (value) => value === null || !['object', 'function', 'symbol'].includes(typeof value);

/** An object with the same names, `__proto__` included. */
const mapped = (record, change) =>
  Object.fromEntries(Object.entries(record).map(([name, value]) => [name, change(value)]));
