// Colors of fields, as the pictures of `morse-smooth/snapshot` have them: by vertex, or by a texture that is looked up at every pixel.
import { ClampToEdgeWrapping, Color, DataTexture, LinearFilter, NearestFilter, SRGBColorSpace } from 'three';
import { gap, maps } from 'looks:';
import { isRecord, toNumbers } from '../../runtime/convert.js';
import { invalidOption } from '../../runtime/error.js';
import { written } from './attributes.js';
import { fieldOn, isGiven, optionsOf, toRange } from './options.js';

/** The least width of a texture with steps, whose places are rounded to its texels. */
const STEPPED = 1024;
const MOST_LEVELS = 10_000;

/** The second texture coordinate, where there is a value and where there is none: mixed with this, all of a triangle is far off. */
const VALUE = 0.25;
const NO_VALUE = 1e6;
/** Farther outside a range single precision need not tell values apart. */
const FAR = 1e30;

const decoded = {};

export function colorAttribute(values, vertexMap, options) {
  const { target, colormap, levels, range } = optionsOf('colorAttribute', options);
  const { numbers, map, count } = fieldOn(values, vertexMap);
  const ends = toRange(range) ?? rangeOf(numbers);
  const colorOf = painter(colormap, stepsOf(levels, ends));
  const color = new Color();
  const colors = Float32Array.from({ length: 3 * numbers.length });
  numbers.forEach((value, vertex) => {
    const [red, green, blue] = colorOf(shadeOf(value, ends));
    color.setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace).toArray(colors, 3 * vertex);
  });
  return written(target, count, 3, (put) => {
    for (let k = 0; k < count; k++) {
      const vertex = map ? map[k] : k;
      for (let part = 0; part < 3; part++) put(k, part, colors[3 * vertex + part]);
    }
  });
}

export function shadeAttribute(values, vertexMap, options) {
  const { target, range } = optionsOf('shadeAttribute', options);
  const { numbers, map, count } = fieldOn(values, vertexMap);
  const ends = toRange(range) ?? rangeOf(numbers);
  return written(target, count, 2, (put) => {
    for (let k = 0; k < count; k++) {
      const shade = shadeOf(numbers[map ? map[k] : k], ends);
      put(k, 0, Number.isNaN(shade) ? 0 : shade);
      put(k, 1, Number.isNaN(shade) ? NO_VALUE : VALUE);
    }
  });
}

export function colorTexture(options) {
  const { channel = 0, colormap, levels, range } = optionsOf('colorTexture', options);
  if (!Number.isInteger(channel) || channel < 0 || channel > 3)
    throw invalidOption('channel', 'a whole number from 0 to 3');
  const ends = toRange(range);
  const isByValue = isGiven(levels) && !isRecord(levels);
  if (isByValue && ends === null) throw invalidOption('range', 'two values, where `levels` are values');
  const steps = stepsOf(levels, ends ?? [0, 1]);
  const table = tableOf(colormap);
  const width = steps ? STEPPED : table.length / 3;
  const colorOf = painter(table, steps);
  const pixels = new Uint8Array(8 * width).fill(255);
  for (let k = 0; k < width; k++) {
    // Steps fill the whole width; of a table's colors the first is at 0 and the last at 1.
    pixels.set(colorOf(steps ? (k + 0.5) / width : k / (width - 1)), 4 * k);
    pixels.set(bytesOf(gap), 4 * (width + k));
  }
  const texture = new DataTexture(pixels, width, 2);
  texture.channel = channel;
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.magFilter = texture.minFilter = steps ? NearestFilter : LinearFilter;
  if (!steps) {
    texture.offset.x = 0.5 / width;
    texture.repeat.x = (width - 1) / width;
  }
  texture.needsUpdate = true;
  return texture;
}

/** Colors of the levels of lines, red, green and blue in the working color space. */
export function colorsOf(levels, colormap, range) {
  const ends = toRange(range) ?? rangeOf(levels);
  const colorOf = painter(colormap, null);
  const color = new Color();
  return Array.from(levels, (level) => {
    const [red, green, blue] = colorOf(shadeOf(level, ends));
    return color.setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace).toArray();
  });
}

/** The least and the greatest value; of those that are missing or infinite neither. */
function rangeOf(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return low <= high ? [low, high] : [0, 1];
}

/** Where a value is in a range, 0 to 1 and beyond; in the middle of one that is a single value. NaN remains NaN. */
function shadeOf(value, [low, high]) {
  if (Number.isNaN(value)) return NaN;
  return high > low ? Math.min(FAR, Math.max(-FAR, (value - low) / (high - low))) : 0.5;
}

/** The places of levels within a range; null where colors are continuous. */
function stepsOf(levels, ends) {
  if (!isGiven(levels)) return null;
  if (isRecord(levels)) {
    const { count } = levels;
    const isCount = Number.isInteger(count) && count >= 0 && count <= MOST_LEVELS;
    if (!isCount || Object.keys(levels).length > 1)
      throw invalidOption('levels', `values, or { count } from 0 to ${MOST_LEVELS}`);
    return Array.from({ length: count }, (_, k) => (k + 1) / (count + 1));
  }
  const numbers = toNumbers(levels, 'levels');
  if (!numbers.every(Number.isFinite)) throw invalidOption('levels', 'finite values');
  const places = numbers.map((level) => shadeOf(level, ends)).filter((place) => place > 0 && place < 1);
  return [...new Set(places)].sort((a, b) => a - b);
}

/** A function from a place to red, green and blue, 0 to 255: of the map, or of the step that it is in. */
function painter(colormap, steps) {
  const table = tableOf(colormap);
  const none = bytesOf(gap);
  if (!steps) return (place) => (Number.isNaN(place) ? none : between(table, place));
  const ends = [0, ...steps, 1];
  const colors = ends.slice(1).map((end, k) => between(table, (ends[k] + end) / 2));
  return (place) => (Number.isNaN(place) ? none : colors[upperBound(steps, place)]);
}

/** How many of the ascending numbers are not above `value`. */
function upperBound(numbers, value) {
  let [from, to] = [0, numbers.length];
  while (from < to) {
    const middle = (from + to) >> 1;
    if (numbers[middle] <= value) from = middle + 1;
    else to = middle;
  }
  return from;
}

/** The colors of a map by its name, or such colors. */
function tableOf(colormap) {
  if (!isGiven(colormap)) return tableOf('viridis');
  if (typeof colormap !== 'string') {
    const bytes = toNumbers(colormap, 'colormap');
    const isTable = bytes.length >= 6 && bytes.length % 3 === 0 && bytes.every((byte) => byte >= 0 && byte <= 255);
    if (isTable) return bytes;
    throw invalidOption('colormap', 'a name, or red, green and blue from 0 to 255 of two colors or more');
  }
  if (!Object.hasOwn(maps, colormap)) throw invalidOption('colormap', `one of "${Object.keys(maps).join('", "')}"`);
  return (decoded[colormap] ??= Uint8Array.from(atob(maps[colormap]), (letter) => letter.charCodeAt(0)));
}

function between(table, place) {
  const at = Math.min(1, Math.max(0, place)) * (table.length / 3 - 1);
  const from = Math.min(Math.floor(at), table.length / 3 - 2);
  const mixed = (part) => table[3 * from + part] + (at - from) * (table[3 * from + 3 + part] - table[3 * from + part]);
  return [mixed(0), mixed(1), mixed(2)].map(Math.round);
}

const bytesOf = (color) => [color >> 16, (color >> 8) & 255, color & 255];
