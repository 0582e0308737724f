import init, { Smoother, TriMesh, smooth } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { apply, component, dense, dot, heights, random, square, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const small = () => make(torus(9, 7));
const noise = (length, seed) => Float64Array.from({ length }, random(seed));

describe('with operator fem, tikhonov', () => {
  const fem = { operator: 'fem' };

  it('solves (L M⁻¹ L + εM) x = εMf', () => {
    const mesh = small();
    const f = noise(63, 13);
    const L = dense(mesh.laplacian());
    const areas = Float64Array.from(
      { length: 63 },
      (_, i) => dense(mesh.mass({ kind: 'lumped', massScale: 'raw' }))[i][i],
    );
    for (const solver of ['auto', 'cholesky', 'cg']) {
      for (const epsilon of [1e-2, 1, 1e3]) {
        const { values: x, report } = new Smoother(mesh, { ...fem, solver }).tikhonov(f, { epsilon });
        const left = apply(
          L,
          apply(L, x).map((entry, i) => entry / areas[i]),
        ).map((entry, i) => entry + epsilon * areas[i] * x[i]);
        const right = f.map((entry, i) => epsilon * areas[i] * entry);
        const error = left.map((entry, i) => entry - right[i]);
        expect(Math.sqrt(dot(error, error) / dot(right, right))).toBeLessThan(1e-10);
        expect(report).toMatchObject({ equation: 'fem', epsilon });
      }
    }
  });

  it('takes a wavelength ℓ for ε = (2π/ℓ)⁴', () => {
    const mesh = small();
    const f = noise(63, 14);
    const smoother = new Smoother(mesh, fem);
    for (const cutoffWavelength of [0.5, 2, 10]) {
      const epsilon = ((2 * Math.PI) / cutoffWavelength) ** 4;
      const by = smoother.tikhonov(f, { cutoffWavelength });
      const { values } = smoother.tikhonov(f, { epsilon });
      expect(by.report.epsilon / epsilon).toBeCloseTo(1, 14);
      by.values.forEach((value, i) => expect(value).toBeCloseTo(values[i], 12));
      expect(smooth(mesh, f, { ...fem, cutoffWavelength, method: 'tikhonov' })).toEqual(by);
    }
    const twice = smoother.tikhonov(
      Float64Array.from({ length: 126 }, (_, k) => f[k >> 1]),
      {
        cutoffWavelength: 2,
        channels: 2,
      },
    );
    expect(twice.reports.length).toBe(2);
  });

  it('halves a wave of that length, however large and fine the mesh is', () => {
    for (const [size, cells] of [
      [1e-3, 24],
      [1, 24],
      [1e4, 48],
    ]) {
      const { positions, triangles } = square(cells);
      const mesh = new TriMesh(
        positions.map((x) => (x * size) / cells),
        triangles,
      );
      // cos(2πx) and cos(4πx) fit a square of side 1 without flow over its boundary.
      for (const [waves, left] of [
        [1, 16 / 17],
        [2, 1 / 2],
      ]) {
        const wave = Float64Array.from(component(positions, 0), (x) => Math.cos((2 * Math.PI * waves * x) / cells));
        const { values } = smooth(mesh, wave, { ...fem, cutoffWavelength: size / 2 });
        values.forEach((value, i) => expect(Math.abs(value - left * wave[i])).toBeLessThan(0.04));
      }
    }
  });

  it('refuses what does not go with it, and goes on working', () => {
    const mesh = small();
    const f = noise(63, 15);
    const smoother = new Smoother(mesh, fem);
    const before = smoother.tikhonov(f, { cutoffWavelength: 2 });
    const refused = (code, option, options) => {
      expectError(() => smoother.tikhonov(f, options), code, { option });
      expectError(() => smooth(mesh, f, { ...fem, ...options }), code, { option });
    };
    for (const metric of ['mass', 'identity', 'lumped']) {
      refused('InapplicableOption', 'metric', { epsilon: 1, metric });
      refused('InapplicableOption', 'metric', { cutoffWavelength: 1, metric });
    }
    for (const massScale of ['raw', 'meanOne']) {
      refused('InapplicableOption', 'massScale', { epsilon: 1, massScale });
      refused('InapplicableOption', 'massScale', { cutoffWavelength: 1, massScale });
    }
    refused('InapplicableOption', 'epsilon', { cutoffWavelength: 1, epsilon: 1 });
    for (const cutoffWavelength of [0, -1, NaN, Infinity, 1e-100, 1e100, '1', [1], true]) {
      refused('InvalidOption', 'cutoffWavelength', { cutoffWavelength });
    }
    for (const options of [undefined, {}, { cutoffWavelength: null }]) {
      expectError(() => smoother.tikhonov(f, options), 'InvalidOption', { option: 'epsilon' });
      // There ε has a default: it is chosen.
      expect(smooth(mesh, f, { ...fem, ...options }).report.choice.rule).toBe('gcv');
    }
    refused('UnknownOption', 'cutoffwavelength', { cutoffwavelength: 1 });
    expectError(() => smoother.tikhonov([...f.slice(1), NaN], { cutoffWavelength: 2 }), 'NonFiniteValue', {
      vertex: 62,
    });
    expect(smoother.tikhonov(f, { cutoffWavelength: 2 })).toEqual(before);

    for (const weights of ['uniform', 'meanValue', 'normalizedCotangent']) {
      expectError(() => new Smoother(mesh, { ...fem, weights }), 'InapplicableOption', { option: 'weights' });
    }
    expect(new Smoother(mesh, { ...fem, weights: 'cotangent' }).tikhonov(f, { cutoffWavelength: 2 })).toEqual(before);
  });

  it('alone takes a wavelength', () => {
    const mesh = small();
    const f = noise(63, 16);
    const inapplicable = { option: 'cutoffWavelength' };
    for (const options of [{}, { operator: 'paper' }]) {
      const smoother = new Smoother(mesh, options);
      for (const more of [{}, { epsilon: 1 }, { metric: 'identity' }]) {
        expectError(() => smoother.tikhonov(f, { cutoffWavelength: 1, ...more }), 'InapplicableOption', inapplicable);
      }
      expectError(() => smooth(mesh, f, { cutoffWavelength: 1, ...options }), 'InapplicableOption', inapplicable);
      expect(smoother.tikhonov(f, { epsilon: 1 })).toEqual(smooth(mesh, f, { epsilon: 1 }));
    }
  });
});

describe('single precision', () => {
  const shape = torus(60, 30);
  const field = () => {
    const jitter = random(4);
    return heights(shape).map((z) => z + 0.2 * (jitter() - 0.5));
  };

  it.each([
    ['paper', { epsilon: 1, metric: 'identity' }],
    ['paper', { epsilon: 1e-4, metric: 'identity' }],
    ['paper', { epsilon: 0.05 }],
    ['paper', { epsilon: 10, metric: 'lumped' }],
    ['fem', { cutoffWavelength: 0.8 }],
    ['fem', { epsilon: 0.01 }],
  ])('comes to the same with operator %s, %o', (operator, options) => {
    const mesh = make(shape);
    const f = field();
    const double = new Smoother(mesh, { operator }).tikhonov(f, options);
    const single = new Smoother(mesh, { operator, precision: 'single' }).tikhonov(f, options);
    expect(double.report.solver.precision).toBe('double');
    // A real factor in single precision is seldom good enough: the complex one serves equation (5) too.
    const route = double.report.solver.route === 'cholesky' ? 'cgComplexCholesky' : 'complexCholesky';
    expect(single.report.solver).toMatchObject({ precision: 'single', route });
    expect(single.report.solver.refinementSteps).toBeGreaterThan(0);
    const range = Math.max(...f) - Math.min(...f);
    single.values.forEach((value, i) => expect(Math.abs(value - double.values[i]) / range).toBeLessThan(1e-9));
    expect(single.report.after).toEqual(double.report.after);
  });

  it('gives way to double precision where it is not enough', () => {
    const mesh = make(shape);
    const f = field();
    const smoother = new Smoother(mesh, { solver: 'cholesky', precision: 'single' });
    const hard = smoother.tikhonov(f, { epsilon: 1e-8 });
    expect(hard.report.solver.precision).toBe('doubleAfterSingle');
    expect(hard.values).toEqual(new Smoother(mesh).tikhonov(f, { epsilon: 1e-8 }).values);
    expect(smoother.tikhonov(f, { epsilon: 1 }).report.solver.precision).toBe('single');
  });
});
