// Reading and writing attributes of geometries, of whichever kind they are.
import { BufferAttribute } from 'three';
import { MorseSmoothError, invalidArgument } from '../../runtime/error.js';

const READERS = ['getX', 'getY', 'getZ', 'getW'];

/** A geometry that cannot be a mesh, or an attribute without numbers. */
export function unsupported(reason, message, more = {}) {
  return new MorseSmoothError('UnsupportedGeometry', message, { reason, ...more });
}

/** An attribute that has its numbers here. */
export function readable(attribute, name) {
  if (attribute?.isGLBufferAttribute) {
    const message = `the attribute \`${name}\` is on the graphics card only, where it cannot be read; make a BufferAttribute of what it was filled with`;
    throw unsupported('onlyOnGraphicsCard', message, { attribute: name });
  }
  if (!attribute?.isBufferAttribute && !attribute?.isInterleavedBufferAttribute) {
    throw invalidArgument(name, 'a BufferAttribute or an InterleavedBufferAttribute of three.js');
  }
  if (!ArrayBuffer.isView(arrayOf(attribute))) {
    const message = `the attribute \`${name}\` has no array any more; an \`onUpload\` that lets go of it must wait until the geometry was read`;
    throw unsupported('noData', message, { attribute: name });
  }
  return attribute;
}

const arrayOf = (attribute) => attribute.array ?? attribute.data?.array;

/** The first `width` components of every entry in double precision, as three.js reads them: normalized ones and halves as numbers. */
export function componentsOf(attribute, width, first = 0) {
  const { array, count, itemSize } = attribute;
  const isPlain = attribute.isBufferAttribute && (array instanceof Float32Array || array instanceof Float64Array);
  if (isPlain && itemSize === width) return Float64Array.from(array.subarray(0, width * count));
  const numbers = new Float64Array(width * count);
  for (let part = 0; part < width; part++) {
    const reader = READERS[first + part];
    for (let k = 0; k < count; k++) numbers[width * k + part] = attribute[reader](k);
  }
  return numbers;
}

/**
 * An attribute with so many entries, into which `write(put)` writes by `put(entry, component, number)`: a new one, or `target`, which
 * the graphics card is then told to take anew.
 */
export function written(target, count, itemSize, write) {
  if (target === undefined || target === null) {
    const array = new Float32Array(count * itemSize);
    write((entry, component, number) => {
      array[entry * itemSize + component] = number;
    });
    return new BufferAttribute(array, itemSize);
  }
  const attribute = readable(target, 'target');
  if (attribute.count !== count || attribute.itemSize !== itemSize) {
    const [expected, actual] = [`${count} × ${itemSize}`, `${attribute.count} × ${attribute.itemSize}`];
    const message = `option \`target\` takes an attribute of ${expected} numbers, but this one has ${actual}`;
    throw new MorseSmoothError('InvalidOption', message, { option: 'target', expected, actual });
  }
  const writers = ['setX', 'setY', 'setZ', 'setW'];
  write((entry, component, number) => attribute[writers[component]](entry, number));
  attribute.needsUpdate = true;
  return attribute;
}
