// Arguments that only the functions of `morse-smooth` take, as its wasm module takes them.
import { isRecord, toNumbers, toVertices } from '../../runtime/convert.js';
import { MorseSmoothError, invalidOption } from '../../runtime/error.js';

/** Vertices of a mesh that has so many, or a rule that finds them. */
export function toConstraints(value, vertexCount) {
  if (!isRecord(value)) return toVertices(value, 'constraints', vertexCount);
  const rule = { ...value };
  const { vertices } = rule;
  const areGiven = vertices !== undefined && vertices !== null;
  if (areGiven) rule.vertices = toVertices(vertices, 'constraints.vertices', vertexCount);
  return rule;
}

/** Extrema by their vertices, `{ minima, maxima }` of a mesh that has so many vertices, or a rule that finds them. */
export function toExtrema(value, vertexCount) {
  if (!isRecord(value)) return toVertices(value, 'extrema', vertexCount);
  const choice = { ...value };
  const isRule = choice.from !== undefined && choice.from !== null;
  for (const kind of isRule ? [] : ['minima', 'maxima']) {
    const isThere = choice[kind] !== undefined && choice[kind] !== null;
    if (isThere) choice[kind] = toVertices(choice[kind], `extrema.${kind}`, vertexCount);
  }
  return choice;
}

/** Levels by value, or `{ count }`, or `{ saddles }` of a mesh with so many vertices. */
export function toLevels(value, vertices) {
  if (!isRecord(value)) return toNumbers(value, 'levels');
  const settings = { ...value };
  const { saddles } = settings;
  const areGiven = saddles !== undefined && saddles !== null && saddles !== true;
  if (areGiven) settings.saddles = toVertices(saddles, 'saddles', vertices);
  return settings;
}

/** Refuses a number of channels that cannot be, or that so few values cannot have: the module counts in 32 bits. */
export function checkChannels(settings, vertexCount, values) {
  const channels = settings?.channels;
  if (channels === undefined || channels === null) return;
  if (!Number.isInteger(channels) || channels < 1) throw invalidOption('channels', 'a positive integer');
  if (channels >= 2 ** 32) throw invalidOption('channels', 'a positive integer below 2³²');
  const [expected, actual] = [channels * vertexCount, values.length];
  if (expected < 2 ** 32) return;
  const message = `${expected} values are needed, one per vertex and channel, but there are ${actual}`;
  throw new MorseSmoothError('LengthMismatch', message, { expected, actual });
}
