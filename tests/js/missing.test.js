// Missing values, which are NaN.
import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { islands, pinched, random, sphere, square, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const shapes = { sphere: sphere(3), torus: torus(20, 12), square: square(12), islands: islands(), pinched: pinched() };
const count = ({ positions }) => positions.length / 3;
const noise = (shape, seed) => Float64Array.from({ length: count(shape) }, random(seed));
/** Values of which some are missing, and neighbours of the first one with it. */
function gappy(shape, seed) {
  const values = noise(shape, seed);
  const chance = random(seed + 1);
  for (let v = 4; v < values.length; v++) if (chance() < 0.04) values[v] = NaN;
  if (values.every((value) => value === value)) values[values.length - 1] = NaN;
  return values;
}

/** The part of the mesh that has values, built here. */
function partOf({ positions, triangles }, values) {
  const kept = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = triangles.slice(t, t + 3);
    if (corners.every((v) => !Number.isNaN(values[v]))) kept.push({ t: t / 3, corners });
  }
  const vertices = [...new Set(kept.flatMap(({ corners }) => corners))].sort((a, b) => a - b);
  const number = new Map(vertices.map((v, k) => [v, k]));
  return {
    positions: vertices.flatMap((v) => positions.slice(3 * v, 3 * v + 3)),
    triangles: kept.flatMap(({ corners }) => corners.map((v) => number.get(v))),
    vertices,
    parents: kept.map(({ t }) => t),
    values: Float64Array.from(vertices, (v) => values[v]),
  };
}

describe.each(Object.keys(shapes))('omitted on the %s', (name) => {
  const shape = shapes[name];
  const values = gappy(shape, 7);
  const part = partOf(shape, values);
  const both = (call) => [call(make(shape), values, { missing: 'omit' }), call(make(part), part.values, {})];
  const whole = (ids) => ids.map((v) => part.vertices[v]);

  it('withoutMissing is the submesh', () => {
    const { mesh, vertices } = make(shape).withoutMissing(values);
    expect([...vertices]).toEqual(part.vertices);
    expect([...mesh.triangles()]).toEqual(part.triangles);
    expect([...mesh.positions()]).toEqual(part.positions);
    mesh.free();
  });

  it('analyses are those of the submesh', () => {
    for (const [method, ids, ...args] of [
      ['criticalPoints', ['vertices']],
      ['deltaHierarchy', ['vertices']],
      ['persistence', ['extrema', 'saddles', 'essentialMinima', 'essentialMaxima', 'essentialSaddles']],
      ['persistenceCurve', []],
      ['morseComplex', ['saddles', 'extrema', 'vertices']],
      ['morseHierarchy', ['vertices']],
      ['levelSets', ['edges'], { count: 7 }],
      ['bands', ['edges'], { count: 5 }],
    ]) {
      const [found, expected] = both((mesh, f, options) => mesh[method](f, ...args, options));
      for (const id of ids) expected[id] = whole(expected[id]);
      if (method === 'bands') expected.parents = expected.parents.map((t) => part.parents[t]);
      expect(found, method).toEqual(expected);
    }
  });

  it('smoothness is that of the submesh', () => {
    for (const weights of ['cotangent', 'intrinsicDelaunay', 'meanValue', 'uniform']) {
      const [found, expected] = both((mesh, f, options) => mesh.smoothness(f, { weights, ...options }));
      expect(found, weights).toEqual(expected);
    }
  });

  it('constrained vertices are those of the submesh', () => {
    for (const rule of [
      { from: 'criticalPoints' },
      { from: 'criticalPoints', delta: 0.1, stars: false },
      { from: 'persistence', threshold: 0.2 },
      { from: 'kMeans', clusters: 4, stars: false },
    ]) {
      const [found, expected] = both((mesh, f, options) => mesh.constrainedVertices(f, rule, options));
      expect(found, rule.from).toEqual(whole(expected));
    }
    const [third] = whole(Uint32Array.of(3));
    const named = (vertices) => ({ from: 'vertices', vertices });
    const found = make(shape).constrainedVertices(values, named([third]), { missing: 'omit' });
    expect(found).toEqual(whole(make(part).constrainedVertices(part.values, named([3]))));
    const gone = values.findIndex(Number.isNaN);
    for (const missing of ['omit', 'fill'])
      expectError(() => make(shape).constrainedVertices(values, [gone], { missing }), 'MissingValue', { vertex: gone });
  });

  it('constrained vertices are as many as smoothing says', () => {
    const smoother = new Smoother(make(shape));
    for (const missing of ['omit', 'fill'])
      for (const constraints of [{ from: 'criticalPoints' }, { from: 'persistence', threshold: 0.2, stars: false }]) {
        const options = { constraints, epsilon: 1, missing, unconstrained: 'keep' };
        const { constraintCount } = smoother.leastSquares(values, options).report;
        expect(make(shape).constrainedVertices(values, constraints, { missing }).length).toBe(constraintCount);
      }
  });

  it('simplified values are those of the submesh, and NaN', () => {
    const [found, expected] = both((mesh, f, options) => mesh.simplify(f, { threshold: 0.2, ...options }));
    const all = new Float64Array(values.length).fill(NaN);
    part.vertices.forEach((v, k) => (all[v] = expected.values[k]));
    // Vertices of no triangle keep theirs.
    const inPart = new Set(part.vertices);
    for (let v = 0; v < values.length; v++) {
      if (inPart.has(v)) expect(found.values[v]).toBe(all[v]);
      else if (Number.isNaN(values[v])) expect(found.values[v]).toBeNaN();
    }
    expect(found.unavoidable).toEqual(whole(expected.unavoidable));
  });

  it('smoothed values are those of the submesh, and NaN', () => {
    const constraints = { from: 'criticalPoints' };
    for (const options of [
      { epsilon: 0.1 },
      { epsilon: 0.1, metric: 'identity' },
      { epsilon: 1, constraints },
      { method: 'interpolate', constraints },
    ]) {
      const [found, expected] = both((mesh, f, more) => smooth(mesh, f, { ...options, ...more }));
      expect(found.report).toEqual(expected.report);
      part.vertices.forEach((v, k) => expect(found.values[v]).toBe(expected.values[k]));
      values.forEach((value, v) => {
        if (Number.isNaN(value)) expect(found.values[v]).toBeNaN();
      });
    }
    const [found, expected] = both((mesh, f, more) => new Smoother(mesh).lowPass(f, { iterations: 3, ...more }));
    part.vertices.forEach((v, k) => expect(found.values[v]).toBe(expected.values[k]));
  });
});

