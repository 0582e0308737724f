// What a scene hands to other renderers.
import initCore, { TriMesh } from 'morse-smooth';
import init, { Scene } from 'morse-smooth/snapshot';
import { beforeAll, describe, expect, it } from 'vitest';
import { dot, random, square, tetrahedron } from './meshes.js';
import { field, shape } from './pictures.js';

const { positions, triangles } = shape;
let scene;
let mesh;
let surface;

beforeAll(async () => {
  await Promise.all([init(), initCore()]);
  scene = new Scene(positions, triangles);
  mesh = new TriMesh(positions, triangles);
  surface = scene.surface();
});

/** The entries of an array in threes. */
const triples = (array) => Array.from({ length: array.length / 3 }, (_, k) => [...array.subarray(3 * k, 3 * k + 3)]);
const difference = (p, q) => p.map((x, axis) => x - q[axis]);
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const norm = (p) => Math.hypot(...p);
/** Where points of the mesh are drawn. */
const placed = (points) => triples(points).map((p) => difference(p, surface.center).map((x) => surface.scale * x));
const at = (vertices) => placed(Float64Array.from([...vertices].flatMap((v) => positions.slice(3 * v, 3 * v + 3))));

function expectPoints(points, expected) {
  expect(points).toHaveLength(3 * expected.length);
  expect(Math.max(...triples(points).map((p, k) => norm(difference(p, expected[k]))), 0)).toBeLessThan(1e-6);
}

function expectUnits(vectors) {
  for (const vector of triples(vectors)) expect(norm(vector)).toBeCloseTo(1, 6);
}

/** Every typed array in an object, however deep. */
function arraysOf(object) {
  if (ArrayBuffer.isView(object)) return [object];
  if (typeof object !== 'object' || object === null) return [];
  return Object.values(object).flatMap(arraysOf);
}

describe('a surface', () => {
  it('has the arrays of the types, each the caller’s own', () => {
    const { positions, normals, triangles, vertices, up, center, scale } = surface;
    expect([positions, normals].map((array) => array.constructor)).toEqual([Float32Array, Float32Array]);
    expect([triangles, vertices].map((array) => array.constructor)).toEqual([Uint32Array, Uint32Array]);
    expect(center).toEqual([expect.any(Number), expect.any(Number), expect.any(Number)]);
    expect([typeof scale, up]).toEqual(['number', 'y']);
    for (const array of arraysOf(surface)) expect(array.byteLength).toBe(array.buffer.byteLength);
    scene.surface().positions.fill(7);
    expect(scene.surface()).toEqual(surface);
  });

  it('is the mesh in the unit ball', () => {
    expect(surface.vertices).toEqual(Uint32Array.from({ length: mesh.vertexCount }, (_, v) => v));
    expectPoints(surface.positions, at(surface.vertices));
    const distances = triples(surface.positions).map(norm);
    expect(Math.max(...distances)).toBeCloseTo(1, 6);
    const boxes = [0, 1, 2].map((axis) => triples(surface.positions).map((p) => p[axis]));
    for (const box of boxes) expect(Math.max(...box) + Math.min(...box)).toBeCloseTo(0, 6);
  });

  it('has unit normals on the side that triangles face, outside', () => {
    expectUnits(surface.normals);
    const [points, normals] = [triples(surface.positions), triples(surface.normals)];
    let volume = 0;
    for (const corners of triples(surface.triangles)) {
      const [p, q, r] = corners.map((corner) => points[corner]);
      const face = cross(difference(q, p), difference(r, p));
      volume += dot(p, face);
      for (const corner of corners) expect(dot(normals[corner], face)).toBeGreaterThan(0);
    }
    expect(volume).toBeGreaterThan(0);
  });

  it('has every triangle of the mesh, whichever way they were turned', () => {
    const sorted = (ids) => triples(ids).map((corners) => corners.sort((a, b) => a - b).join());
    const wild = Uint32Array.from(triangles);
    const next = random(5);
    for (const corners of [...Array(wild.length / 3).keys()]) {
      if (next() < 0.5) wild.subarray(3 * corners, 3 * corners + 2).reverse();
    }
    expect(sorted(wild)).toEqual(sorted(Uint32Array.from(triangles)));
    const turned = new Scene(positions, wild).surface();
    expect(sorted(turned.triangles.map((corner) => turned.vertices[corner]))).toEqual(sorted(wild));
    expectPoints(turned.normals, triples(surface.normals));
  });

  it('has corners of its own at creases', () => {
    const { positions, triangles } = tetrahedron();
    // The normals of its sides are 109° apart: none is the mean of two.
    const { vertices, normals, up } = new Scene(positions, triangles).surface();
    expect([...vertices].sort()).toEqual(Array.from({ length: 12 }, (_, k) => Math.floor(k / 3)));
    for (const normal of triples(normals)) {
      for (const x of normal) expect(Math.abs(x)).toBeCloseTo(Math.sqrt(1 / 3), 6);
    }
    expect(up).toBe('y');
  });

  it('that lies flat has z up, and leaves out what belongs to no triangle', () => {
    const { positions, triangles } = square(3);
    const { up, vertices, normals } = new Scene([...positions, 50, 50, 50], triangles).surface();
    expect(up).toBe('z');
    expect(vertices).toEqual(Uint32Array.from({ length: 16 }, (_, v) => v));
    expect(triples(normals)).toEqual(Array(16).fill([0, 0, 1]));
  });
});

