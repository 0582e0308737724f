// What `field.mjs` measures, and the memory that one of it takes in a process of its own.
import { noisyTorus } from './noisy-torus.mjs';

/** `target`: the ratio to sorting that must not be passed. */
export const ROWS = [
  { name: 'criticalPoints', target: 1, run: (mesh, f) => mesh.criticalPoints(f) },
  { name: 'deltaHierarchy (it classifies, too)', target: 1, run: (mesh, f) => mesh.deltaHierarchy(f) },
  { name: 'deltaHierarchy, link: skip', run: (mesh, f) => mesh.deltaHierarchy(f, { link: 'skip' }) },
  { name: 'persistence', target: 4, run: (mesh, f) => mesh.persistence(f) },
  { name: 'simplify, threshold 0.01', target: 8, run: (mesh, f) => mesh.simplify(f, { threshold: 0.01 }) },
  { name: 'simplify, threshold 0.1', target: 8, run: (mesh, f) => mesh.simplify(f, { threshold: 0.1 }) },
  { name: 'morseComplex', target: 6, run: (mesh, f) => mesh.morseComplex(f) },
  { name: 'morseComplex, paths: merged', target: 6, run: (mesh, f) => mesh.morseComplex(f, { paths: 'merged' }) },
  { name: 'morseComplex, persistence 0.02', target: 6, run: (mesh, f) => mesh.morseComplex(f, { persistence: 0.02 }) },
  { name: 'morseHierarchy', run: (mesh, f) => mesh.morseHierarchy(f) },
  { name: 'basins', run: (mesh, f) => mesh.basins(f) },
  { name: 'basins, persistence 0.02', run: (mesh, f) => mesh.basins(f, { persistence: 0.02 }) },
];

/** The size of WebAssembly's memory after making the mesh and one call; it never shrinks, so this is the peak. */
export async function run({ name, size }) {
  const memories = [];
  const { Instance } = WebAssembly;
  WebAssembly.Instance = function (...parameters) {
    const instance = new Instance(...parameters);
    memories.push(instance.exports.memory);
    return instance;
  };
  const { TriMesh } = await import('../../dist/node.mjs');
  const { positions, triangles, values } = noisyTorus(...size);
  const mesh = new TriMesh(positions, triangles);
  ROWS.find((row) => row.name === name)?.run(mesh, values);
  if (memories.length !== 1) throw new Error('the module was not instantiated as this expects');
  return { bytes: memories[0].buffer.byteLength };
}
