// What users of files do: read a mesh with its field, write it, read it again. Returns what came out.
export function read({ MorseSmoothError, formats, readField, readMesh, readTable, writeMesh }) {
  const bytes = new TextEncoder().encode(`ply
format ascii 1.0
element vertex 5
property double x
property double y
property double z
property double heat
element face 4
property list uchar int vertex_indices
end_header
0 0 0 5
1 0 0 1
0 1 0 2
-1 0 0 3
0 -1 0 4
3 0 1 2
3 0 2 3
3 0 3 4
3 0 4 1
`);
  const { positions, triangles, fields } = readMesh(bytes, { fileName: 'heat.ply' });
  const written = writeMesh({ positions, triangles }, { format: 'vtk', binary: true, fields });
  const back = readMesh(written);
  const table = new TextEncoder().encode('a,b\n1,2\n3,4\n');
  let code = null;
  try {
    readField(table, { column: 'c' });
  } catch (error) {
    code = error instanceof MorseSmoothError ? error.code : String(error);
  }
  return {
    format: back.format,
    positions: [...back.positions],
    triangles: [...back.triangles],
    heat: [...back.fields.heat],
    column: [...readTable(table).columns.b],
    formats: formats().length,
    code,
  };
}
