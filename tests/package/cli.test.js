// Every command of the command line gives what the API gives, to the last bit.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Smoother, TriMesh } from 'morse-smooth';
import { formats, readField, readMesh, writeMesh } from 'morse-smooth/files';
import { sheet, snapshot } from 'morse-smooth/snapshot';
import { api } from '../../src/js/cli/options.js';
import { same } from '../js/same.js';
import { workplace } from './cli.js';

let place;
let mesh;
let smoother;
let fields;
beforeAll(() => {
  place = workplace();
  ({ fields } = place.torus);
  mesh = new TriMesh(place.torus.positions, place.torus.triangles);
  smoother = new Smoother(mesh);
});
afterAll(() => {
  smoother.free();
  mesh.free();
  place.remove();
});

/** What JSON makes of it. */
const plain = (value) =>
  JSON.parse(JSON.stringify(value, (_, entry) => (ArrayBuffer.isView(entry) ? Array.from(entry) : entry)));
/** Whether two fields are the same to the last bit. */
const expectSame = (one, other) => expect(same(Float64Array.from(one), Float64Array.from(other))).toBe(true);
const rowsOf = (csv) => csv.trimEnd().split('\n').map((line) => line.split(',')); // prettier-ignore

describe('info', () => {
  it('says what the mesh is', () => {
    const { topology, area } = mesh;
    const said = place.json(['info', 'torus.ply']);
    expect(said).toMatchObject({ format: 'ply', vertexCount: 4301, edgeCount: 12903, triangleCount: 8602, area });
    expect(said.topology).toEqual(topology);
    expect(said.fields.map(({ name, on, missing }) => [name, on, missing])).toEqual([
      ['clean', 'vertices', 0],
      ['noisy', 'vertices', 0],
    ]);
    expect(said.fields[1].min).toBe(fields.noisy.reduce((least, value) => Math.min(least, value)));
    const text = place.output(['info', 'torus.ply']);
    expect(text).toContain('closed, orientable, 1 component, genus 1, Euler characteristic 0\n2 fields\n');
  });

  it('reads the standard input, and what of it is missing', () => {
    const values = Float64Array.from([1, NaN, 3]);
    const triangle = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: [0, 1, 2] };
    const input = writeMesh(triangle, { format: 'ply', fields: { values }, missing: 'omit' });
    expect(place.json(['info', '-'], { input }).fields).toEqual([
      { name: 'values', on: 'vertices', min: 1, max: 3, missing: 1 },
    ]);
  });

  it('welds', () => {
    // Two triangles of a square; at two places corners of both, the last pair 0.0001 apart.
    const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1.0001, 0];
    const soup = { positions, triangles: [0, 1, 2, 3, 4, 5] };
    const input = writeMesh(soup, { format: 'ply', fields: { f: [1, 2, 3, 4, 5, 3] } });
    const loose = place.json(['info', '-'], { input });
    expect([loose.vertexCount, loose.topology.components]).toEqual([6, 2]);
    expect(place.json(['info', '-', '--weld'], { input }).vertexCount).toBe(5);
    expect(place.json(['info', '-', '--tolerance', '0.001'], { input }).vertexCount).toBe(4);
    const welded = place.output(['convert', '-', '--weld', '--to', 'csv'], { input });
    // As the files' own reader carries them.
    expect(welded).toBe(`f\n${Array.from(readMesh(input, { weld: true }).fields.f).join('\n')}\n`);
  });
});

