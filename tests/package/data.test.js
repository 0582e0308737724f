// Every file and field of the reference data against numbers that an independent implementation computed from them.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { afterAll, beforeAll, describe, expect, inject, it } from 'vitest';

const beside = fileURLToPath(new URL('../../../shared/data', import.meta.url));
const folder = process.env.MORSE_SMOOTH_DATA ?? beside;
const reference = join(folder, 'expected.json');

/** Their long plateaus of equal values make counts after smoothing depend on rounding. */
const PLATEAUS = ['jacksboro_dem.ply', 'disk_flow_surface.vtk'];
const METRICS = ['identity', 'mass'];
const RELATIVE_FACTS = 1e-9;
const RELATIVE_SMOOTHED = 1e-7;
const ABSOLUTE_SMOOTHED = 1e-15;
const RELATIVE_SINGLE = 1e-9;

if (!existsSync(reference)) {
  console.warn(
    `\nThe suite of the reference data did NOT run: there is no ${reference} (MORSE_SMOOTH_DATA can name it).\n`,
  );
  it.skip(`reference data: not run, there is no ${reference}`, () => {});
}

/** With `absolute` for values near 0 of fields scaled to [0, 1]: these are rounded, too. */
function near(value, expected, relative, what, absolute = 0) {
  expect(Math.abs(value - expected), `${what}: ${value} instead of ${expected}`).toBeLessThanOrEqual(
    relative * Math.abs(expected) + absolute,
  );
}

/** Every smoothing of the reference: its name there, the method, its options, and the name of its set of constraints. */
const ALL = { from: 'criticalPoints' };
const SOME = { from: 'criticalPoints', delta: 0.02, link: 'skip' };
const SMOOTHINGS = [
  ['tikhonov identity epsilon=0.05', 'tikhonov', { epsilon: 0.05, metric: 'identity' }],
  ['tikhonov mass epsilon=0.05', 'tikhonov', { epsilon: 0.05, metric: 'mass' }],
  ['leastSquares epsilon=0.05 all critical points + stars', 'leastSquares', { epsilon: 0.05, constraints: ALL }],
  ['leastSquares epsilon=0.05 delta=0.02 skip + stars', 'leastSquares', { epsilon: 0.05, constraints: SOME }],
  ['interpolate harmonic delta=0.02 skip + stars', 'interpolate', { energy: 'harmonic', constraints: SOME }],
  ['interpolate biharmonic delta=0.02 skip + stars', 'interpolate', { energy: 'biharmonic', constraints: SOME }],
];
const sizesOf = (facts, rule) => facts.constraints[rule === ALL ? 'all critical points' : 'delta=0.02 skip'];

const counted = ({ minima, maxima, saddles }) => [minima, maxima, saddles];

function normalised(values) {
  let [min, max] = [Infinity, -Infinity];
  for (const value of values) [min, max] = [Math.min(min, value), Math.max(max, value)];
  return values.map((value) => (value - min) / (max - min));
}

