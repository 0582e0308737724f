// Fields with exactly the chosen extrema: what they are, against classifications and energies that are found otherwise.
import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectExact, kindsOf, noise, scaled } from './exact.js';
import { apply, dense, dot, heights, islands, pinched, sphere, square, torus } from './meshes.js';
import { same } from './same.js';
import { neighbours } from './truths.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const shape = torus(30, 16);
const f = noise(shape, heights(shape), 0.8);
const range = Math.max(...f) - Math.min(...f);
const epsilon = 0.02;
/** Some of the noise's extrema, too. */
const input = { from: 'persistence', minima: 5, maxima: 4, of: 'input' };

/** The chosen extrema by the pairs of a field above a threshold in its units. */
function persistent(mesh, values, threshold) {
  const { extrema, kinds, persistence, essentialMinima, essentialMaxima } = mesh.persistence(values);
  const of = (kind, essential) =>
    [...extrema.filter((_, k) => kinds[k] === kind && persistence[k] > threshold), ...essential].sort((a, b) => a - b);
  return { minima: of(-1, essentialMinima), maxima: of(1, essentialMaxima) };
}

const listsOf = ({ minima, maxima }) => ({ minima: [...minima], maxima: [...maxima] });

describe('the extrema of the result', () => {
  it('are those that persistence chooses, of the smoothed field or of the input', () => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh);
    const smoothed = smoother.tikhonov(f, { epsilon }).values;
    for (const threshold of [0.01, 0.05, 0.2]) {
      const result = smoother.prescribe(f, { epsilon, extrema: { from: 'persistence', threshold } });
      expectExact(shape, result, persistent(mesh, smoothed, threshold * range));
    }
    for (const threshold of [0.05, 0.08, 0.3]) {
      const extrema = { from: 'persistence', threshold, of: 'input' };
      const wanted = persistent(mesh, f, threshold * range);
      const result = smoother.prescribe(f, { epsilon, extrema });
      expectExact(shape, result, wanted);
      const absolute = { ...extrema, threshold: threshold * range, thresholdIs: 'absolute' };
      expect(same(smoother.prescribe(f, { epsilon, extrema: absolute }).values, result.values)).toBe(true);
    }
    // The default.
    const expected = persistent(mesh, smoothed, 0.05 * range);
    expect(listsOf(smoother.prescribe(f, { epsilon }))).toEqual(expected);
  });

  it('are so many of the most persistent ones', () => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh);
    const { extrema, kinds, persistence, essentialMinima, essentialMaxima } = mesh.persistence(f);
    for (const [minima, maxima] of [
      [1, 1],
      [3, 2],
      [1, 7],
      [10, 10],
    ]) {
      const most = (kind, essential, count) => {
        const pairs = [...extrema].map((v, k) => ({ v, kind: kinds[k], persistence: persistence[k] }));
        const sorted = pairs.filter((pair) => pair.kind === kind).sort((a, b) => b.persistence - a.persistence);
        return [...essential, ...sorted.map(({ v }) => v)].slice(0, count).sort((a, b) => a - b);
      };
      const wanted = { minima: most(-1, essentialMinima, minima), maxima: most(1, essentialMaxima, maxima) };
      const options = { epsilon, extrema: { from: 'persistence', minima, maxima, of: 'input' } };
      expectExact(shape, smoother.prescribe(f, options), wanted);
    }
    const smoothed = kindsOf(shape, smoother.tikhonov(f, { epsilon: 1000 }).values);
    for (const [minima, maxima] of [
      [2, 3],
      [smoothed.minima.length, 3],
    ]) {
      const result = smoother.prescribe(f, { epsilon: 1000, extrema: { from: 'persistence', minima, maxima } });
      expect([result.minima.length, result.maxima.length]).toEqual([minima, maxima]);
      expect(smoothed.minima).toEqual(expect.arrayContaining([...result.minima]));
      expect(smoothed.maxima).toEqual(expect.arrayContaining([...result.maxima]));
    }
  });

  it('are vertices, of their kind in the field or whatever they are in it', () => {
    const smoother = new Smoother(make(shape));
    const kinds = kindsOf(shape, f);
    const wanted = { minima: kinds.minima.slice(0, 3), maxima: kinds.maxima.slice(-4) };
    const ids = [...wanted.maxima, ...wanted.minima, wanted.minima[0]];
    const told = smoother.prescribe(f, { epsilon, extrema: ids });
    expectExact(shape, told, wanted);
    for (const Array of [Uint32Array, Uint16Array, Int32Array]) {
      const extrema = { minima: Array.from(wanted.minima), maxima: Array.from(wanted.maxima) };
      expect(same(smoother.prescribe(f, { epsilon, extrema }), told)).toBe(true);
    }
    // The other way round: where the field has maxima there shall be minima.
    const turned = { minima: wanted.maxima, maxima: wanted.minima };
    expectExact(shape, smoother.prescribe(f, { epsilon, extrema: turned }), turned);
    // All that there are.
    expectExact(shape, smoother.prescribe(f, { epsilon, extrema: kinds }), kinds);
  });

  it.each([
    ['a sphere', sphere(3)],
    ['a square', square(15)],
    ['two tetrahedra with a vertex in common', pinched()],
    ['one triangle', { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: [0, 1, 2] }],
  ])('are the chosen ones on %s, whatever the metric and the weights', (name, shape) => {
    const mesh = make(shape);
    const values = noise(shape, heights(shape), 2);
    const chosen = persistent(mesh, values, 0.3 * (Math.max(...values) - Math.min(...values)));
    const { unavoidable } = mesh.simplify(values, { keep: [...chosen.minima, ...chosen.maxima] });
    const extrema = { from: 'persistence', threshold: 0.3, of: 'input' };
    for (const [settings, options] of [
      [{}, {}],
      [{}, { metric: 'identity' }],
      [{}, { metric: 'lumped', massScale: 'raw' }],
      [{ weights: 'uniform' }, {}],
      [{ weights: 'meanValue' }, {}],
      [{ weights: 'intrinsicDelaunay' }, {}],
      [{ operator: 'fem' }, {}],
    ]) {
      const smoother = new Smoother(mesh, settings);
      const result = smoother.prescribe(values, { epsilon: 0.1, ...options, extrema });
      // Beside the chosen ones those that no field on the mesh can do without.
      expect([...result.unavoidable]).toEqual([...unavoidable]);
      const all = [...chosen.minima, ...chosen.maxima, ...unavoidable].sort((a, b) => a - b);
      expect([...result.minima, ...result.maxima].sort((a, b) => a - b)).toEqual(all);
      expectExact(shape, result, listsOf(result), { isSurface: name !== 'two tetrahedra with a vertex in common' });
    }
  });

  it('are completed where a component has none', () => {
    const shape = islands();
    const smoother = new Smoother(make(shape));
    const values = [3, 1, 4, 2, 7, 7, 5, 9, 2, 6, 8, 1];
    const result = smoother.prescribe(values, { epsilon: 1, extrema: [1, 2], complete: true });
    // Those of the smoothed field.
    const smoothed = smoother.tikhonov(values, { epsilon: 1 }).values;
    const second = [6, 7, 8, 9, 10, 11].sort((a, b) => smoothed[a] - smoothed[b]);
    expectExact(shape, result, { minima: [1, second[0]], maxima: [2, second.at(-1)] });
    // What belongs to no triangle stays as it is.
    expect([...result.values.slice(4, 6)]).toEqual([7, 7]);
  });

  it('are the same far from 0 and in any unit', () => {
    const mesh = make(shape);
    const options = { epsilon, extrema: input };
    const { minima, maxima, margin } = new Smoother(mesh).prescribe(f, options);
    expect(margin).toBe(1e-6);
    for (const [factor, offset] of [
      [1e-9, 0],
      [1e12, 0],
      [-1, 3],
      [1, 1e9],
      [1e-9, 1e3],
    ]) {
      const moved = f.map((value) => factor * value + offset);
      // Where rounding has changed their order, the chosen ones are these all the same.
      const chosen = factor < 0 ? { minima: maxima, maxima: minima } : { minima, maxima };
      const result = new Smoother(mesh).prescribe(moved, { epsilon, extrema: chosen });
      expect(kindsOf(shape, result.values)).toEqual(listsOf(chosen));
      // Steps are no smaller than the doubles there can tell.
      expect(result.margin).toBeGreaterThanOrEqual(1e-6);
      expect(result.leastSlack).toBeGreaterThanOrEqual(0.9);
    }
  });
});