describe('critical', () => {
  it.each([
    [[], {}],
    [['--delta', '0.05', '--link', 'skip'], { delta: 0.05, link: 'skip' }],
    [['--delta=0.1', '--delta-is', 'absolute', '--rule', 'literal'], { delta: 0.1, deltaIs: 'absolute', rule: 'literal' }], // prettier-ignore
  ])('finds the points: %s', (words, options) => {
    const found = mesh.criticalPoints(fields.noisy, options);
    const said = place.json(['critical', 'torus.ply', '--field', 'noisy', ...words]);
    expect(said.counts).toEqual(found.counts);
    expect(said.criticalPoints.map(({ vertex }) => vertex)).toEqual(Array.from(found.vertices));
    const kinds = Array.from(found.kinds, (kind) => ['minimum', 'saddle', 'maximum'][kind + 1]);
    expect(said.criticalPoints.map(({ kind }) => kind)).toEqual(kinds);
    expect(said.criticalPoints.every(({ vertex, value }) => value === fields.noisy[vertex])).toBe(true);
  });

  it('writes text and tables', () => {
    const text = place.output(['critical', 'torus.ply', '--field', 'clean']);
    expect(text.split('\n')[0]).toBe('clean: 1 minimum, 2 saddles, 1 maximum, index sum 0');
    expect(place.output(['critical', 'torus.ply', '--field', 'clean', '-o', 'critical.csv'])).toBe('');
    const { vertices } = mesh.criticalPoints(fields.clean);
    const [names, ...rows] = rowsOf(readFileSync(place.at('critical.csv'), 'utf8'));
    expect(names).toEqual(['vertex', 'kind', 'value', 'multiplicity', 'boundary']);
    expect(rows.map(([vertex]) => Number(vertex))).toEqual(Array.from(vertices));
    rows.forEach(([vertex, , value]) => expect(Number(value)).toBe(fields.clean[vertex]));
  });

  it('takes the field from another file', () => {
    const { counts } = mesh.criticalPoints(fields.noisy);
    expect(place.json(['critical', 'shape.obj', '--values', 'noisy.txt']).counts).toEqual(counts);
    expect(place.json(['critical', 'shape.obj', '--values', 'heat.csv', '--column', 'T']).field).toBe('T');
    expect(place.json(['critical', 'shape.obj', '--values', 'heat.csv', '--column', '1']).counts).toEqual(counts);
    const input = readFileSync(place.at('noisy.txt'));
    expect(place.json(['critical', 'shape.obj', '--values', '-'], { input }).counts).toEqual(counts);
  });
});

describe('persistence', () => {
  it('finds the pairs', () => {
    const found = mesh.persistence(fields.noisy);
    const said = place.json(['persistence', 'torus.ply', '--field', 'noisy']);
    for (const [name, of] of [
      ['extremum', 'extrema'],
      ['saddle', 'saddles'],
      ['birth', 'birth'],
      ['death', 'death'],
      ['persistence', 'persistence'],
    ]) {
      expectSame(said.pairs.map((pair) => pair[name]), found[of]); // prettier-ignore
    }
    expect(said.essentialSaddles).toEqual(plain(found.essentialSaddles));
  });

  it('above a threshold', () => {
    const { threshold, minima, maxima } = mesh.persistenceCurve(fields.noisy);
    const row = threshold.findLastIndex((from) => from <= 0.5);
    const words = ['persistence', 'torus.ply', '--field', 'noisy', '--threshold', '0.5', '--threshold-is', 'absolute'];
    const { pairs } = place.json(words);
    const of = (kind) => pairs.filter((pair) => pair.kind === kind).length + 1;
    expect([of('minimum'), of('maximum')]).toEqual([minima[row], maxima[row]]);
    expect(rowsOf(place.output([...words, '--to', 'csv']))).toHaveLength(1 + pairs.length);
  });
});

