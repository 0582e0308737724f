// A thousand meshes and smoothers, which are freed ("tidy") or forgotten. Prints the memory that they took, in megabytes.
import { Smoother, TriMesh } from 'morse-smooth';

const { Instance } = WebAssembly;
let memory;
WebAssembly.Instance = class extends Instance {
  constructor(...given) {
    super(...given);
    ({ memory } = this.exports);
  }
};

const side = 20;
const ids = Array.from({ length: side * side }, (_, k) => k);
const positions = ids.flatMap((k) => [k % side, Math.floor(k / side), Math.sin(k)]);
const corners = ids.filter((k) => k % side < side - 1 && k < side * (side - 1));
const triangles = corners.flatMap((k) => [k, k + 1, k + side, k + 1, k + side + 1, k + side]);
const values = ids.map((k) => Math.sin(12.9898 * k));

let peak = 0;
for (let cycle = 0; cycle < 1000; cycle++) {
  const mesh = new TriMesh(positions, triangles);
  const smoother = new Smoother(mesh);
  smoother.tikhonov(values, { epsilon: 0.1 });
  if (process.argv[2] === 'tidy') {
    smoother.free();
    mesh.free();
  }
  peak = Math.max(peak, process.memoryUsage.rss());
  // What waits for events, as programs do: nothing is collected in between otherwise.
  await new Promise((resolve) => setTimeout(resolve));
}
console.log(JSON.stringify({ wasm: memory.buffer.byteLength / 1e6, all: peak / 1e6 }));