describe('energies', () => {
  /** ‖Lx‖² + ε(x − f)ᵀB(x − f) of fields scaled by the range of f, with the matrices as rows. */
  function energyOf(mesh, settings, metric, epsilon, x, massScale) {
    const laplacian = dense(mesh.laplacian(settings));
    const kind = metric === 'mass' ? 'galerkin' : 'lumped';
    const mass = metric === 'identity' ? null : dense(mesh.mass({ kind, massScale }));
    const lx = apply(laplacian, scaled(x, f));
    const difference = scaled(x, f).map((value, i) => value - scaled(f, f)[i]);
    return dot(lx, lx) + epsilon * dot(difference, mass ? apply(mass, difference) : difference);
  }

  it.each([
    [{}, 'mass', undefined],
    [{}, 'identity', undefined],
    [{}, 'lumped', 'raw'],
    [{ weights: 'uniform' }, 'mass', 'meanOne'],
  ])('are what the matrices say: %o, metric %s, %s', (settings, metric, massScale) => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh, settings);
    const options = { epsilon, metric, ...(massScale && { massScale }) };
    const { energy, unconstrainedEnergy, values, gap, leastSlack } = smoother.prescribe(f, {
      ...options,
      extrema: input,
    });
    const least = smoother.tikhonov(f, options).values;
    const measured = [values, least].map((x) => energyOf(mesh, settings, metric, epsilon, x, massScale));
    expect(energy / measured[0]).toBeCloseTo(1, 9);
    expect(unconstrainedEnergy / measured[1]).toBeCloseTo(1, 9);
    expect(energy).toBeGreaterThan(unconstrainedEnergy);
    expect(gap).toBeLessThan(1e-4);
    expect(leastSlack).toBeGreaterThanOrEqual(0.9);
  });

  it('of finite elements and least squares, too', () => {
    const mesh = make(shape);
    const fem = new Smoother(mesh, { operator: 'fem' });
    const result = fem.prescribe(f, { epsilon: 3, extrema: input });
    const masses = dense(mesh.mass({ kind: 'lumped', massScale: 'raw' })).map((row, i) => row[i]);
    const lx = apply(dense(mesh.laplacian()), scaled(result.values, f));
    const difference = scaled(result.values, f).map((value, i) => value - scaled(f, f)[i]);
    const smoothness = lx.reduce((sum, value, i) => sum + value ** 2 / masses[i], 0);
    const closeness = difference.reduce((sum, value, i) => sum + masses[i] * value ** 2, 0);
    expect(result.energy / (smoothness + 3 * closeness)).toBeCloseTo(1, 9);
    const chosen = listsOf(new Smoother(mesh).prescribe(f, { epsilon, extrema: input }));
    expectExact(shape, result, chosen);
    const wavelength = 2 * Math.PI * 3 ** -0.25;
    expect(fem.prescribe(f, { cutoffWavelength: wavelength, extrema: input }).energy / result.energy).toBeCloseTo(1, 9);

    const constraints = Array.from({ length: 60 }, (_, k) => 8 * k);
    const weights = constraints.map((_, k) => 1 + (k % 3));
    const smoother = new Smoother(mesh);
    const fitted = smoother.prescribe(f, { epsilon: 0.5, constraints, weights, extrema: input });
    const image = apply(dense(mesh.laplacian()), scaled(fitted.values, f));
    const misfit = constraints.map((v) => scaled(fitted.values, f)[v] - scaled(f, f)[v]);
    const energy = dot(image, image) + 0.5 * misfit.reduce((sum, value, k) => sum + weights[k] * value ** 2, 0);
    expect(fitted.energy / energy).toBeCloseTo(1, 9);
    expectExact(shape, fitted, chosen);
    expect(fitted.report.equation).toBe('(7)');
  });

  it('fall the more is done: preview, whole, again, of three representatives', () => {
    const smoother = new Smoother(make(shape));
    const options = { epsilon, extrema: input };
    const preview = smoother.prescribe(f, { ...options, preview: true });
    const whole = smoother.prescribe(f, options);
    const again = smoother.prescribe(f, { ...options, again: true });
    const three = smoother.prescribe(f, { ...options, representatives: 3 });
    expect(whole.energy).toBeLessThan(preview.energy);
    for (const better of [again, three]) expect(better.energy).toBeLessThanOrEqual(whole.energy);
    const lists = listsOf(whole);
    for (const result of [preview, again, three]) expectExact(shape, result, lists);
    for (const { unconstrainedEnergy } of [preview, again, three])
      expect(unconstrainedEnergy / whole.unconstrainedEnergy).toBeCloseTo(1, 9);
    expect(preview).toMatchObject({ route: 'preview', iterations: 0, solves: 0 });
    expect(preview.gap).toBeCloseTo(1 - preview.unconstrainedEnergy / preview.energy, 12);
    expect(whole.iterations).toBeGreaterThan(1);
    expect(whole.solves).toBeGreaterThan(whole.iterations);
  });

  it('are those of smoothing where nothing needs to change', () => {
    const smoother = new Smoother(make(shape));
    const { values } = smoother.tikhonov(f, { epsilon });
    const { minima, maxima } = kindsOf(shape, values);
    const result = smoother.prescribe(f, { epsilon, extrema: { minima, maxima } });
    expect(result.energy / result.unconstrainedEnergy).toBeLessThan(1 + 1e-4);
    const worst = Math.max(...values.map((value, i) => Math.abs(value - result.values[i])));
    expect(worst / range).toBeLessThan(1e-2);
  });
});

