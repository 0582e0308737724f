import { toNumbers, toOptions, toTriangles, toVertices } from '../../runtime/convert.js';
import { invalidArgument } from '../../runtime/error.js';
import { Handle } from '../../runtime/handles.js';
import { watched } from '../../runtime/progress.js';
import { checkChannels, toConstraints, toLevels } from './arguments.js';
import { core } from './module.js';

/** For every mesh its handle and its topology, once that is known. (Private fields would be out of reach for other files.) */
const states = new WeakMap();

function stateOf(mesh) {
  const state = states.get(mesh);
  if (state === undefined) throw invalidArgument('mesh', 'a TriMesh');
  return state;
}

/** The wasm object behind a mesh that the caller passed. */
export const handleOf = (mesh) => stateOf(mesh).handle;

/** A mesh that the module made, not the constructor. */
function meshOf(handle) {
  const mesh = Object.create(TriMesh.prototype);
  states.set(mesh, { handle, topology: null });
  return mesh;
}

export class TriMesh {
  constructor(positions, triangles, options) {
    const { instance } = core;
    const numbers = toNumbers(positions, 'positions');
    const ids = triangles === null ? undefined : toTriangles(triangles, Math.floor(numbers.length / 3));
    const settings = toOptions(options);
    const handle = instance.create('TriMesh', ({ RawTriMesh }) => new RawTriMesh(numbers, ids, settings));
    states.set(this, { handle, topology: null });
  }

  get vertexCount() {
    return handleOf(this).read((raw) => raw.vertexCount);
  }

  get edgeCount() {
    return handleOf(this).read((raw) => raw.edgeCount);
  }

  get triangleCount() {
    return handleOf(this).read((raw) => raw.triangleCount);
  }

  get area() {
    return handleOf(this).read((raw) => raw.area);
  }

  get topology() {
    const state = stateOf(this);
    return state.handle.use((raw) => (state.topology ??= Object.freeze(raw.topology())));
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

  vertexMap() {
    return handleOf(this).use((raw) => raw.vertexMap());
  }

  withoutMissing(values) {
    const numbers = toNumbers(values, 'values');
    const handle = handleOf(this);
    const { mesh, vertices } = handle.use((raw) => raw.withoutMissing(numbers));
    return { mesh: meshOf(new Handle('TriMesh', handle.instance, mesh)), vertices };
  }

  criticalPoints(values, options) {
    return analyse(this, 'criticalPoints', values, options);
  }

  deltaHierarchy(values, options) {
    return analyse(this, 'deltaHierarchy', values, options);
  }

  levelSets(values, levels, options) {
    return analyse(this, 'levelSets', values, options, toLevels(levels, this.vertexCount));
  }

  bands(values, levels, options) {
    return analyse(this, 'bands', values, options, toLevels(levels, this.vertexCount));
  }

  persistence(values, options) {
    return analyse(this, 'persistence', values, options);
  }

  persistenceCurve(values, options) {
    return analyse(this, 'persistenceCurve', values, options);
  }

  simplify(values, options) {
    const settings = toOptions(options);
    const keep = settings?.keep;
    if (keep !== undefined && keep !== null) settings.keep = toVertices(keep, 'keep', this.vertexCount);
    return analyse(this, 'simplify', values, settings);
  }

  morseComplex(values, options) {
    return analyse(this, 'morseComplex', values, options);
  }

  morseHierarchy(values, options) {
    return analyse(this, 'morseHierarchy', values, options);
  }

  basins(values, options) {
    return analyse(this, 'basins', values, options);
  }

  constrainedVertices(values, constraints, options) {
    const numbers = toNumbers(values, 'values');
    const settings = toOptions(options);
    checkChannels(settings, this.vertexCount, numbers);
    return watch(this, 'constrainedVertices', settings, numbers, toConstraints(constraints, this.vertexCount));
  }

  smoothness(values, options) {
    return analyse(this, 'smoothness', values, options);
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
}

// Functions, not private methods: a mesh that was cut out of another is not made by the constructor.

/** Reads a field by a method of the raw mesh. */
function analyse(mesh, method, values, options, ...more) {
  const settings = toOptions(options);
  return watch(mesh, method, settings, toNumbers(values, 'values'), ...more);
}

/** Calls a method of the raw mesh whose last argument are options that may have `onProgress`. */
function watch(mesh, method, options, ...given) {
  return watched(toOptions(options), (settings) => handleOf(mesh).use((raw) => raw[method](...given, settings)));
}
