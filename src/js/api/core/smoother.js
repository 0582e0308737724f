import { toNumbers, toOptions } from '../../runtime/convert.js';
import { watched } from '../../runtime/progress.js';
import { Handle } from '../../runtime/handles.js';
import { checkChannels, toConstraints, toExtrema } from './arguments.js';
import { familyOf, toRule } from './family.js';
import { handleOf } from './mesh.js';
import { core } from './module.js';

/** The methods that take constraints; to the others they are an option that they do not know, whatever its value. */
const CONSTRAINED = ['interpolate', 'leastSquares', 'prescribe'];

/** How much of a sweep it is to make the family. */
const SHARE_OF_FAMILY = 0.8;

export class Smoother {
  #handle;
  #vertexCount;
  /** What the methods call back where their own options name nothing else. */
  #onProgress;

  constructor(mesh, options) {
    // Before anything else: whether there is an instance at all.
    void core.instance;
    const source = handleOf(mesh);
    const given = toOptions(options);
    this.#onProgress = given?.onProgress;
    this.#vertexCount = mesh.vertexCount;
    this.#handle = watched(given, (settings) =>
      source.use((rawMesh) =>
        source.instance.create('Smoother', ({ RawSmoother }) => new RawSmoother(rawMesh, settings)),
      ),
    );
  }

  tikhonov(values, options) {
    return this.#smooth('tikhonov', values, options);
  }

  interpolate(values, options) {
    return this.#smooth('interpolate', values, options);
  }

  leastSquares(values, options) {
    const given = toOptions(options);
    if (isGiven(given?.weights)) given.weights = toNumbers(given.weights, 'weights');
    return this.#smooth('leastSquares', values, given);
  }

  lowPass(values, options) {
    return this.#smooth('lowPass', values, options);
  }

  bilateral(values, options) {
    return this.#smooth('bilateral', values, options);
  }

  prescribe(values, options) {
    const given = withExtrema(toOptions(options), this.#vertexCount);
    if (isGiven(given?.weights)) given.weights = toNumbers(given.weights, 'weights');
    return this.#smooth('prescribe', values, given);
  }

  family(values, options) {
    return this.#family(values, options);
  }

  sweep(values, options) {
    const { epsilons, counts, channel, ...rest } = this.#watching(toOptions(options)) ?? {};
    const numbers = isGiven(epsilons) ? toNumbers(epsilons, 'epsilons') : undefined;
    // What is asked of the family is refused before it is made.
    const asked = { counts, channel };
    const making = { ...rest, onProgress: within(0, SHARE_OF_FAMILY, rest.onProgress) };
    const family = this.#family(values, making, asked, numbers);
    try {
      const onProgress = within(SHARE_OF_FAMILY, 1, rest.onProgress);
      return family.sweep({ epsilons: numbers, ...asked, onProgress });
    } finally {
      family.free();
    }
  }

  free() {
    this.#handle.free();
  }

  /** A family, of which a sweep is asked afterwards or nothing. */
  #family(values, options, asked, epsilons) {
    const given = toOptions(options);
    if (isGiven(given?.weights)) given.weights = toNumbers(given.weights, 'weights');
    if (Array.isArray(given?.epsilonRange)) given.epsilonRange = [...given.epsilonRange];
    const numbers = toNumbers(values, 'values');
    checkChannels(given, this.#vertexCount, numbers);
    const settings = withConstraints(this.#watching(given), this.#vertexCount);
    const raw = watched(settings, (settings) =>
      this.#handle.useAlone((raw) => raw.family(numbers, settings, asked, epsilons)),
    );
    return familyOf(new Handle('SmoothingFamily', this.#handle.instance, raw), this.#handle, this.#onProgress);
  }

  /** The options of a call with what is to be called back: their own, or the smoother's. */
  #watching(given) {
    return isGiven(this.#onProgress) && !isGiven(given?.onProgress)
      ? { ...given, onProgress: this.#onProgress }
      : given;
  }

  #smooth(method, values, options) {
    const given = toOptions(options);
    const numbers = toNumbers(values, 'values');
    checkChannels(given, this.#vertexCount, numbers);
    const all = withRule(this.#watching(given));
    const settings = CONSTRAINED.includes(method) ? withConstraints(all, this.#vertexCount) : all;
    return watched(settings, (settings) => this.#handle.useAlone((raw) => raw.apply(method, numbers, settings)));
  }
}

export function smooth(mesh, values, options) {
  void core.instance;
  const source = handleOf(mesh);
  const numbers = toNumbers(values, 'values');
  const count = mesh.vertexCount;
  const given = withRule(withExtrema(withConstraints(toOptions(options), count), count));
  checkChannels(given, count, numbers);
  return watched(given, (settings) => source.use((rawMesh, glue) => glue.smooth(rawMesh, numbers, settings)));
}

/** Tells the progress of a part of a call as that of the whole. */
function within(start, end, onProgress) {
  if (typeof onProgress !== 'function') return onProgress;
  return ({ phase, fraction }) => onProgress({ phase, fraction: start + (end - start) * fraction });
}

/** Options whose constraints are as the wasm module takes them. */
function withConstraints(settings, vertexCount) {
  const constraints = settings?.constraints;
  if (isGiven(constraints)) settings.constraints = toConstraints(constraints, vertexCount);
  return settings;
}

/** Options whose chosen extrema are as the wasm module takes them. */
function withExtrema(settings, vertexCount) {
  const extrema = settings?.extrema;
  if (isGiven(extrema)) settings.extrema = toExtrema(extrema, vertexCount);
  return settings;
}

/** Options whose ε, where it is a rule, is as the wasm module takes it. */
function withRule(settings) {
  return isGiven(settings?.epsilon) ? { ...settings, epsilon: toRule(settings.epsilon) } : settings;
}

const isGiven = (value) => value !== undefined && value !== null;