describe('what can be asked for', () => {
  it('values are kept to the last bit', () => {
    const smoother = new Smoother(make(shape));
    const { minima, maxima, ...result } = smoother.prescribe(f, { epsilon, extrema: input, values: 'keep' });
    const lists = listsOf({ minima, maxima });
    expectExact(shape, { minima, maxima, ...result }, lists);
    for (const v of [...minima, ...maxima]) expect(result.values[v]).toBe(f[v]);
    const free = smoother.prescribe(f, { epsilon, extrema: input });
    expect(free.energy).toBeLessThan(result.energy);
    expect([...minima].some((v) => free.values[v] !== f[v])).toBe(true);
  });

  it('prominence is the least persistence of the chosen extrema', () => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh);
    const options = { epsilon, extrema: { from: 'persistence', minima: 5, maxima: 5, of: 'input' } };
    const least = ({ values }) => Math.min(...mesh.persistence(values).persistence) / range;
    const free = smoother.prescribe(f, options);
    expect(least(free)).toBeLessThan(0.05);
    for (const prominence of [0.05, 0.1, 0.2]) {
      const result = smoother.prescribe(f, { ...options, prominence });
      expectExact(shape, result, listsOf(free));
      expect(least(result)).toBeGreaterThan(prominence - 1e-6);
      expect(result.energy).toBeGreaterThan(free.energy);
    }
  });

  it('the range of the input is not left', () => {
    const smoother = new Smoother(make(shape));
    // A plateau whose rim smoothing overshoots.
    const steep = heights(shape).map((height) => Math.max(-1, Math.min(1, 20 * height)));
    const options = { epsilon, extrema: { from: 'persistence', minima: 1, maxima: 1 } };
    const extent = ({ values }) => [Math.min(...values), Math.max(...values)];
    const free = smoother.prescribe(steep, options);
    expect(extent(free)[1]).toBeGreaterThan(1);
    const inside = smoother.prescribe(steep, { ...options, range: 'input' });
    expectExact(shape, inside, listsOf(free));
    expect(extent(inside)[0]).toBeGreaterThanOrEqual(-1);
    expect(extent(inside)[1]).toBeLessThanOrEqual(1);
    expect(inside.energy).toBeGreaterThan(free.energy);
  });

  it('margins are kept', () => {
    const smoother = new Smoother(make(shape));
    for (const margin of [1e-5, 1e-4]) {
      const result = smoother.prescribe(f, { epsilon, extrema: input, margin });
      expect(result.margin).toBe(margin);
      expectExact(shape, result, listsOf(result));
      // Every extremum is beyond its ring by that much.
      const around = neighbours(shape);
      for (const [list, sign] of [
        [result.minima, 1],
        [result.maxima, -1],
      ]) {
        for (const v of list)
          for (const j of around[v])
            expect((sign * (result.values[j] - result.values[v])) / range).toBeGreaterThan(0.89 * margin);
      }
    }
  });

  it('missing values are left out, as on the part of the mesh that has some', () => {
    const mesh = make(shape);
    const values = f.slice();
    for (const v of [40, 41, 200]) values[v] = NaN;
    for (const extrema of [input, { from: 'persistence', threshold: 0.01 }]) {
      const options = { epsilon, extrema, missing: 'omit' };
      const result = new Smoother(mesh).prescribe(values, options);
      const part = mesh.withoutMissing(values);
      const known = Float64Array.from(part.vertices, (v) => values[v]);
      const expected = new Smoother(part.mesh).prescribe(known, { epsilon, extrema });
      expect(
        same(
          Float64Array.from(part.vertices, (v) => result.values[v]),
          expected.values,
        ),
      ).toBe(true);
      for (const v of [40, 41, 200]) expect(result.values[v]).toBeNaN();
      for (const list of ['minima', 'maxima', 'unavoidable'])
        expect([...result[list]]).toEqual([...expected[list]].map((v) => part.vertices[v]));
      // By number they are those of the whole mesh.
      const { minima, maxima } = result;
      const named = new Smoother(mesh).prescribe(values, { ...options, extrema: { minima, maxima } });
      expect(same(named.values, result.values)).toBe(true);
    }
  });

  it('a rule chooses ε', () => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh);
    for (const rule of ['auto', { rule: 'lCurve' }, { rule: 'atMostCriticalPoints', count: 40 }]) {
      const { values, report } = smoother.prescribe(f, { epsilon: rule, extrema: input });
      const { choice } = smoother.tikhonov(f, { epsilon: rule }).report;
      expect(report.choice).toEqual(choice);
      expect(report.epsilon).toBe(choice.epsilon);
      expect(same(smoother.prescribe(f, { epsilon: choice.epsilon, extrema: input }).values, values)).toBe(true);
    }
    const constraints = Array.from({ length: 60 }, (_, k) => 8 * k);
    const fitted = smoother.prescribe(f, { epsilon: 'auto', constraints, extrema: input });
    expect(fitted.report.choice).toEqual(smoother.leastSquares(f, { epsilon: 'auto', constraints }).report.choice);
  });

  it('the short way is the same', () => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh, { weights: 'uniform' });
    const more = { epsilon, extrema: input, range: 'input' };
    const short = smooth(mesh, f, { method: 'prescribe', weights: 'uniform', ...more });
    expect(same(short, smoother.prescribe(f, more))).toBe(true);
    const { report } = smooth(mesh, f, { method: 'prescribe' });
    expect(report.choice.rule).toBe('gcv');
    const constraints = { from: 'persistence', threshold: 0.2 };
    const fitted = smooth(mesh, f, { method: 'prescribe', epsilon, constraints });
    expect(same(fitted, new Smoother(mesh).prescribe(f, { epsilon, constraints }))).toBe(true);
  });
});

