import init, { TriMesh } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { takeAnyValues } from './any-values.js';
import { expectError } from './errors.js';
import { heights, islands, moebius, octahedron, random, sphere, square, tetrahedron, torus } from './meshes.js';
import { isBelow, linkParts, neighbours, steepest } from './truths.js';

beforeAll(() => init());

const NOWHERE = 4294967295;
const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const noise = ({ positions }, seed) => Float64Array.from({ length: positions.length / 3 }, random(seed));
const tied = (shape, seed) => noise(shape, seed).map((x) => Math.floor(5 * x));
const shapes = {
  octahedron: octahedron(),
  sphere: sphere(3),
  torus: torus(20, 12),
  square: square(9),
  'Möbius strip': moebius(),
  islands: islands(),
};
const closed = ['octahedron', 'sphere', 'torus', 'islands'];
const fields = (shape) => [noise(shape, 21), noise(shape, 22), tied(shape, 23)];
/** Without ties: of edges that are equally steep but for rounding, which one is taken depends on how lengths are computed. */
const untied = (shape) => [noise(shape, 21), noise(shape, 22)];
const thresholds = [0, 0.03, 0.13, 0.37, 0.71, 1.5];
const ascending = (list) => [...list].sort((a, b) => a - b);

/** Of the vertices that belong to triangles. */
function rangeOf({ triangles }, values) {
  const used = triangles.map((v) => values[v]);
  return Math.max(...used) - Math.min(...used);
}

/** The lines as lists of vertices. */
const linesOf = ({ vertices, offsets }) => [...offsets].slice(1).map((end, k) => [...vertices.slice(offsets[k], end)]);

/** How often each text is in a list. */
function counted(list) {
  const counts = {};
  for (const entry of list) counts[entry] = (counts[entry] ?? 0) + 1;
  return counts;
}

function edgesOf(complex) {
  return linesOf(complex).flatMap((line, k) =>
    line.slice(1).map((v, i) => `${complex.kinds[k]}: ${ascending([v, line[i]]).join('–')}`),
  );
}