describe('smooth', () => {
  const persistent = { from: 'persistence', threshold: 0.1 };
  it.each([
    [['--epsilon', '0.05'], 'tikhonov', { epsilon: 0.05 }],
    [['--epsilon', '0.05', '--metric', 'identity'], 'tikhonov', { epsilon: 0.05, metric: 'identity' }],
    [['--epsilon', '0.1', '--constraints', 'persistence', '--threshold', '0.1'], 'leastSquares', { epsilon: 0.1, constraints: persistent }],
    [['--method', 'interpolate', '--constraints', '@ids.txt', '--energy', 'biharmonic'], 'interpolate', { energy: 'biharmonic', constraints: [0, 12, 576, 588] }],
    [['--method', 'interpolate', '--constraints', '0,12,576,588', '--no-stars'], 'interpolate', { constraints: [0, 12, 576, 588] }],
    [['--method', 'least-squares', '--constraints', 'k-means', '--clusters', '9', '--epsilon', '1'], 'leastSquares', { epsilon: 1, constraints: { from: 'kMeans', clusters: 9 } }],
    [['--method', 'low-pass', '--iterations', '5', '--lambda', '0.5', '--mu', '-0.53'], 'lowPass', { iterations: 5, lambda: 0.5, mu: -0.53 }],
    [['--method', 'bilateral', '--iterations', '1', '--radius', '0.2', '--sigma-distance', '0.1', '--sigma-value', '1'], 'bilateral', { iterations: 1, radius: 0.2, sigmaDistance: 0.1, sigmaValue: 1 }],
  ])('%s', (words, method, options) => {
    writeFileSync(place.at('ids.txt'), '0\n12\n576\n588\n');
    const { values, report } = smoother[method](fields.noisy, options);
    const said = place.json(['smooth', 'torus.ply', '--field', 'noisy', ...words, '-o', 'smooth.ply']);
    expect(said).toMatchObject({ field: 'noisy', name: 'noisy_smoothed', output: 'smooth.ply' });
    expect(said.report).toEqual(plain(report));
    const written = place.read('smooth.ply');
    expect(Object.keys(written.fields)).toEqual(['clean', 'noisy', 'noisy_smoothed']);
    expectSame(written.fields.noisy_smoothed, values);
    expectSame(written.fields.noisy, fields.noisy);
    expectSame(written.positions, place.torus.positions);
  }); // prettier-ignore

  it('chooses ε, and takes what the smoother takes', () => {
    const options = ['--weights', 'uniform', '--precision', 'single', '--epsilon', 'discrepancy', '--noise', '0.1'];
    const other = new Smoother(mesh, { weights: 'uniform', precision: 'single' });
    const { report } = other.tikhonov(fields.noisy, { epsilon: { rule: 'discrepancy', noise: 0.1 } });
    expect(place.json(['smooth', 'torus.ply', '--field', 'noisy', ...options]).report).toEqual(plain(report));
    other.free();
    const auto = smoother.tikhonov(fields.noisy, { epsilon: 'auto' }).report;
    expect(place.json(['smooth', 'torus.ply', '--field', 'noisy']).report).toEqual(plain(auto));
  });

  it('writes values alone, and to the standard output', () => {
    const { values } = smoother.tikhonov(fields.noisy, { epsilon: 0.05 });
    const words = ['smooth', 'torus.ply', '--field', 'noisy', '--epsilon', '0.05'];
    const { stdout, stderr } = place.run([...words, '--to', 'txt']);
    expectSame(readField(Buffer.from(stdout)), values);
    expect(stderr).toContain('tikhonov, equation (5), ε = 0.05');
    const table = place.output([...words, '-o', '-', '--to', 'csv', '--name', 'x']);
    expect(table.split('\n')[0]).toBe('noisy,x');
    expectSame(readField(Buffer.from(table), { column: 'x' }), values);
    const binary = place.output([...words, '--to', 'ply', '--binary', '-q'], { bytes: true });
    expectSame(readMesh(binary).fields.noisy_smoothed, values);
  });
});

describe('simplify', () => {
  it.each([
    [['--threshold', '0.1'], { threshold: 0.1 }],
    [['--threshold', '0.5', '--threshold-is', 'absolute'], { threshold: 0.5, thresholdIs: 'absolute' }],
    [['--keep', '599,26'], { keep: [599, 26] }],
  ])('%s', (words, options) => {
    const { values } = mesh.simplify(fields.noisy, options);
    const said = place.json(['simplify', 'torus.ply', '--field', 'noisy', ...words, '-o', 'simple.vtk']);
    expectSame(place.read('simple.vtk').fields.noisy_simplified, values);
    expect(said.after).toEqual(mesh.criticalPoints(values).counts);
  });
});

