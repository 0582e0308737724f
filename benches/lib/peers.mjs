// The solver and its peers in WebAssembly: building benches/peers, and instances of it.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { inRoot } from '../../scripts/lib/paths.mjs';
import { must } from '../../scripts/lib/run.mjs';

// In the order of benches/common.
export const MESHES = ['torus', 'knot', 'sphere', 'terrain'];
export const SYSTEMS = ['LII', 'C', 'A', 'A3'];
export const METRICS = ['identity', 'lumped', 'mass'];
const ARRAYS = ['positions', 'triangles', 'offsets', 'rows', 'values', 'rightHandSides', 'results'];
const IDS = ['triangles', 'offsets', 'rows'];

/** Where the builds of the benches go; kept from run to run. */
export const targetFolder = join(process.env.CARGO_TARGET_DIR || inRoot('target'), 'peers');

/** Returns the paths of two modules: with faer as it comes, and with SIMD in the products of its matrices. */
export async function buildPeers() {
  return { wasm: await buildOne('plain', []), simd: await buildOne('simd', ['--features', 'faer-simd']) };
}

async function buildOne(name, features) {
  const target = 'wasm32-unknown-unknown';
  const manifest = inRoot('benches', 'peers', 'Cargo.toml');
  const parameters = ['build', '--release', '--locked', '--manifest-path', manifest, '--target', target];
  parameters.push('--target-dir', join(targetFolder, name), ...features);
  const env = { RUSTFLAGS: '-C target-feature=+simd128' };
  await must('cargo', parameters, 'benches/peers does not build.', { env });
  return join(targetFolder, name, target, 'release', 'solver_peers.wasm');
}

/** A fresh instance with a mesh of about `size` vertices: the module's functions, and what turns names into its numbers. */
export async function instantiate(path, mesh, size) {
  let memory = null;
  const report = (text, length) => console.error(new TextDecoder().decode(new Uint8Array(memory.buffer, text, length)));
  const { instance } = await WebAssembly.instantiate(readFileSync(path), { env: { report } });
  const exported = instance.exports;
  memory = exported.memory;
  exported.start();
  const vertices = exported.build_mesh(MESHES.indexOf(mesh), size);

  /** A view that the next call may invalidate. */
  const array = (name) => {
    const which = ARRAYS.indexOf(name);
    const [address, length] = [exported.array_address(which), exported.array_length(which)];
    return new (IDS.includes(name) ? Uint32Array : Float64Array)(memory.buffer, address, length);
  };
  const results = (count) => (count === 0 ? null : [...array('results')]);
  return {
    ...exported,
    vertices,
    array,
    bytes: () => memory.buffer.byteLength,
    system: (name, epsilon = 1) => exported.build_system(SYSTEMS.indexOf(name), epsilon),
    matrix: () => Object.fromEntries(ARRAYS.slice(2, 6).map((name) => [name, array(name)])),
    realErrors: (metric, epsilon, bits) => results(exported.accuracy_real(METRICS.indexOf(metric), epsilon, bits)),
    complexErrors: (epsilon, bits) => results(exported.accuracy_complex(epsilon, bits)),
  };
}
