// What users do with a file: read it, and make a mesh of what is in it.
import { TriMesh } from 'morse-smooth';
import { readMesh } from 'morse-smooth/files';

/** What `readMesh` gives, with its mesh. */
export function meshOfFile(bytes, options) {
  const file = readMesh(bytes, options);
  return { ...file, mesh: new TriMesh(file.positions, file.triangles) };
}

/** A mesh as `writeMesh` takes it. */
export const arraysOf = (mesh) => ({ positions: mesh.positions(), triangles: mesh.triangles() });
