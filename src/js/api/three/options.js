import { isRecord, toIds, toNumbers } from '../../runtime/convert.js';
import { MorseSmoothError, invalidArgument, invalidOption } from '../../runtime/error.js';
import { hintsOf } from '../../runtime/hints.js';

const colors = 'colormap range levels';

/** The options of every function. */
const options = {
  meshOf: 'weld',
  fieldAttribute: 'target',
  fieldValues: 'component seams tolerance',
  colorAttribute: `target ${colors}`,
  shadeAttribute: 'target range',
  colorTexture: `channel ${colors}`,
  fillLines: 'colormap range',
  levelLines: 'color colormap range material',
  criticalPoints: 'colors size material',
  criticalMarkers: 'colors radius geometry material',
};
const hint = hintsOf(options);

/** A copy of the options of a function, which has no others. */
export function optionsOf(name, given) {
  if (given === undefined || given === null) return {};
  if (!isRecord(given)) throw invalidArgument('options', 'a plain object');
  const unknown = Object.keys(given).find((option) => !options[name].split(' ').includes(option));
  if (unknown === undefined) return { ...given };
  const more = hint(unknown);
  const message = `there is no option \`${unknown}\`${more?.text ?? ''}`;
  throw new MorseSmoothError('UnknownOption', message, { option: unknown, ...more?.detail });
}

export const isGiven = (value) => value !== undefined && value !== null;

/** Two values, or nothing. */
export function toRange(value) {
  if (!isGiven(value)) return null;
  const range = toNumbers(value, 'range');
  const isRange = range.length === 2 && range.every(Number.isFinite) && range[0] <= range[1];
  if (!isRange) throw invalidOption('range', 'two finite values, the lower one first');
  return range;
}

/** For every vertex of a geometry the vertex of the mesh that it became; null where they are the same. */
export function toMap(value) {
  if (!isGiven(value)) return null;
  return toIds(value, 'vertexMap', (id, index) =>
    invalidArgument('vertexMap', 'vertex numbers of the mesh, from 0', { index }),
  );
}

/** Values of a field on the mesh that the map leads to, and how many vertices the geometry has. */
export function fieldOn(values, vertexMap) {
  const numbers = toNumbers(values, 'values');
  const map = toMap(vertexMap);
  // Every vertex of the mesh was one of the geometry.
  const expected = map ? map.reduce((most, vertex) => Math.max(most, vertex + 1), 0) : numbers.length;
  if (expected === numbers.length) return { numbers, map, count: map ? map.length : expected };
  const message = `${expected} values are needed, one per vertex of the mesh, but there are ${numbers.length}`;
  throw new MorseSmoothError('LengthMismatch', message, { expected, actual: numbers.length });
}
