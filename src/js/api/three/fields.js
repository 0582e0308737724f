// Fields as attributes of geometries, and the other way round.
import { MorseSmoothError, invalidOption } from '../../runtime/error.js';
import { componentsOf, readable, written } from './attributes.js';
import { fieldOn, isGiven, optionsOf, toMap } from './options.js';

export function fieldAttribute(values, vertexMap, options) {
  const { target } = optionsOf('fieldAttribute', options);
  const { numbers, map, count } = fieldOn(values, vertexMap);
  return written(target, count, 1, (put) => {
    for (let k = 0; k < count; k++) put(k, 0, numbers[map ? map[k] : k]);
  });
}

export function fieldValues(attribute, vertexMap, options) {
  const { component, seams = 'error', tolerance = 0 } = optionsOf('fieldValues', options);
  if (seams !== 'error' && seams !== 'mean') throw invalidOption('seams', '"error" or "mean"');
  if (typeof tolerance !== 'number' || !(tolerance >= 0)) throw invalidOption('tolerance', 'a number from 0');
  const map = toMap(vertexMap);
  const { count, itemSize } = readable(attribute, 'attribute');
  const corners = componentsOf(attribute, 1, partOf(component, itemSize));
  if (map === null) return { values: corners, seams: new Uint32Array(0) };
  if (map.length !== count) {
    const message = `the vertex map is for ${map.length} vertices, but the attribute has ${count}`;
    throw new MorseSmoothError('LengthMismatch', message, { expected: map.length, actual: count });
  }
  const { values, apart } = joined(corners, map, tolerance);
  if (seams === 'error' && apart.length > 0) throw disagreement(apart, corners, map);
  return { values, seams: Uint32Array.from(apart) };
}

function partOf(component, itemSize) {
  if (!isGiven(component) && itemSize === 1) return 0;
  const isOne = Number.isInteger(component) && component >= 0 && component < Math.min(4, itemSize);
  if (!isOne) throw invalidOption('component', `a whole number below ${itemSize}, the components of the attribute`);
  return component;
}

/** One value for each vertex of the mesh, and the vertices whose corners lie more than the tolerance apart. */
function joined(corners, map, tolerance) {
  const size = map.reduce((most, vertex) => Math.max(most, vertex + 1), 0);
  const low = new Float64Array(size).fill(Infinity);
  const high = new Float64Array(size).fill(-Infinity);
  const [sum, valued, all] = [new Float64Array(size), new Uint32Array(size), new Uint32Array(size)];
  map.forEach((vertex, corner) => {
    const value = corners[corner];
    all[vertex]++;
    if (Number.isNaN(value)) return;
    valued[vertex]++;
    sum[vertex] += value;
    low[vertex] = Math.min(low[vertex], value);
    high[vertex] = Math.max(high[vertex], value);
  });
  const apart = [];
  const values = sum.map((total, vertex) => {
    if (valued[vertex] === 0) return NaN;
    if (low[vertex] === high[vertex] && valued[vertex] === all[vertex]) return low[vertex];
    if (high[vertex] - low[vertex] > tolerance || valued[vertex] < all[vertex]) apart.push(vertex);
    return total / valued[vertex];
  });
  return { values, apart };
}

function disagreement(apart, corners, map) {
  const [vertex] = apart;
  const at = [...map.keys()].filter((corner) => map[corner] === vertex);
  const [a] = at;
  const b = at.find((corner) => !Object.is(corners[corner], corners[a]));
  const found = [corners[a], corners[b]];
  const message =
    `vertices ${a} and ${b} of the geometry are the same place, but their values are ${found.join(' and ')}` +
    `; so it is at ${apart.length} of the mesh's vertices. { seams: "mean" } takes means, a \`tolerance\` lets small differences pass`;
  return new MorseSmoothError('SeamDisagreement', message, {
    vertex,
    corners: [a, b],
    values: found,
    count: apart.length,
  });
}