describe('filled', () => {
  const shape = shapes.sphere;
  const values = gappy(shape, 9);

  it('every vertex gets a value, between those around it', () => {
    const smoother = new Smoother(make(shape));
    for (const found of [
      smoother.tikhonov(values, { epsilon: 100, missing: 'fill' }),
      smoother.tikhonov(values, { epsilon: 100, metric: 'identity', missing: 'fill' }),
      smoother.interpolate(values, { constraints: { from: 'criticalPoints' }, missing: 'fill' }),
      smoother.leastSquares(values, { constraints: { from: 'criticalPoints' }, epsilon: 10, missing: 'fill' }),
    ])
      for (const value of found.values) expect(Number.isFinite(value)).toBe(true);
  });

  it('is for smoothing alone, and not for filters', () => {
    const mesh = make(shape);
    expectError(() => mesh.persistence(values, { missing: 'fill' }), 'InapplicableOption', { option: 'missing' });
    const smoother = new Smoother(mesh);
    const options = { iterations: 2, missing: 'fill' };
    expectError(() => smoother.lowPass(values, options), 'InapplicableOption', { option: 'missing' });
  });

  it('a component without any value is an error, or what is asked for', () => {
    const parts = islands();
    const field = noise(parts, 3);
    for (let v = 6; v < field.length; v++) field[v] = NaN;
    const smoother = new Smoother(make(parts));
    const run = (more) => smoother.tikhonov(field, { epsilon: 1, missing: 'fill', ...more });
    expectError(() => run({}), 'Unconstrained');
    expectError(() => run({ unconstrained: 'error' }), 'Unconstrained');
    expect(run({ unconstrained: 'keep' }).values.length).toBe(field.length);
    expectError(() => run({ unconstrained: 'forget' }), 'InvalidOption', { option: 'unconstrained' });
  });
});

describe('refused', () => {
  const mesh = () => make(shapes.square);
  const values = gappy(shapes.square, 11);
  const first = values.findIndex(Number.isNaN);

  it('where nothing is said, or an error is asked for', () => {
    for (const options of [undefined, {}, { missing: undefined }, { missing: 'error' }]) {
      expectError(() => mesh().criticalPoints(values, options), 'NonFiniteValue', { vertex: first });
      expectError(() => mesh().levelSets(values, [0.5], options), 'NonFiniteValue', { vertex: first });
      expectError(() => smooth(mesh(), values, { epsilon: 1, ...options }), 'NonFiniteValue', { vertex: first });
    }
    expectError(() => mesh().persistence(values, { missing: 'skip' }), 'InvalidOption', { option: 'missing' });
  });

  it('infinite values are never missing', () => {
    const infinite = values.with(3, Infinity);
    expectError(() => mesh().persistence(infinite, { missing: 'omit' }), 'NonFiniteValue', { vertex: 3 });
    expectError(() => mesh().withoutMissing(infinite), 'NonFiniteValue', { vertex: 3 });
    for (const missing of ['omit', 'fill'])
      expectError(() => smooth(mesh(), infinite, { epsilon: 1, missing }), 'NonFiniteValue', { vertex: 3 });
  });

  it('all values missing leave no mesh', () => {
    const none = new Float64Array(values.length).fill(NaN);
    expectError(() => mesh().persistence(none, { missing: 'omit' }), 'EmptyMesh');
    expectError(() => mesh().withoutMissing(none), 'EmptyMesh');
    expectError(() => mesh().withoutMissing([1, 2]), 'LengthMismatch');
  });
});