describe('the Morse complex', () => {
  it('of height on an upright torus: eight lines, four from each saddle', () => {
    const shape = torus();
    const z = heights(shape);
    const complex = make(shape).morseComplex(z);
    const [low, high] = [z.indexOf(Math.min(...z)), z.indexOf(Math.max(...z))];
    expect(complex.offsets).toBeInstanceOf(Uint32Array);
    expect([...complex.kinds]).toEqual([-1, -1, -1, -1, 1, 1, 1, 1]);
    expect([...complex.extrema]).toEqual([low, low, low, low, high, high, high, high]);
    const heightsOfSaddles = [...complex.saddles].map((v) => Math.round(z[v])).sort();
    expect(heightsOfSaddles).toEqual([-1, -1, -1, -1, 1, 1, 1, 1]);
  });

  it('of a monkey saddle: three lines down and three up', () => {
    // Re (x + iy)³ on a hexagon, in which values alternate; the edges around it are of the same length.
    const corners = [0, 1, 2, 3, 4, 5].map((k) => [Math.cos((k * Math.PI) / 3), Math.sin((k * Math.PI) / 3), 0]);
    const shape = {
      positions: [0, 0, 0, ...corners.flat()],
      triangles: [0, 1, 2, 3, 4, 5].flatMap((k) => [0, 1 + k, 1 + ((k + 1) % 6)]),
    };
    const { saddles, extrema, kinds, vertices, offsets } = make(shape).morseComplex([0, 1, -1, 1, -1, 1, -1]);
    expect([...saddles]).toEqual([0, 0, 0, 0, 0, 0]);
    expect([...kinds]).toEqual([-1, -1, -1, 1, 1, 1]);
    expect(ascending(extrema)).toEqual([1, 2, 3, 4, 5, 6]);
    expect([...offsets]).toEqual([0, 2, 4, 6, 8, 10, 12]);
    expect([...vertices]).toEqual([...extrema].flatMap((v) => [0, v]));
  });

  it.each(Object.keys(shapes))('has a line for each part of each saddle’s link, steepest edge by edge: %s', (name) => {
    const shape = shapes[name];
    const mesh = make(shape);
    const around = neighbours(shape);
    for (const values of untied(shape)) {
      const complex = mesh.morseComplex(values);
      const lines = linesOf(complex);
      expect(complex.offsets[0]).toBe(0);
      expect([complex.saddles, complex.extrema, complex.kinds].map((list) => list.length)).toEqual(
        new Array(3).fill(lines.length),
      );
      expect([...complex.points]).toEqual(
        [...complex.vertices].flatMap((v) => shape.positions.slice(3 * v, 3 * v + 3)),
      );

      const parts = { '-1': linkParts(shape, values, true), 1: linkParts(shape, values, false) };
      const expected = around.flatMap((_, v) =>
        Math.max(parts[-1][v], parts[1][v]) > 1 ? [-1, 1].flatMap((k) => new Array(parts[k][v]).fill(`${v} ${k}`)) : [],
      );
      expect(counted(lines.map((line, k) => `${line[0]} ${complex.kinds[k]}`))).toEqual(counted(expected));

      const firstSteps = new Set();
      lines.forEach((line, k) => {
        const down = complex.kinds[k] === -1;
        expect([line[0], line.at(-1)]).toEqual([complex.saddles[k], complex.extrema[k]]);
        expect(around[line[0]]).toContain(line[1]);
        firstSteps.add(`${line[0]} ${line[1]}`);
        for (let i = 1; i < line.length; i++) {
          expect(isBelow(values, line[i], line[i - 1])).toBe(down);
          expect(steepest(shape, around, values, line[i], down)).toBe(line[i + 1] ?? line[i]);
        }
      });
      expect(firstSteps.size).toBe(lines.length);
      // The steepest edge of all is the steepest of its part.
      for (const v of new Set(complex.saddles)) {
        for (const down of [true, false]) {
          const best = steepest(shape, around, values, v, down);
          if (best !== v) expect(firstSteps).toContain(`${v} ${best}`);
        }
      }
      const { vertices, kinds, multiplicities } = mesh.criticalPoints(values);
      const extrema = new Map([...vertices].map((v, k) => [v, kinds[k]]));
      complex.extrema.forEach((v, k) => expect(extrema.get(v)).toBe(complex.kinds[k]));
      if (!closed.includes(name)) continue;
      const perSaddle = counted(complex.saddles);
      vertices.forEach((v, k) => expect(perSaddle[v]).toBe(kinds[k] === 0 ? 2 * (multiplicities[k] + 1) : undefined));
    }
  });

  it.each(Object.keys(shapes))('merged leaves no gap, and ends lines where they meet others: %s', (name) => {
    const mesh = make(shapes[name]);
    for (const values of fields(shapes[name])) {
      for (const persistence of thresholds) {
        const whole = mesh.morseComplex(values, { persistence, paths: 'whole' });
        const merged = mesh.morseComplex(values, { persistence, paths: 'merged' });
        for (const entry of ['saddles', 'extrema', 'kinds']) expect(merged[entry]).toEqual(whole[entry]);
        const drawn = edgesOf(merged);
        expect(new Set(drawn)).toEqual(new Set(edgesOf(whole)));
        const passed = { '-1': new Set(), 1: new Set() };
        linesOf(merged).forEach((line, k) => {
          const before = passed[merged.kinds[k]];
          if (line.at(-1) !== merged.extrema[k]) expect(before).toContain(line.at(-1));
          line.forEach((v) => before.add(v));
        });
        if (persistence > 0) continue;
        // Only the first edge of a line can be there already, where one that comes from beyond goes through its saddle.
        expect(drawn.length - new Set(drawn).size).toBeLessThanOrEqual(merged.saddles.length);
      }
    }
  });

  it('merged leaves no gap where a cancelled path leads back over the saddle', () => {
    const mesh = make(square(3));
    const values = noise(square(3), 1);
    // From 5 the way to the cancelled minimum 14 leads over 10 and back: nothing of that is drawn, and the line from 11 that comes
    // to 10 goes on.
    expect(linesOf(mesh.morseComplex(values, { persistence: 0.2 }))).toContainEqual([11, 10, 5, 4, 8]);
    expect(linesOf(mesh.morseComplex(values, { persistence: 0.2, paths: 'merged' }))).toContainEqual([11, 10, 5, 4]);
  });
});

