// The API in a worker, as TypeScript users meet it.
import { Worker as NodeWorker } from './node-worker.mjs';
import type * as api from 'morse-smooth';
import type * as files from 'morse-smooth/files';
import { MorseSmoothError, connect } from 'morse-smooth/worker';
import type * as worker from 'morse-smooth/worker';

/** Whether two types are the same. */
function same<A, B>(_: (<T>() => T extends A ? 1 : 2) extends <T>() => T extends B ? 1 : 2 ? true : false): void {}

const controller = new AbortController();
const { signal } = controller;
const remote: worker.RemoteMorseSmooth = await connect({ signal, workers: 2, wasm: { core: new Uint8Array(8) } });
await connect();
await connect({ worker: new Worker('worker.js') });
await connect({ worker: () => new Worker('worker.js') });
await connect({ worker: new NodeWorker() });
// @ts-expect-error no worker
await connect({ worker: 'worker.js' });
// @ts-expect-error no such option
await connect({ pool: 3 });

const { positions, triangles, fields } = await remote.readMesh(new Uint8Array(), { format: 'ply', signal });
same<typeof fields, files.MeshFile['fields']>(true);
const formats: files.FormatInfo[] = await remote.formats({ latest: true });
await remote.readField(new Uint8Array(), { column: 2, transfer: true });
const bytes: Uint8Array = await remote.writeMesh({ positions, triangles }, { format: 'ply', signal });
// @ts-expect-error the format has no default
await remote.writeMesh({ positions, triangles });

const onProgress = ({ phase, fraction }: api.Progress) => phase !== 'field' || fraction < 0.5;
const mesh: worker.RemoteTriMesh = await remote.createMesh(positions, triangles, {
  weld: true,
  signal,
  transfer: true,
});
await remote.createMesh([0, 0, 0], null);
const heat = new Float64Array(mesh.vertexCount);
same<typeof mesh.area, number>(true);
same<typeof mesh.warnings, api.Diagnostic[]>(true);
const { genus }: api.MeshTopology = await mesh.topology({ signal });
const points: api.CriticalPoints = await mesh.criticalPoints(heat, { delta: 0.1, signal, onProgress, latest: true });
await mesh.criticalPoints([1, 2, 3]);
await mesh.levelSets(heat, { count: 5 }, { missing: 'omit', signal });
await mesh.simplify(heat, { threshold: 0.1, signal });
const matrix: api.SparseMatrix = await mesh.laplacian({ weights: 'uniform', signal });
const own: Float64Array = await mesh.positions({ signal });
const part = await mesh.withoutMissing(heat, { signal });
same<typeof part.mesh, worker.RemoteTriMesh>(true);
same<typeof part.vertices, ReturnType<api.TriMesh['withoutMissing']>['vertices']>(true);
// @ts-expect-error a promise has no counts
mesh.criticalPoints(heat).counts;
// @ts-expect-error no such option
await mesh.criticalPoints(heat, { epsilon: 1 });
// @ts-expect-error simplify has no default
await mesh.simplify(heat);
// @ts-expect-error values are missing
await mesh.criticalPoints({ signal });
// @ts-expect-error true or false
await mesh.positions({ latest: 'tikhonov' });

const smoother: worker.RemoteSmoother = await remote.createSmoother(mesh, { weights: 'uniform', onProgress, signal });
const smoothed: api.Smoothed = await smoother.tikhonov(heat, { epsilon: 0.1, latest: true, onProgress });
await smoother.tikhonov(heat, { cutoffWavelength: 2, signal });
await smoother.interpolate(heat, { constraints: [1, 2], signal });
const exact: api.Prescribed = await smoother.prescribe(heat, { epsilon: 0.1, extrema: [1], signal });
await smoother.lowPass(heat, { iterations: 3 });
const curves: api.Sweep = await smoother.sweep(heat, { counts: true, signal });
// @ts-expect-error ε has no default
await smoother.tikhonov(heat, { signal });

const family: worker.RemoteSmoothingFamily = await smoother.family(heat, { tolerance: 0.01, signal });
same<typeof family.epsilonRange, [number, number]>(true);
const values: Float64Array = await family.values(0.1, { latest: true });
const isComplete: boolean = await family.grow({ onProgress });
await family.at(0.1, { signal });
const { epsilon }: api.ChosenEpsilon = await family.choose();
await family.choose('auto', { signal });
await family.sweep({ counts: true, signal });

await remote.smooth(mesh, heat);
await remote.smooth(mesh, heat, { epsilon: 0.1, signal });
const prescribed: api.Prescribed = await remote.smooth(mesh, heat, { method: 'prescribe', signal });
// @ts-expect-error it is a mesh of the connection that is smoothed
await remote.smooth({} as api.TriMesh, heat);

const scene: worker.RemoteScene = await remote.createScene(positions, triangles);
const png: Uint8Array = await scene.snapshot(heat, { width: 100, latest: true });
await scene.surface({ signal });
await remote.sheet(positions, triangles, heat, heat, { titles: ['a', 'b', 'c'], signal });

for (const object of [scene, family, smoother, mesh]) object.free();
remote.close();
{
  using another = await connect();
  using held = await another.createMesh(positions, triangles);
  held.vertexCount satisfies number;
}
const error: Error = new MorseSmoothError('WorkerLost', 'gone');
export { bytes, curves, epsilon, error, exact, formats, genus, isComplete, matrix, own, png, points, prescribed, smoothed, values }; // prettier-ignore