describe.runIf(existsSync(reference))('reference data', () => {
  const files = existsSync(reference) ? JSON.parse(readFileSync(reference, 'utf8')) : {};
  let api;
  beforeAll(async () => {
    const entry = (name) =>
      import(pathToFileURL(join(inject('installed'), 'node_modules', 'morse-smooth', 'dist', name)).href);
    api = { ...(await entry('node.mjs')), ...(await entry('files-node.mjs')) };
  });

  describe.each(Object.entries(files))('%s', (name, expected) => {
    let mesh;
    let smoother;
    let fields;
    beforeAll(() => {
      const file = api.readMesh(readFileSync(join(folder, name)), { fileName: name });
      ({ fields } = file);
      mesh = new api.TriMesh(file.positions, file.triangles);
      smoother = new api.Smoother(mesh);
    });
    afterAll(() => {
      smoother.free();
      mesh.free();
    });

    const valuesOf = (field) => {
      const alone = join(folder, `${name.replace(/\..*$/, '')}_${field}.txt`);
      return fields[field] ?? api.readField(readFileSync(alone));
    };

    it('is the mesh that it should be', () => {
      const { vertices, triangles, edges, area, ...topology } = expected.mesh;
      expect([mesh.vertexCount, mesh.triangleCount, mesh.edgeCount]).toEqual([vertices, triangles, edges]);
      expect(mesh.topology).toMatchObject(topology);
      near(mesh.area, area, RELATIVE_FACTS, 'area');
    });

    it('comes to the same in single precision', () => {
      const single = new api.Smoother(mesh, { precision: 'single' });
      const f = normalised(valuesOf(Object.keys(expected.fields)[0]));
      for (const metric of METRICS) {
        const { values } = smoother.tikhonov(f, { epsilon: 0.05, metric });
        const { values: refined, report } = single.tikhonov(f, { epsilon: 0.05, metric });
        const error = refined.reduce((most, value, i) => Math.max(most, Math.abs(value - values[i])), 0);
        expect(error, `${metric}, ${report.solver.precision}`).toBeLessThan(RELATIVE_SINGLE);
      }
      single.free();
    });

    describe.each(Object.entries(expected.fields))('%s', (field, facts) => {
      it('has its critical points, at δ = 0 and beyond', () => {
        const values = valuesOf(field);
        const { counts } = mesh.criticalPoints(values);
        expect(counted(counts)).toEqual(facts.criticalPoints);
        expect(counts.indexSum).toBe(facts.indexSum);
        for (const [delta, links] of Object.entries(facts.delta)) {
          for (const [link, expectedCounts] of Object.entries(links)) {
            const found = mesh.criticalPoints(values, { delta: Number(delta), link });
            expect(counted(found.counts), `δ = ${delta}, ${link}`).toEqual(expectedCounts);
          }
        }
      });

      it('has its pairs of persistence, and no other extrema once it is simplified', () => {
        const values = valuesOf(field);
        const found = mesh.persistence(values);
        const curve = mesh.persistenceCurve(values);
        const [low, high] = facts.range;
        for (const [relative, expectedCounts] of Object.entries(facts.persistentPairsAbove)) {
          const threshold = Number(relative) * (high - low);
          const above = (kind) => found.kinds.filter((k, i) => k === kind && found.persistence[i] > threshold).length;
          const minima = above(-1) + found.essentialMinima.length;
          const maxima = above(1) + found.essentialMaxima.length;
          expect([minima, maxima], `pairs above ${relative}`).toEqual(expectedCounts);
          const row = curve.threshold.findLastIndex((from) => from <= threshold);
          expect([curve.minima[row], curve.maxima[row]], `curve at ${relative}`).toEqual(expectedCounts);

          const { values: simple } = mesh.simplify(values, { threshold: Number(relative) });
          const { counts } = mesh.criticalPoints(simple);
          expect([counts.minima, counts.maxima], `simplified by ${relative}`).toEqual(expectedCounts);
          const change = simple.reduce((most, value, v) => Math.max(most, Math.abs(value - values[v])), 0);
          expect(change, `simplified by ${relative}`).toBeLessThanOrEqual(threshold);
          if (expected.mesh.boundaryLoops === 0) {
            expect(counts.minima + counts.maxima - counts.saddles).toBe(expected.mesh.eulerCharacteristic);
          }
        }
      });

      it('has its energies', () => {
        const { sobolev, laplacianNorm } = mesh.smoothness(normalised(valuesOf(field)));
        near(sobolev, facts.sobolev, RELATIVE_FACTS, 'sobolev');
        near(laplacianNorm, facts.laplacianNorm, RELATIVE_FACTS, 'laplacianNorm');
      });

      it.each(SMOOTHINGS)('is smoothed: %s', (title, method, options) => {
        const wanted = facts.smoothed[title];
        const f = valuesOf(field);
        const smoothed = () => smoother[method](f, options);
        const rule = options.constraints;
        if (wanted === undefined) {
          // The reference leaves out what has no constraint at all.
          expect(sizesOf(facts, rule)).toEqual([0, 0]);
          expect(smoothed).toThrow(expect.objectContaining({ code: 'Unconstrained' }));
          return;
        }
        const { values, report } = smoothed();
        near(report.lInfinity, wanted.lInfinity, RELATIVE_SMOOTHED, 'lInfinity');
        near(report.l2, wanted.l2, RELATIVE_SMOOTHED, 'l2');
        near(report.sobolevAfter, wanted.sobolev, RELATIVE_SMOOTHED, 'sobolev');
        near(report.laplacianNorm, wanted.laplacianNorm, RELATIVE_SMOOTHED, 'laplacianNorm');
        const [low, high] = facts.range;
        facts.sampleVertices.forEach((vertex, k) => {
          const scaled = (values[vertex] - low) / (high - low);
          near(scaled, wanted.samples[k], RELATIVE_SMOOTHED, `vertex ${vertex}`, ABSOLUTE_SMOOTHED);
        });
        const after = counted(report.after);
        if (!PLATEAUS.includes(name)) {
          expect(after).toEqual(wanted.counts);
        } else if (String(after) !== String(wanted.counts)) {
          console.log(
            `${name}, ${field}, ${title}: counts ${after} where the reference has ${wanted.counts} (plateaus)`,
          );
          for (const k of [0, 1, 2]) expect(Math.abs(after[k] - wanted.counts[k])).toBeLessThanOrEqual(5);
        }
        if (rule === undefined) return;
        const [critical, withStars] = sizesOf(facts, rule);
        expect(report).toMatchObject({ constraintCount: withStars, constrainedCriticalPoints: critical });
        expect(mesh.constrainedVertices(f, rule)).toHaveLength(withStars);
        expect(mesh.constrainedVertices(f, { ...rule, stars: false })).toHaveLength(critical);
        // Between constraints with their stars, interpolation keeps every critical point.
        if (method === 'interpolate') expect(report.preserved).toBe(critical);
      });
    });
  });
});
