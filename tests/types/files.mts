// Compiled, never run: the API of the files as a user writes it, and what must not compile.
import { MorseSmoothError as CoreError, TriMesh, smooth } from 'morse-smooth';
import type { Diagnostic } from 'morse-smooth';
import init, { MorseSmoothError, formats, readField, readMesh, readTable, writeMesh } from 'morse-smooth/files';
import type * as api from 'morse-smooth/files';

/** Compiles only where the two types are the same. */
function same<A, B>(_: [A] extends [B] ? ([B] extends [A] ? true : never) : never): void {}

const ready: Promise<void> = init({ wasm: new URL('https://example.org/morse_smooth_files_bg.wasm') });
same<typeof MorseSmoothError, typeof CoreError>(true);
const isOurs = (error: unknown): error is CoreError => error instanceof MorseSmoothError;
// @ts-expect-error there is no such option
await init({ url: '/x.wasm' });
// @ts-expect-error files are read by an entry of their own
export { readMesh as notThere } from 'morse-smooth';

for (const { name, extensions, reads, writes, description } of formats()) {
  same<
    [typeof name, typeof extensions, typeof reads, typeof writes, typeof description],
    [string, string[], boolean, boolean, string]
  >(true);
}

// ------------------------------------------------------------------------------------------------------------- meshes
const file = readMesh(new Uint8Array(3), { format: 'ply', fileName: 'x.ply', weld: true });
same<typeof file, api.MeshFile>(true);
same<api.MeshFile['format'], api.MeshFormat>(true);
same<api.MeshFile['triangleFields'], api.MeshFile['fields']>(true);
same<[typeof file.positions, typeof file.triangles], [Float64Array<ArrayBuffer>, Uint32Array<ArrayBuffer>]>(true);
same<typeof file.vertexMap, Uint32Array<ArrayBuffer> | null>(true);
same<api.Diagnostic, Diagnostic>(true);
const fields: Record<string, Float64Array> = file.fields;
for (const { code, message, count, examples } of file.warnings) {
  same<[typeof code, typeof message, typeof count, typeof examples], [string, string, number, number[]]>(true);
}
smooth(new TriMesh(file.positions, file.triangles), fields.heat!, { epsilon: 1 });
readMesh(new Uint8Array(3), { weld: { tolerance: 1e-6 } });
// @ts-expect-error text is not bytes
readMesh('OFF');
readMesh(new Uint8Array(3), { format: 'glb', triangleFields: 'average' });
// @ts-expect-error a format of tables
readMesh(new Uint8Array(3), { format: 'csv' });
// @ts-expect-error the option is called fileName
readMesh(new Uint8Array(3), { filename: 'x.ply' });
// @ts-expect-error a mesh is made of the arrays
file.mesh;

// -------------------------------------------------------------------------------------------------- fields and tables
const heat: Float64Array = readField(new Uint8Array(3), { format: 'csv', column: 'heat' });
readField(new Uint8Array(3), { format: 'txt', column: 2 });
readField(new Uint8Array(3), { fileName: 'x.csv' });
readField(new Uint8Array(3), { format: 'npy', vertices: 3, triangles: 1 });
// @ts-expect-error no format of tables
readField(new Uint8Array(3), { format: 'stl' });
const { columns, warnings } = readTable(new Uint8Array(3), { format: 'csv', fileName: 'x.csv' });
same<[typeof columns, typeof warnings], [Record<string, Float64Array<ArrayBuffer>>, Diagnostic[]]>(true);
// @ts-expect-error all columns are read
readTable(new Uint8Array(3), { column: 2 });

// ------------------------------------------------------------------------------------------------------------ writing
const bytes: Uint8Array = writeMesh(file, { format: 'vtk', binary: true, fields: { heat, cold: [1, 2] } });
writeMesh({ positions: [0, 0, 0] as const, triangles: new Uint16Array(3) }, { format: 'ply', missing: 'omit' });
// @ts-expect-error the format has no default
writeMesh(file, {});
writeMesh(file, { format: 'vtp' });
// @ts-expect-error read only
writeMesh(file, { format: 'vtu' });
// @ts-expect-error its arrays are wanted
writeMesh(new TriMesh(file.positions, file.triangles), { format: 'ply' });

export { bytes, isOurs, ready };

// -------------------------------------------------------------------------------------------------------------- bytes
readMesh(new ArrayBuffer(3));
readField(new DataView(new ArrayBuffer(3)));
readTable(await new Blob([]).arrayBuffer());
// @ts-expect-error which bytes, the numbers do not say
readMesh(new Float64Array(3));
