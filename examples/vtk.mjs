// Polydata of vtk.js as meshes, fields on them, and level sets as polydata again. (npm install @kitware/vtk.js morse-smooth)
import vtkCellArray from '@kitware/vtk.js/Common/Core/CellArray.js';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray.js';
import vtkPoints from '@kitware/vtk.js/Common/Core/Points.js';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData.js';

/** What `new TriMesh(…)` takes: convex polygons are cut into fans, strips into triangles. Lines and vertices of a polydata are no part of it. */
export function arraysOf(polydata) {
  const triangles = [];
  for (const cell of cellsOf(polydata.getPolys()))
    for (let k = 2; k < cell.length; k++) triangles.push(cell[0], cell[k - 1], cell[k]);
  for (const cell of cellsOf(polydata.getStrips()))
    for (let k = 2; k < cell.length; k++)
      triangles.push(...(k % 2 ? [1, 2, 0] : [2, 1, 0]).map((back) => cell[k - back]));
  return { positions: polydata.getPoints().getData(), triangles };
}

/** A cell array is the number of points of a cell, these points, the number of the next one's, … */
function cellsOf(cells) {
  const data = cells?.getData() ?? [];
  const found = [];
  for (let at = 0; at < data.length; at += data[at] + 1) found.push(data.subarray(at + 1, at + 1 + data[at]));
  return found;
}

/** Makes a field the scalars of the points. `vertexMap` is that of the mesh: null where nothing was welded. */
export function setField(polydata, name, values, vertexMap = null) {
  const ofPoints = vertexMap ? Float64Array.from(vertexMap, (vertex) => values[vertex]) : values;
  polydata.getPointData().setScalars(vtkDataArray.newInstance({ name, values: ofPoints, numberOfComponents: 1 }));
  polydata.modified();
}

/** The other way round. Points that were welded must have one value. */
export function fieldOf(polydata, name, mesh) {
  const data = polydata.getPointData().getArrayByName(name).getData();
  const vertexMap = mesh.vertexMap();
  if (!vertexMap) return data;
  const values = new Float64Array(mesh.vertexCount).fill(NaN);
  vertexMap.forEach((vertex, point) => {
    if (Number.isNaN(values[vertex])) values[vertex] = data[point];
    else if (values[vertex] !== data[point])
      throw new Error(`point ${point} has another value of ${name} than its like`);
  });
  return values;
}

/** Level sets as lines, each with its level as a scalar. */
export function linesOf({ points, offsets, closed, levels }) {
  const polydata = vtkPolyData.newInstance();
  const coordinates = vtkPoints.newInstance();
  coordinates.setData(points, 3);
  polydata.setPoints(coordinates);
  const cells = [];
  closed.forEach((isClosed, line) => {
    const ids = Array.from({ length: offsets[line + 1] - offsets[line] }, (_, k) => offsets[line] + k);
    if (isClosed) ids.push(ids[0]);
    cells.push(ids.length, ...ids);
  });
  polydata.setLines(vtkCellArray.newInstance({ values: Uint32Array.from(cells) }));
  polydata.getCellData().setScalars(vtkDataArray.newInstance({ name: 'level', values: levels, numberOfComponents: 1 }));
  return polydata;
}