describe('a draw list', () => {
  const list = (options) => scene.drawList(field, options);
  const [low, high] = [Math.min(...field), Math.max(...field)];

  it('does not depend on what was drawn before, and is the caller’s own', () => {
    const first = list();
    scene.drawList(field.map(Math.cos), { bands: true });
    for (const array of arraysOf(list())) {
      expect(array.byteLength).toBe(array.buffer.byteLength);
      array.fill(1);
    }
    expect(list()).toEqual(first);
    for (const array of arraysOf(first)) {
      if (array instanceof Float32Array) expect(array.every(Number.isFinite)).toBe(true);
    }
  });

  it('has a shade for every corner', () => {
    const { shades, range } = list();
    expect(range).toEqual([low, high]);
    expect(shades).toEqual(Float32Array.from(surface.vertices, (v) => (field[v] - low) / (high - low)));
    const wide = list({ range: [-10, 30] });
    expect(wide.range).toEqual([-10, 30]);
    expect(wide.shades).toEqual(Float32Array.from(surface.vertices, (v) => (field[v] + 10) / 40));
    const narrow = list({ range: [0, 0.5] }).shades;
    expect(narrow).toEqual(Float32Array.from(surface.vertices, (v) => field[v] / 0.5));
    expect(new Set(scene.drawList(new Float32Array(field.length).fill(3)).shades)).toEqual(new Set([0.5]));
  });

  it('has no shade where there is no value', () => {
    expect(list().gap).toBe(null);
    expect(list({ missing: 'omit' })).toEqual(list());
    const missing = [5, 17, 40];
    const values = Float64Array.from(field, (value, v) => (missing.includes(v) ? NaN : value));
    const { shades, gap, range, solids, lines } = scene.drawList(values, { missing: 'omit', levels: [0.2] });
    expect(surface.vertices.filter((_, corner) => Number.isNaN(shades[corner]))).toEqual(Uint32Array.from(missing));
    expect(gap).toBe(0xaaaaaa);
    // All else is that of the part that has values.
    const { mesh: part, vertices } = mesh.withoutMissing(values);
    const known = Float64Array.from(vertices, (v) => values[v]);
    const found = part.criticalPoints(known);
    const drawn = solids.flatMap((solid) => [...solid.vertices]).sort((a, b) => a - b);
    expect(drawn).toEqual([...found.vertices].map((v) => vertices[v]).sort((a, b) => a - b));
    expect(range).toEqual([Math.min(...known), Math.max(...known)]);
    expect(lines[0].points).toHaveLength(part.levelSets(known, [0.2]).points.length);
    part.free();
  });

  it('has the colors of its map', () => {
    const ends = ({ colors }) => [...colors.subarray(0, 3), ...colors.subarray(-3)];
    expect(ends(list())).toEqual([68, 1, 84, 253, 231, 37]);
    expect(ends(list({ colormap: 'coolWarm' }))).toEqual([59, 76, 192, 180, 4, 38]);
    const { colors } = list({ colormap: 'magma' });
    expect(colors).toBeInstanceOf(Uint8Array);
    expect(colors.length % 3).toBe(0);
    // No step that an eye would see.
    for (let k = 3; k < colors.length; k++) expect(Math.abs(colors[k] - colors[k - 3])).toBeLessThanOrEqual(4);
  });

  it('says its levels, ascending and each once', () => {
    const width = high - low;
    const { levels } = list({ levels: { count: 3 } });
    expect(levels).toBeInstanceOf(Float64Array);
    [0.25, 0.5, 0.75].forEach((share, k) => expect(levels[k]).toBeCloseTo(low + share * width, 12));
    expect(list({ levels: [1, -1, 1, 99] }).levels).toEqual(Float64Array.of(-1, 1, 99));
    expect(list({ levels: [] }).levels).toEqual(new Float64Array(0));
  });

  it('has steps in its colors between bands', () => {
    const levels = [-1, 0, 0.25, 1.5];
    const { colors, range } = list({ bands: true, levels: [...levels, -99, 99] });
    const steps = colors.length / 3 - 1;
    const color = (k) => colors.subarray(3 * k, 3 * k + 3).join();
    const places = Array.from({ length: steps }, (_, k) => k + 1).filter((k) => color(k) !== color(k - 1));
    expect(places).toHaveLength(levels.length);
    for (const [k, place] of places.entries()) {
      const shade = (levels[k] - range[0]) / (range[1] - range[0]);
      expect(place / steps - shade).toBeGreaterThanOrEqual(0);
      expect(place / steps - shade).toBeLessThan(1 / steps);
    }
    // Each band has the color of its middle.
    const even = list({ bands: true, levels: { count: 1 }, range: [0, 1] }).colors;
    const smooth = list().colors;
    const near = (part) =>
      smooth.subarray(3 * Math.round((part * smooth.length) / 3), 3 * Math.round((part * smooth.length) / 3) + 3);
    for (const [place, part] of [
      [0, 0.25],
      [even.length - 3, 0.75],
    ]) {
      expect(norm(difference([...even.subarray(place, place + 3)], [...near(part)]))).toBeLessThan(4);
    }
    expect(new Set(list({ bands: true, levels: [] }).colors.slice(0, 300)).size).toBeLessThanOrEqual(3);
  });

  it('has the lines of level sets', () => {
    const levels = [-1.5, 0.3, 2];
    const { lines } = list({ levels });
    expect(lines).toHaveLength(1);
    const [{ kind, points, offsets, closed, stroke }] = lines;
    const sets = mesh.levelSets(field, levels);
    expect(kind).toBe('levels');
    expectPoints(points, placed(sets.points));
    expect([offsets, closed]).toEqual([sets.offsets, sets.closed]);
    expectStroke(stroke);
    expect(list({ levels: sets }).lines).toEqual(lines);
  });

  it('has the lines of the Morse complex, those to minima first', () => {
    const found = mesh.morseComplex(field, { paths: 'merged', persistence: 0.1 });
    const { lines } = list({ levels: [], morseComplex: { persistence: 0.1 } });
    const complex = lines.filter(({ kind }) => kind !== 'levels');
    expect(complex.map(({ kind }) => kind)).toEqual(['descending', 'ascending']);
    for (const [which, sign] of [-1, 1].entries()) {
      const chosen = [...found.kinds.keys()].filter((line) => found.kinds[line] === sign);
      const paths = chosen.map((line) => found.vertices.slice(found.offsets[line], found.offsets[line + 1]));
      const { points, offsets, closed, stroke } = complex[which];
      expectPoints(points, paths.flatMap(at));
      const lengths = paths.map((path) => path.length);
      expect(offsets).toEqual(
        Uint32Array.from([0, ...lengths], (_, k) => lengths.slice(0, k).reduce((a, b) => a + b, 0)),
      );
      expect(closed).toEqual(new Uint8Array(paths.length));
      expectStroke(stroke);
    }
  });

  it('has a solid for each kind of critical points', () => {
    const { vertices, kinds } = mesh.criticalPoints(field);
    const { solids, size } = list();
    expect(solids.map(({ kind }) => kind)).toEqual(['minima', 'saddles', 'maxima']);
    for (const [which, sign] of [-1, 0, 1].entries()) {
      const { shape, color, rim, glow, radius, lift, places, axes, ...solid } = solids[which];
      expect(solid.vertices).toEqual(vertices.filter((_, k) => kinds[k] === sign));
      expectPoints(places, at(solid.vertices));
      expectPoints(
        axes,
        [...solid.vertices].map((v) => triples(surface.normals)[v]),
      );
      expectUnits(axes);
      expect(radius).toBeCloseTo(
        Math.min(size.most, Math.max(size.least, Math.sqrt(size.cover / vertices.length))),
        12,
      );
      expect(lift).toBeGreaterThanOrEqual(0);
      expectColor(color);
      expectColor(rim.color);
      expect(rim.scale).toBeGreaterThan(1);
      expect(glow).toBeGreaterThanOrEqual(0);
      expect(glow).toBeLessThanOrEqual(1);
      expectUnits(shape.normals);
      expect(shape.normals).toHaveLength(shape.positions.length);
      expect(Math.max(...shape.triangles)).toBe(shape.positions.length / 3 - 1);
    }
    expect(new Set(solids.map(({ color }) => color)).size).toBe(3);
    expect(list({ criticalPoints: false }).solids).toEqual([]);
    const one = { vertices: [7], kinds: Int8Array.of(0) };
    expect(list({ criticalPoints: one }).solids.map(({ kind, vertices }) => [kind, ...vertices])).toEqual([
      ['saddles', 7],
    ]);
  });

  it('has solids whose triangles face outwards', () => {
    for (const { shape } of list().solids) {
      const [points, normals] = [triples(shape.positions), triples(shape.normals)];
      for (const corners of triples(shape.triangles)) {
        const [p, q, r] = corners.map((corner) => points[corner]);
        const face = cross(difference(q, p), difference(r, p));
        expect(dot(p, face)).toBeGreaterThan(0);
        for (const corner of corners) expect(dot(normals[corner], face)).toBeGreaterThan(0);
      }
    }
  });

  it('has light', () => {
    const { ambient, diffuse, direction } = list().light;
    expect(norm(direction)).toBeCloseTo(1, 2);
    for (const strength of [ambient, diffuse]) {
      expect(strength).toBeGreaterThan(0);
      expect(strength).toBeLessThan(1);
    }
  });
});

function expectColor(color) {
  expect(Number.isInteger(color)).toBe(true);
  expect(color).toBeGreaterThanOrEqual(0);
  expect(color).toBeLessThanOrEqual(0xffffff);
}

function expectStroke({ color, width, opacity, casing }) {
  expectColor(color);
  expect(width).toBeGreaterThan(0);
  expect(opacity).toBeGreaterThan(0);
  expect(opacity).toBeLessThanOrEqual(1);
  if (casing === null) return;
  expectColor(casing.color);
  expect(casing.width).toBeGreaterThan(width);
}