it('reports as other methods do', () => {
  const mesh = make(shape);
  const result = new Smoother(mesh).prescribe(f, { epsilon, extrema: input });
  const smoothed = new Smoother(mesh).tikhonov(f, { epsilon });
  expect(Object.keys(result).sort()).toEqual(
    ['values', 'report', 'reports', 'minima', 'maxima', 'unavoidable', 'energy', 'unconstrainedEnergy', 'leastSlack', 'margin', 'gap', 'iterations', 'solves', 'route'].sort(), // prettier-ignore
  );
  expect(result.route).toMatch(/^(interiorPoint|dual)$/);
  expect(Object.keys(result.report)).toEqual(Object.keys(smoothed.report));
  expect(result.reports).toEqual([result.report]);
  const { report, values, minima, maxima } = result;
  expect(report).toMatchObject({ method: 'prescribe', equation: '(5)', epsilon, choice: null });
  expect(report.before).toEqual(smoothed.report.before);
  const after = mesh.criticalPoints(values).counts;
  expect(report.after).toEqual(after);
  expect([after.minima, after.maxima, after.saddles]).toEqual([
    minima.length,
    maxima.length,
    minima.length + maxima.length,
  ]);
  const image = apply(dense(mesh.laplacian()), scaled(values, f));
  expect(report.laplacianNorm / Math.sqrt(dot(image, image))).toBeCloseTo(1, 9);
  const closeness = (result.energy - report.laplacianNorm ** 2) / epsilon;
  expect(report.metricNorm ** 2 / closeness).toBeCloseTo(1, 8);
});
