import init, { TriMesh } from 'morse-smooth';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { apply, dense, dot, octahedron, random, square, sum, tetrahedron, torus } from './meshes.js';

beforeAll(() => init());

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const near = (matrix) => matrix.map((row) => row.map((entry) => expect.closeTo(entry, 12)));

describe('Laplacian', () => {
  it('of the tetrahedron: all angles are 60°, so w = cot 60°', () => {
    const w = 1 / Math.sqrt(3);
    const row = (i) => [0, 1, 2, 3].map((j) => (i === j ? 3 * w : -w));
    expect(dense(make(tetrahedron()).laplacian())).toEqual(near([0, 1, 2, 3].map(row)));
  });

  it('of a square: the five point stencil, whose diagonals weigh nothing', () => {
    const matrix = dense(make(square(4)).laplacian());
    const middle = 12;
    const expected = matrix.map((_, j) => (j === middle ? 4 : [7, 11, 13, 17].includes(j) ? -1 : 0));
    expect(matrix[middle]).toEqual(near([expected])[0]);
  });

  it.each(['cotangent', 'uniform', 'meanValue', 'normalizedCotangent', 'intrinsicDelaunay'])(
    'with %s weights has rows that sum to 0',
    (weights) => {
      const mesh = make(torus(9, 7));
      const matrix = dense(mesh.laplacian({ weights }));
      for (const row of matrix) expect(sum(row)).toBeCloseTo(0, 10);
      const symmetric = matrix.every((row, i) => row.every((entry, j) => Math.abs(entry - matrix[j][i]) < 1e-12));
      expect(symmetric).toBe(!['meanValue', 'normalizedCotangent'].includes(weights));
      if (weights === 'uniform') expect(matrix[0][0]).toBe(6);
      if (weights === 'normalizedCotangent') expect(matrix[0][0]).toBeCloseTo(1, 12);
    },
  );

  it('of the intrinsic Delaunay triangulation: a rhombus is cut along its shorter diagonal', () => {
    const positions = [-2, 0, 0, 0, -1, 0, 2, 0, 0, 0, 1, 0];
    const mesh = new TriMesh(positions, [0, 1, 2, 0, 2, 3]);
    const matrix = dense(mesh.laplacian({ weights: 'intrinsicDelaunay' }));
    // The angles opposite to the diagonal have the tangent 4/3, those opposite to the sides 2.
    const [side, diagonal] = [-0.25, -0.75];
    const expected = [
      [0.5, side, 0, side],
      [side, 1.25, side, diagonal],
      [0, side, 0.5, side],
      [side, diagonal, side, 1.25],
    ];
    expect(matrix).toEqual(near(expected));
  });

  it('is a matrix by columns, with ascending rows', () => {
    const { rows, columns, columnPointers, rowIndices, values } = make(octahedron()).laplacian();
    expect([rows, columns, columnPointers.length, columnPointers[6]]).toEqual([6, 6, 7, values.length]);
    expect(rowIndices.length).toBe(values.length);
    for (let j = 0; j < 6; j++) {
      const column = [...rowIndices.subarray(columnPointers[j], columnPointers[j + 1])];
      expect(column).toEqual([...new Set(column)].sort((a, b) => a - b));
    }
    expect(columnPointers).toBeInstanceOf(Uint32Array);
    expect(values).toBeInstanceOf(Float64Array);
  });
});

describe('mass', () => {
  it('of the tetrahedron: area/6 on the diagonal of each triangle, area/12 beside it', () => {
    const area = 2 * Math.sqrt(3);
    const row = (i) => [0, 1, 2, 3].map((j) => (i === j ? (3 * area) / 6 : (2 * area) / 12));
    expect(dense(make(tetrahedron()).mass({ massScale: 'raw' }))).toEqual(near([0, 1, 2, 3].map(row)));
  });

  it.each(['galerkin', 'lumped'])('%s: entries sum to the area, or to n', (kind) => {
    for (const shape of [octahedron(), torus(9, 7), square(3)]) {
      const mesh = make(shape);
      expect(sum(mesh.mass({ kind, massScale: 'raw' }).values) / mesh.area).toBeCloseTo(1, 12);
      expect(sum(mesh.mass({ kind }).values) / mesh.vertexCount).toBeCloseTo(1, 12);
    }
  });

  it('lumped is the diagonal of row sums', () => {
    const mesh = make(square(3));
    const sums = dense(mesh.mass()).map(sum);
    const diagonal = sums.map((_, i) => sums.map((entry, j) => (i === j ? entry : 0)));
    expect(dense(mesh.mass({ kind: 'lumped' }))).toEqual(near(diagonal));
  });
});

describe('smoothness', () => {
  it('is fᵀLf and ‖Lf‖ of the values as they are', () => {
    const mesh = make(torus(9, 7));
    const values = Array.from({ length: 63 }, random(3));
    for (const weights of ['cotangent', 'uniform', 'meanValue']) {
      const matrix = dense(mesh.laplacian({ weights }));
      const image = apply(matrix, values);
      const { sobolev, laplacianNorm } = mesh.smoothness(values, { weights });
      expect(sobolev).toBeCloseTo(dot(values, image), 10);
      expect(laplacianNorm).toBeCloseTo(Math.sqrt(dot(image, image)), 10);
    }
  });

  it('of a constant is 0, and of x on a square its Dirichlet energy: the area', () => {
    const shape = square(6);
    const mesh = make(shape);
    const x = shape.positions.filter((_, k) => k % 3 === 0);
    expect(mesh.smoothness(x).sobolev).toBeCloseTo(36, 10);
    expect(mesh.smoothness(new Float64Array(49).fill(3))).toEqual({ sobolev: 0, laplacianNorm: 0 });
  });
});

describe('refused', () => {
  it('options', () => {
    const mesh = make(tetrahedron());
    expectError(() => mesh.laplacian({ weight: 'uniform' }), 'UnknownOption', { option: 'weight' });
    expectError(() => mesh.laplacian({ weights: 'cotan' }), 'InvalidOption', { option: 'weights' });
    expectError(() => mesh.laplacian(null), 'InvalidArgument', { argument: 'options' });
    expectError(() => mesh.mass({ kind: 'diagonal' }), 'InvalidOption', { option: 'kind' });
    expectError(() => mesh.mass({ massScale: 1 }), 'InvalidOption', { option: 'massScale' });
    expectError(() => mesh.mass({ scale: 'raw' }), 'UnknownOption', { option: 'scale' });
    expectError(() => mesh.smoothness([1, 2, 3, 4], { kind: 'raw' }), 'UnknownOption', { option: 'kind' });
    expect(mesh.laplacian().rows).toBe(4);
  });

  it('a mesh without area, where area is needed', () => {
    const flat = new TriMesh([0, 0, 0, 1, 0, 0, 2, 0, 0], [0, 1, 2]);
    expect(flat.area).toBe(0);
    expect(flat.criticalPoints([1, 2, 3]).counts.indexSum).toBe(1);
    expectError(() => flat.mass(), 'ZeroArea');
  });
});
