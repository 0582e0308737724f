// Level sets, and other lines of a field, as segments.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from 'three';
import { line as LINE } from 'looks:';
import { isRecord, toIds, toNumbers } from '../../runtime/convert.js';
import { MorseSmoothError, invalidArgument, invalidOption } from '../../runtime/error.js';
import { colorsOf } from './colors.js';
import { isGiven, optionsOf } from './options.js';

export function segmentsOf(lines) {
  const { points, offsets, closed, count } = checked(lines);
  const ends = [];
  const owners = [];
  for (let line = 0; line < count; line++) {
    const [first, end] = [offsets[line], offsets[line + 1]];
    for (let point = first; point + 1 < end; point++) {
      ends.push(point, point + 1);
      owners.push(line);
    }
    if (!closed?.[line] || end - first < 2) continue;
    ends.push(end - 1, first);
    owners.push(line);
  }
  const positions = new Float32Array(3 * ends.length);
  ends.forEach((point, k) => positions.set(points.subarray(3 * point, 3 * point + 3), 3 * k));
  return { positions, lines: Uint32Array.from(owners) };
}

export function fillLines(geometry, lines, options) {
  return fill(geometry, lines, optionsOf('fillLines', options));
}

export function levelLines(lines, options) {
  const { color, material, ...colors } = optionsOf('levelLines', options);
  if (isGiven(color) && isGiven(colors.colormap)) {
    const message = 'lines have one `color`, or those of a `colormap`';
    throw new MorseSmoothError('InapplicableOption', message, { option: 'color' });
  }
  const geometry = fill(new BufferGeometry(), lines, colors);
  const own = isGiven(colors.colormap) ? { vertexColors: true } : { color: color ?? LINE };
  return new LineSegments(geometry, material ?? new LineBasicMaterial(own));
}

function fill(geometry, lines, { colormap, range }) {
  const isWide = typeof geometry?.setPositions === 'function';
  if (!geometry?.isBufferGeometry) throw invalidArgument('geometry', 'a LineSegmentsGeometry or a BufferGeometry of three.js'); // prettier-ignore
  if (isGiven(range) && !isGiven(colormap)) {
    const message = 'option `range` says which levels have the ends of a `colormap`, and there is none';
    throw new MorseSmoothError('InapplicableOption', message, { option: 'range' });
  }
  const { positions, lines: owners } = segmentsOf(lines);
  const colors = isGiven(colormap) ? colorsOfSegments(checked(lines), owners, colormap, range) : null;
  if (isWide) {
    geometry.setPositions(positions);
    if (colors) geometry.setColors(colors);
  } else {
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    if (colors) geometry.setAttribute('color', new BufferAttribute(colors, 3));
    geometry.computeBoundingSphere();
  }
  geometry.userData.lines = owners;
  return geometry;
}

/** Each end of each segment has the color of its level. */
function colorsOfSegments({ levels }, owners, colormap, range) {
  if (levels === null) throw invalidOption('colormap', 'lines with `levels`, as `levelSets` gives them');
  const each = colorsOf(levels, colormap, range);
  const colors = new Float32Array(6 * owners.length);
  owners.forEach((line, k) => colors.set([...each[line], ...each[line]], 6 * k));
  return colors;
}

function checked(lines) {
  if (!isRecord(lines))
    throw invalidArgument('lines', 'an object with `points` and `offsets`, as `levelSets` gives it');
  const refusal = () => invalidArgument('lines.offsets', 'numbers that ascend from 0 to the number of points');
  const points = toNumbers(lines.points, 'lines.points');
  const offsets = toIds(lines.offsets, 'lines.offsets', refusal);
  const ascend = offsets.every((offset, k) => (k === 0 ? offset === 0 : offset >= offsets[k - 1]));
  if (!ascend || offsets.length === 0 || 3 * offsets.at(-1) !== points.length) throw refusal();
  const count = offsets.length - 1;
  const flagged = (name) => {
    if (!isGiven(lines[name])) return null;
    const numbers = toNumbers(lines[name], `lines.${name}`);
    if (numbers.length !== count) throw invalidArgument(`lines.${name}`, `${count} numbers, one for each line`);
    return numbers;
  };
  return { points, offsets, closed: flagged('closed'), levels: flagged('levels'), count };
}