describe('prescribe', () => {
  it.each([
    [['--threshold', '0.3', '--keep-values'], { extrema: { from: 'persistence', threshold: 0.3 }, values: 'keep' }],
    [['--minima', '2', '--maxima', '1', '--preview'], { extrema: { from: 'persistence', minima: 2, maxima: 1 }, preview: true }],
    [['--extrema', 'named', '--minima', '599', '--maxima', '26'], { extrema: { minima: [599], maxima: [26] } }],
    [['--extrema', '599,26', '--range', 'input'], { extrema: [599, 26], range: 'input' }],
  ])('%s', (words, options) => {
    const { values, report, minima, maxima } = smoother.prescribe(fields.noisy, { epsilon: 0.05, ...options });
    const common = ['prescribe', 'torus.ply', '--field', 'noisy', '--epsilon', '0.05', '-o', 'exact.ply'];
    const said = place.json([...common, ...words]);
    expectSame(place.read('exact.ply').fields.noisy_prescribed, values);
    expect(said.report).toEqual(plain(report));
    expect([said.minima, said.maxima]).toEqual(plain([minima, maxima]));
  }); // prettier-ignore
});

describe('levels', () => {
  it.each([
    [['--count', '5'], { count: 5 }],
    [
      ['--levels', '-0.5,0,1e-3'],
      [-0.5, 0, 1e-3],
    ],
    [['--saddles', '--offset', '0.01'], { saddles: true, offset: 0.01 }],
  ])('%s', (words, levels) => {
    const found = mesh.levelSets(fields.clean, levels);
    const { lines } = place.json(['levels', 'torus.ply', '--field', 'clean', ...words]);
    expectSame(lines.map(({ level }) => level), found.levels); // prettier-ignore
    expect(lines.map(({ closed }) => (closed ? 1 : 0))).toEqual(plain(found.closed));
    expectSame(lines.flatMap(({ points }) => points.flat()), found.points); // prettier-ignore
    const csv = rowsOf(place.output(['levels', 'torus.ply', '--field', 'clean', ...words, '--to', 'csv']));
    expectSame(csv.slice(1).flatMap((row) => row.slice(3).map(Number)), found.points); // prettier-ignore
    place.output(['levels', 'torus.ply', '--field', 'clean', ...words, '-o', 'lines.obj']);
    const obj = readFileSync(place.at('lines.obj'), 'utf8').split('\n');
    expect(obj.filter((line) => line.startsWith('v '))).toHaveLength(found.points.length / 3);
    expect(obj.filter((line) => line.startsWith('l '))).toHaveLength(found.levels.length);
  });
});

describe('draw', () => {
  it('draws one field', () => {
    const { positions, triangles } = place.torus;
    const words = [
      '--size',
      '200x150',
      '--colormap',
      'cool-warm',
      '--range',
      '-1,1',
      '--count',
      '3',
      '--direction',
      '-1,1,2',
    ];
    place.output([
      'draw',
      'torus.ply',
      '--field',
      'clean',
      ...words,
      '--no-critical-points',
      '--bands',
      '-o',
      'torus.png',
    ]);
    const options = { width: 200, height: 150, colormap: 'coolWarm', range: [-1, 1], levels: { count: 3 } };
    const more = { camera: { direction: [-1, 1, 2] }, criticalPoints: false, bands: true };
    const expected = Buffer.from(snapshot(positions, triangles, fields.clean, { ...options, ...more }));
    expect(readFileSync(place.at('torus.png')).equals(expected)).toBe(true);
  });

  it('draws two and their difference, to the standard output', () => {
    const { positions, triangles } = place.torus;
    const words = [
      'draw',
      'torus.ply',
      '--field',
      'noisy',
      '--after',
      'clean',
      '--size',
      '200x150',
      '--persistence',
      '0.1',
    ];
    const drawn = place.output([...words, '--titles', 'a,b,c'], { bytes: true });
    const options = { width: 200, height: 150, morseComplex: { persistence: 0.1 }, titles: ['a', 'b', 'c'] };
    expect(drawn.equals(Buffer.from(sheet(positions, triangles, fields.noisy, fields.clean, options)))).toBe(true);
  });
});