/** What a threshold leaves, looked up by the rules in the documentation. */
function lookUp({ vertices, kinds, cancelledAt, into, arcs }, threshold) {
  const isAlive = (node) => threshold === 0 || cancelledAt[node] > threshold;
  const successor = (node) => (isAlive(node) ? node : successor(into[node]));
  const alive = [...vertices.keys()].filter(isAlive);
  const left = [];
  for (let k = 0; k < arcs.length; k += 2) {
    const [saddle, extremum] = [arcs[k], successor(arcs[k + 1])];
    if (isAlive(saddle)) left.push({ saddle, text: `${vertices[saddle]} ${kinds[extremum]} ${vertices[extremum]}` });
  }
  const ofKind = (kind) => alive.filter((node) => kinds[node] === kind).map((node) => vertices[node]);
  return { minima: ofKind(-1), saddles: ofKind(0), maxima: ofKind(1), arcs: left };
}

describe('the Morse hierarchy', () => {
  it('of height on an upright torus: four nodes that stay, eight arcs', () => {
    const shape = torus();
    const hierarchy = make(shape).morseHierarchy(heights(shape));
    expect([...hierarchy.kinds]).toEqual([-1, 1, 0, 0]);
    expect(hierarchy.cancelledAt).toEqual(new Float64Array(4).fill(Infinity));
    expect(hierarchy.partners).toEqual(Uint32Array.of(0, 1, 2, 3));
    expect(hierarchy.into).toEqual(Uint32Array.of(0, 1, 2, 3));
    expect([...hierarchy.arcs]).toEqual([2, 0, 2, 0, 2, 1, 2, 1, 3, 0, 3, 0, 3, 1, 3, 1]);
  });

  it.each(closed)('has the pairs of persistence, and four arcs for each saddle: %s', (name) => {
    const mesh = make(shapes[name]);
    for (const values of fields(shapes[name])) {
      const { vertices, kinds, cancelledAt, partners, into, arcs } = mesh.morseHierarchy(values);
      const { minima, maxima, saddles } = mesh.criticalPoints(values).counts;
      const expectedKinds = [
        ...new Array(minima).fill(-1),
        ...new Array(maxima).fill(1),
        ...new Array(saddles).fill(0),
      ];
      expect([...kinds]).toEqual(expectedKinds);
      expect(arcs.length).toBe(2 * 4 * saddles);
      const pairs = [];
      kinds.forEach((kind, node) => {
        expect(partners[partners[node]]).toBe(node);
        expect(cancelledAt[partners[node]]).toBe(cancelledAt[node]);
        expect(partners[node] === node).toBe(cancelledAt[node] === Infinity);
        expect(kinds[into[node]]).toBe(kind);
        expect(into[node] === node).toBe(kind === 0 || partners[node] === node);
        expect(cancelledAt[into[node]]).toBeGreaterThanOrEqual(cancelledAt[node]);
        if (kind !== 0 && partners[node] !== node) pairs.push(`${vertices[node]} ${cancelledAt[node]}`);
      });
      const found = mesh.persistence(values);
      expect(pairs.sort()).toEqual([...found.extrema].map((v, k) => `${v} ${found.persistence[k]}`).sort());
    }
  });

  it.each(closed)('has at every threshold the critical points of the simplified field: %s', (name) => {
    const mesh = make(shapes[name]);
    for (const values of fields(shapes[name])) {
      const hierarchy = mesh.morseHierarchy(values);
      for (const threshold of thresholds) {
        const simple = threshold > 0 ? mesh.simplify(values, { threshold }).values : values;
        const { vertices, kinds, counts } = mesh.criticalPoints(simple);
        const left = lookUp(hierarchy, threshold * rangeOf(shapes[name], values));
        expect([left.minima.length, left.saddles.length, left.maxima.length]).toEqual([
          counts.minima,
          counts.saddles,
          counts.maxima,
        ]);
        const extrema = [...vertices].filter((_, k) => kinds[k] !== 0);
        expect(ascending([...left.minima, ...left.maxima])).toEqual(extrema);
      }
    }
  });

  it.each(Object.keys(shapes))('has at every threshold the arcs that the lines draw: %s', (name) => {
    const mesh = make(shapes[name]);
    for (const values of fields(shapes[name])) {
      const hierarchy = mesh.morseHierarchy(values);
      const nodesAt = counted(hierarchy.vertices.filter((_, node) => hierarchy.kinds[node] === 0));
      for (const persistence of thresholds) {
        const { saddles, extrema, kinds } = mesh.morseComplex(values, { persistence });
        const lines = [...saddles].map((saddle, k) => ({ saddle, text: `${saddle} ${kinds[k]} ${extrema[k]}` }));
        const { arcs } = lookUp(hierarchy, persistence * rangeOf(shapes[name], values));
        const texts = (list) => list.map(({ text }) => text);
        expect(new Set(texts(lines))).toEqual(new Set(texts(arcs)));
        // The simple saddles of one vertex share lines; others have theirs for themselves, as long as nothing leads back over them.
        if (persistence > 0) continue;
        const simple = lines.filter(({ saddle }) => nodesAt[saddle] === 1);
        const arcsOfSimple = arcs.filter(({ saddle }) => nodesAt[hierarchy.vertices[saddle]] === 1);
        expect(texts(simple).sort()).toEqual(texts(arcsOfSimple).sort());
      }
    }
  });
});

