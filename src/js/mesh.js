import { toLevels, toNumbers, toOptions, toTriangles } from './convert.js';
import { attempt, invalidArgument } from './error.js';
import { Handle } from './handle.js';
import { core } from './instance.js';

/** The wasm object behind a mesh that the caller passed. */
export let handleOf;

export class TriMesh {
  #handle;
  #topology = null;

  static {
    handleOf = (mesh) => {
      if (typeof mesh === 'object' && mesh !== null && #handle in mesh) return mesh.#handle;
      throw invalidArgument('mesh', 'a TriMesh');
    };
  }

  /** `positions` may also be a handle, which only this package has: a mesh that was read from a file. */
  constructor(positions, triangles, options) {
    if (positions instanceof Handle) {
      this.#handle = positions;
      return;
    }
    const { RawTriMesh } = core();
    const numbers = toNumbers(positions, 'positions');
    const ids = toTriangles(triangles, Math.floor(numbers.length / 3));
    const settings = toOptions(options);
    this.#handle = new Handle(
      'TriMesh',
      attempt(() => new RawTriMesh(numbers, ids, settings)),
    );
  }

  get vertexCount() {
    return this.#handle.use((raw) => raw.vertexCount);
  }

  get edgeCount() {
    return this.#handle.use((raw) => raw.edgeCount);
  }

  get triangleCount() {
    return this.#handle.use((raw) => raw.triangleCount);
  }

  get area() {
    return this.#handle.use((raw) => raw.area);
  }

  get topology() {
    return this.#handle.use((raw) => (this.#topology ??= Object.freeze(raw.topology())));
  }

  get warnings() {
    return this.#handle.use((raw) => raw.warnings());
  }

  positions() {
    return this.#handle.use((raw) => raw.positions());
  }

  triangles() {
    return this.#handle.use((raw) => raw.triangles());
  }

  criticalPoints(values, options) {
    return this.#analyse('criticalPoints', values, toOptions(options));
  }

  levelSets(values, levels) {
    return this.#analyse('levelSets', values, toLevels(levels));
  }

  smoothness(values, options) {
    return this.#analyse('smoothness', values, toOptions(options));
  }

  laplacian(options) {
    const settings = toOptions(options);
    return this.#handle.use((raw) => raw.laplacian(settings));
  }

  mass(options) {
    const settings = toOptions(options);
    return this.#handle.use((raw) => raw.mass(settings));
  }

  free() {
    this.#handle.free();
  }

  #analyse(method, values, settings) {
    const numbers = toNumbers(values, 'values');
    return this.#handle.use((raw) => raw[method](numbers, settings));
  }
}