describe('convert', () => {
  const writable = formats().filter(({ writes }) => writes);
  it.each(writable.map(({ name, extensions }) => [name, extensions[0]]))('%s', (format, ending) => {
    const { stderr } = place.run(['convert', 'torus.ply', '-o', `converted.${ending}`]);
    const { positions, triangles } = place.torus;
    const hasRoom = stderr === '';
    const expected = writeMesh({ positions, triangles }, { format, ...(hasRoom && { fields }) });
    expect(readFileSync(place.at(`converted.${ending}`)).equals(Buffer.from(expected))).toBe(true);
    if (!hasRoom) expect(stderr).toContain('2 fields left out');
  });

  it('keeps some fields, adds others, and goes through pipes', () => {
    place.output(['convert', 'shape.obj', '--values', 'heat.csv', '--column', 'T', '-o', 'heat.ply', '--binary']);
    expectSame(place.read('heat.ply').fields.T, fields.noisy);
    place.output(['convert', 'torus.ply', '--field', 'clean', '-o', 'clean.vtk']);
    expect(Object.keys(place.read('clean.vtk').fields)).toEqual(['clean']);
    const input = readFileSync(place.at('torus.ply'));
    expect(place.output(['convert', '-', '--format', 'ply', '--to', 'off', '--quiet'], { input })).toMatch(/^OFF/);
    expectSame(readField(Buffer.from(place.output(['convert', '-', '--field', 'noisy', '--to', 'txt'], { input }))), fields.noisy); // prettier-ignore
  });
});

describe.runIf(api.files.readMesh.includes('triangleFields'))('fields on triangles', () => {
  it('are averaged where one is named', () => {
    const cells = 'CELL_DATA 2\nSCALARS s double 1\nLOOKUP_TABLE default\n1\n2\n';
    const mesh = 'POINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\nPOLYGONS 2 8\n3 0 1 2\n3 1 3 2\n';
    const input = `# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n${mesh}${cells}`;
    const said = place.json(['info', '-'], { input });
    expect(said.fields).toEqual([{ name: 's', on: 'triangles', min: 1, max: 2, missing: 0 }]);
    expect(place.run(['critical', '-'], { input }).stderr).toContain(
      'fields on triangles alone: s; name one by --field',
    );
    const { criticalPoints } = place.json(['critical', '-', '--field', 's'], { input });
    expect(criticalPoints.map(({ vertex, value }) => [vertex, value])).toEqual([
      [0, 1],
      [3, 2],
    ]);
  });
});

const data = process.env.MORSE_SMOOTH_DATA ?? fileURLToPath(new URL('../../../shared/data', import.meta.url));
const reference = join(data, 'expected.json');
describe.runIf(existsSync(reference))('reference data', () => {
  const files = existsSync(reference) ? JSON.parse(readFileSync(reference, 'utf8')) : {};
  it.each(Object.entries(files))('%s', (name, { mesh: facts, fields: expected }) => {
    const path = join(data, name);
    const { vertices, triangles, edges, area, ...topology } = facts;
    const said = place.json(['info', path]);
    expect([said.vertexCount, said.triangleCount, said.edgeCount]).toEqual([vertices, triangles, edges]);
    expect(said.topology).toMatchObject(topology);
    for (const [field, { criticalPoints, delta }] of Object.entries(expected)) {
      const isThere = said.fields.some((entry) => entry.name === field);
      const values = join(data, `${name.replace(/\..*$/, '')}_${field}.txt`);
      const source = isThere ? ['--field', field] : ['--values', values];
      const countsOf = (...words) => {
        const { minima, maxima, saddles } = place.json(['critical', path, ...source, ...words]).counts;
        return [minima, maxima, saddles];
      };
      expect(countsOf()).toEqual(criticalPoints);
      expect(countsOf('--delta', '0.05', '--link', 'skip')).toEqual(delta['0.05'].skip);
    }
  });
});