describe('basins', () => {
  it.each(Object.keys(shapes))('are where the steepest paths end: %s', (name) => {
    const shape = shapes[name];
    const around = neighbours(shape);
    const follow = (values, v, down) => {
      const next = steepest(shape, around, values, v, down);
      return next === v ? v : follow(values, next, down);
    };
    for (const values of untied(shape)) {
      const { descending, ascending: upwards } = make(shape).basins(values);
      around.forEach((others, v) => {
        const expected = others.length > 0 ? [true, false].map((down) => follow(values, v, down)) : [NOWHERE, NOWHERE];
        expect([descending[v], upwards[v]]).toEqual(expected);
      });
    }
  });

  it.each(Object.keys(shapes))('are as many as there are extrema, at every threshold: %s', (name) => {
    const shape = shapes[name];
    const mesh = make(shape);
    const isolated = neighbours(shape).flatMap((others, v) => (others.length > 0 ? [] : [v]));
    for (const values of fields(shape)) {
      const found = mesh.persistence(values);
      for (const persistence of thresholds) {
        const labels = mesh.basins(values, { persistence });
        const isLeft = (k) => persistence === 0 || found.persistence[k] > persistence * rangeOf(shape, values);
        for (const [kind, list, essential] of [
          [-1, labels.descending, found.essentialMinima],
          [1, labels.ascending, found.essentialMaxima],
        ]) {
          const left = [...found.extrema].filter((_, k) => found.kinds[k] === kind && isLeft(k));
          const expected = [...left, ...essential, ...(isolated.length > 0 ? [NOWHERE] : [])];
          expect(ascending(new Set(list))).toEqual(ascending(expected));
          for (const extremum of [...left, ...essential]) expect(list[extremum]).toBe(extremum);
          for (const v of isolated) expect(list[v]).toBe(NOWHERE);
        }
      }
    }
  });
});

describe('values, options and results', () => {
  const methods = {
    morseComplex: (mesh, values, options) => mesh.morseComplex(values, options),
    morseHierarchy: (mesh, values) => mesh.morseHierarchy(values),
    basins: (mesh, values, options) => mesh.basins(values, options),
  };
  const optional = ['morseComplex', 'basins'];

  takeAnyValues(methods);

  it.each(optional)('%s refuses other options, after which the same mesh works on', (name) => {
    const mesh = make(shapes.torus);
    const values = noise(shapes.torus, 25);
    const call = (options) => () => methods[name](mesh, values, options);
    const expected = call()();
    for (const persistence of [-0.1, NaN, Infinity, '0.1', [0.1], 1n, true]) {
      expectError(call({ persistence }), 'InvalidOption', { option: 'persistence' });
    }
    expectError(call({ persistance: 0.1 }), 'UnknownOption', { option: 'persistance' });
    expectError(call({ threshold: 0.1 }), 'UnknownOption', { option: 'threshold' });
    class Options {
      persistence = 0.1;
    }
    for (const options of [new Map([['persistence', 0.1]]), new Options(), [0.1], 0.1, 'whole', null]) {
      expectError(call(options), 'InvalidArgument', { argument: 'options' });
    }
    for (const options of [{}, { persistence: undefined }, { persistence: 0 }, Object.create(null)]) {
      expect(call(options)()).toEqual(expected);
    }
    expect(call({ persistence: 0.5 })()).not.toEqual(expected);
  });

  it('only lines have paths, of two kinds', () => {
    const mesh = make(tetrahedron());
    for (const paths of ['Whole', '', 'all', 1, true, ['merged']]) {
      expectError(() => mesh.morseComplex([1, 2, 3, 4], { paths }), 'InvalidOption', { option: 'paths' });
    }
    expectError(() => mesh.basins([1, 2, 3, 4], { paths: 'whole' }), 'UnknownOption', { option: 'paths' });
    expect(mesh.morseComplex([1, 2, 3, 4], { paths: 'merged' }).offsets).toEqual(Uint32Array.of(0));
  });
});
