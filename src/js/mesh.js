import { toConstraints, toLevels, toNumbers, toOptions, toTriangles, toVertices } from './convert.js';
import { attempt, invalidArgument } from './error.js';
import { Handle } from './handle.js';
import { core } from './core-instance.js';

/** Of every mesh. (A private field would be out of reach for the functions that take a mesh.) */
const handles = new WeakMap();

/** The wasm object behind a mesh that the caller passed. */
export function handleOf(mesh) {
  const handle = handles.get(mesh);
  if (handle === undefined) throw invalidArgument('mesh', 'a TriMesh');
  return handle;
}

export class TriMesh {
  #topology = null;

  /** `positions` may also be a handle, which only this package has: a mesh that was read from a file. */
  constructor(positions, triangles, options) {
    if (positions instanceof Handle) {
      handles.set(this, positions);
      return;
    }
    const { RawTriMesh } = core();
    const numbers = toNumbers(positions, 'positions');
    const ids = toTriangles(triangles, Math.floor(numbers.length / 3));
    const settings = toOptions(options);
    const raw = attempt(() => new RawTriMesh(numbers, ids, settings));
    handles.set(this, new Handle('TriMesh', raw));
  }

  get vertexCount() {
    return handleOf(this).use((raw) => raw.vertexCount);
  }

  get edgeCount() {
    return handleOf(this).use((raw) => raw.edgeCount);
  }

  get triangleCount() {
    return handleOf(this).use((raw) => raw.triangleCount);
  }

  get area() {
    return handleOf(this).use((raw) => raw.area);
  }

  get topology() {
    return handleOf(this).use((raw) => (this.#topology ??= Object.freeze(raw.topology())));
  }

  get warnings() {
    return handleOf(this).use((raw) => raw.warnings());
  }

  positions() {
    return handleOf(this).use((raw) => raw.positions());
  }

  triangles() {
    return handleOf(this).use((raw) => raw.triangles());
  }

  criticalPoints(values, options) {
    return this.#analyse('criticalPoints', values, toOptions(options));
  }

  deltaHierarchy(values, options) {
    return this.#analyse('deltaHierarchy', values, toOptions(options));
  }

  levelSets(values, levels) {
    return this.#analyse('levelSets', values, toLevels(levels, this.vertexCount));
  }

  bands(values, levels) {
    return this.#analyse('bands', values, toLevels(levels, this.vertexCount));
  }

  persistence(values) {
    return this.#analyse('persistence', values);
  }

  persistenceCurve(values) {
    return this.#analyse('persistenceCurve', values);
  }

  simplify(values, options) {
    const settings = toOptions(options);
    const keep = settings?.keep;
    if (keep !== undefined && keep !== null) settings.keep = toVertices(keep, 'keep', this.vertexCount);
    return this.#analyse('simplify', values, settings);
  }

  morseComplex(values, options) {
    return this.#analyse('morseComplex', values, toOptions(options));
  }

  morseHierarchy(values) {
    return this.#analyse('morseHierarchy', values);
  }

  basins(values, options) {
    return this.#analyse('basins', values, toOptions(options));
  }

  constrainedVertices(values, constraints, options) {
    const numbers = toNumbers(values, 'values');
    const rule = toConstraints(constraints, this.vertexCount);
    const settings = toOptions(options);
    return handleOf(this).use((raw) => raw.constrainedVertices(numbers, rule, settings));
  }

  smoothness(values, options) {
    return this.#analyse('smoothness', values, toOptions(options));
  }

  laplacian(options) {
    const settings = toOptions(options);
    return handleOf(this).use((raw) => raw.laplacian(settings));
  }

  mass(options) {
    const settings = toOptions(options);
    return handleOf(this).use((raw) => raw.mass(settings));
  }

  free() {
    handleOf(this).free();
  }

  #analyse(method, values, settings) {
    const numbers = toNumbers(values, 'values');
    return handleOf(this).use((raw) => raw[method](numbers, settings));
  }
}
