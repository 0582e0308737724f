// What examples/vtk.mjs does with the real vtk.js: shapes that are known. (Copied beside it and run in Node.)
import assert from 'node:assert';
import vtkCellArray from '@kitware/vtk.js/Common/Core/CellArray.js';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData.js';
import vtkCubeSource from '@kitware/vtk.js/Filters/Sources/CubeSource.js';
import vtkSphereSource from '@kitware/vtk.js/Filters/Sources/SphereSource.js';
import vtkXMLPolyDataWriter from '@kitware/vtk.js/IO/XML/XMLPolyDataWriter.js';
import { TriMesh, smooth } from 'morse-smooth';
import { arraysOf, fieldOf, linesOf, setField } from './vtk.mjs';

// Six squares with four points each.
const cube = vtkCubeSource.newInstance({ xLength: 1, yLength: 2, zLength: 3 }).getOutputData();
const box = arraysOf(cube);
const welded = new TriMesh(box.positions, box.triangles, { weld: true });
assert.deepEqual([welded.vertexCount, welded.triangleCount, welded.topology.eulerCharacteristic], [8, 12, 2]);
assert.equal(welded.area, 22);
assert(welded.topology.orientable);
const numbers = Float64Array.of(0, 1, 2, 3, 4, 5, 6, 7);
setField(cube, 'numbers', numbers, welded.vertexMap());
assert.equal(cube.getPointData().getScalars().getNumberOfTuples(), 24);
assert.deepEqual(fieldOf(cube, 'numbers', welded), numbers);

// A strip of three triangles, which all turn alike.
const strip = vtkPolyData.newInstance();
strip.getPoints().setData(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0), 3);
strip.setStrips(vtkCellArray.newInstance({ values: Uint32Array.of(5, 0, 1, 2, 3, 4) }));
assert.deepEqual(arraysOf(strip).triangles, [0, 1, 2, 2, 1, 3, 2, 3, 4]);

// A sphere with a rough field on it.
const sphere = vtkSphereSource.newInstance({ radius: 2, thetaResolution: 40, phiResolution: 30 }).getOutputData();
const { positions, triangles } = arraysOf(sphere);
const mesh = new TriMesh(positions, triangles, { weld: { tolerance: 1e-6 } });
assert.deepEqual([mesh.topology.eulerCharacteristic, mesh.topology.closed], [2, true]);
const heights = mesh.positions().filter((_, k) => k % 3 === 2);
const { values } = smooth(mesh, heights.map((z, k) => z + 0.3 * Math.sin(k * k)), { epsilon: 0.1 }); // prettier-ignore
setField(sphere, 'smoothed', values, mesh.vertexMap());
assert.deepEqual(fieldOf(sphere, 'smoothed', mesh), values);
assert.equal(sphere.getPointData().getScalars().getName(), 'smoothed');

const sets = mesh.levelSets(heights, [-0.9, 0.6]);
const lines = linesOf(sets);
assert.equal(lines.getNumberOfLines(), 2);
assert.deepEqual([...lines.getCellData().getScalars().getData()].sort(), [-0.9, 0.6]);
const cells = lines.getLines().getData();
assert.equal(cells.length, sets.points.length / 3 + 2 * 2);
// Closed: it ends where it began.
assert.equal(cells[1], cells[cells[0]]);
const z = lines.getPoints().getData().filter((_, k) => k % 3 === 2); // prettier-ignore
for (const height of z) assert([-0.9, 0.6].some((level) => Math.abs(height - level) < 1e-9));
// What else is in the polydata is as vtk.js wants it: its writer takes both.
for (const polydata of [sphere, lines]) assert.match(vtkXMLPolyDataWriter.newInstance().write(polydata), /<Piece /);
console.log('ok');
