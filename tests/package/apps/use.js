// What every kind of user does: read, look, smooth. Returns what came out.
export function use({ TriMesh, MorseSmoothError, readMesh, smooth, version }) {
  const file = new TextEncoder().encode(`ply
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
  const { mesh, fields } = readMesh(file, { fileName: 'heat.ply' });
  const { values, report } = smooth(mesh, fields.heat, { epsilon: 0.5 });
  let code = null;
  try {
    new TriMesh([0, 0, 0], [0, 1, 2]);
  } catch (error) {
    code = error instanceof MorseSmoothError ? error.code : String(error);
  }
  const finite = values.length === 5 && values.every(Number.isFinite);
  const summary = { version, area: mesh.area, before: report.before, finite, code };
  mesh.free();
  return summary;
}
