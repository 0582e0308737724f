// Vertices that lie together.
import init, { TriMesh } from 'morse-smooth';
import initFiles, { readMesh } from 'morse-smooth/files';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { random, sphere, text } from './meshes.js';

beforeAll(() => Promise.all([init(), initFiles()]));

/** A sphere by longitude and latitude, as three.js makes it: with a seam, and poles that are many vertices. */
function globe(around, down) {
  const positions = [];
  const triangles = [];
  for (let j = 0; j <= down; j++) {
    for (let i = 0; i <= around; i++) {
      const [u, v] = [(2 * Math.PI * i) / around, (Math.PI * j) / down];
      positions.push(-Math.cos(u) * Math.sin(v), Math.cos(v), Math.sin(u) * Math.sin(v));
    }
  }
  for (let j = 0; j < down; j++) {
    for (let i = 0; i < around; i++) {
      const a = i + (around + 1) * j;
      const b = a + around + 1;
      if (j !== 0) triangles.push(a + 1, a, b + 1);
      if (j !== down - 1) triangles.push(a, b, b + 1);
    }
  }
  return { positions, triangles };
}

describe('welding', () => {
  it('within a tolerance closes a sphere with a seam and poles', () => {
    const { positions, triangles } = globe(32, 16);
    const open = new TriMesh(positions, triangles);
    expect(open.topology).toMatchObject({ closed: false, eulerCharacteristic: 1 + open.topology.isolatedVertices });
    expect(open.vertexMap()).toBeNull();
    const mesh = new TriMesh(positions, triangles, { weld: { tolerance: 1e-9 } });
    expect(mesh.topology).toMatchObject({ closed: true, eulerCharacteristic: 2, genus: 0 });
    expect(mesh.vertexCount).toBe(32 * 15 + 2);
    const map = mesh.vertexMap();
    expect(map.length).toBe(positions.length / 3);
    const places = mesh.positions();
    map.forEach((v, k) => {
      for (let axis = 0; axis < 3; axis++) expect(places[3 * v + axis]).toBeCloseTo(positions[3 * k + axis], 8);
    });
    // A field given for each vertex as it was becomes one of the mesh.
    const given = Float64Array.from({ length: map.length }, (_, k) => positions[3 * k + 1]);
    const values = new Float64Array(mesh.vertexCount);
    map.forEach((v, k) => (values[v] = given[k]));
    expect(mesh.criticalPoints(values).counts).toMatchObject({ minima: 1, maxima: 1, saddles: 0, indexSum: 2 });
  });

  it('of a soup makes the mesh that it came from', () => {
    const shape = sphere(2);
    const soup = shape.triangles.flatMap((v) => shape.positions.slice(3 * v, 3 * v + 3));
    const apart = new TriMesh(soup, null);
    expect([apart.vertexCount, apart.triangleCount]).toEqual([soup.length / 3, shape.triangles.length / 3]);
    const mesh = new TriMesh(soup, null, { weld: true });
    expect([mesh.vertexCount, mesh.edgeCount, mesh.triangleCount]).toEqual([66, 192, 128]);
    expect(mesh.topology).toMatchObject({ closed: true, genus: 0 });
    const chance = random(2);
    const shaken = soup.map((x) => x + 1e-10 * (chance() - 0.5));
    expect(new TriMesh(shaken, null, { weld: true }).vertexCount).toBeGreaterThan(66);
    expect(new TriMesh(shaken, null, { weld: { tolerance: 1e-8 } }).vertexCount).toBe(66);
  });

  it('is the same whatever kind of integers the triangles are', () => {
    const { positions, triangles } = sphere(1);
    const expected = new TriMesh(positions, triangles).triangles();
    for (const Integers of [Int8Array, Uint8Array, Uint8ClampedArray, Int16Array, Uint16Array, Int32Array, Uint32Array])
      expect(new TriMesh(positions, Integers.from(triangles)).triangles()).toEqual(expected);
    const bad = Int32Array.from(triangles).fill(-2, 4, 5);
    expectError(() => new TriMesh(positions, bad), 'IndexOutOfBounds', { triangle: 1, index: -2, vertices: 18 });
  });

  it('joins nothing where nothing lies together', () => {
    const { positions, triangles } = sphere(1);
    for (const weld of [true, false, {}, { tolerance: 0 }, { tolerance: 1e-9 }, undefined, null]) {
      const mesh = new TriMesh(positions, triangles, { weld });
      expect(mesh.vertexMap()).toBeNull();
      expect(mesh.vertexCount).toBe(18);
    }
  });

  it('refuses other options', () => {
    const { positions, triangles } = sphere(1);
    const make = (weld) => () => new TriMesh(positions, triangles, { weld });
    for (const bad of ['yes', 1, 0]) expectError(make(bad), 'InvalidOption', { option: 'weld' });
    for (const tolerance of [-1, 1, NaN, Infinity, '0.1'])
      expectError(make({ tolerance }), 'InvalidOption', { option: 'weld.tolerance' });
    expectError(make({ tolerence: 0.1 }), 'UnknownOption', { option: 'weld.tolerence' });
  });

  it('of a file takes fields along', () => {
    const file = text(`ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property double heat
element face 1
property list uchar int vertex_indices
end_header
0 0 0 1
1 0 0 2
0 1 0 3
0 1 1e-9 5
3 0 1 2
`);
    const { vertexMap, positions, triangles, fields, warnings } = readMesh(file, { weld: { tolerance: 1e-6 } });
    expect([...fields.heat]).toEqual([1, 2, 4]);
    // The first one of those that became it.
    expect([...vertexMap]).toEqual([0, 1, 2]);
    const mesh = new TriMesh(positions, triangles);
    expect([mesh.vertexCount, mesh.vertexMap()]).toEqual([3, null]);
    mesh.free();
    expect(warnings.map(({ code }) => code)).toContain('WeldedValues');
  });
});
