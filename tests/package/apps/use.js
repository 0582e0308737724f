// What every kind of user does: make a mesh, look, smooth. Returns what came out.
export function use({ TriMesh, MorseSmoothError, smooth, version }) {
  const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0];
  const mesh = new TriMesh(positions, [0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1]);
  const { values, report } = smooth(mesh, [5, 1, 2, 3, 4], { epsilon: 0.5 });
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
