// Compiled, never run: a project that has neither the types of a browser nor those of Node.
import init, { MorseSmoothError, TriMesh, smooth } from 'morse-smooth';
import { readMesh } from 'morse-smooth/files';
import { snapshot } from 'morse-smooth/snapshot';
import { connect } from 'morse-smooth/worker';

await init({ wasm: '/x.wasm' });
await init({ wasm: new Uint8Array(8) });
await init({ wasm: new ArrayBuffer(8) });
// @ts-expect-error a number is no source
await init({ wasm: 5 });
const { positions, triangles, fields } = readMesh(new ArrayBuffer(8));
const mesh = new TriMesh(positions, triangles);
export const png: Uint8Array = snapshot(positions, triangles, smooth(mesh, fields['heat'] ?? []).values);
export const isOurs = (error: unknown): boolean => error instanceof MorseSmoothError;
export const area: number = (await (await connect()).createMesh(positions, triangles)).area;
