import { toConstraints, toNumbers, toOptions } from './convert.js';
import { Handle } from './handle.js';
import { core } from './core-instance.js';
import { handleOf } from './mesh.js';
import { relayProgress } from './progress.js';

/** The methods that take constraints; to the others they are an option that they do not know, whatever its value. */
const CONSTRAINED = ['interpolate', 'leastSquares'];

export class Smoother {
  #handle;
  /** Makes a call during which `onProgress` may run. */
  #run;
  #vertexCount;

  constructor(mesh, options) {
    const { RawSmoother } = core();
    const source = handleOf(mesh);
    const relay = relayProgress(toOptions(options));
    this.#run = relay.run;
    this.#vertexCount = mesh.vertexCount;
    const raw = relay.run(() => source.use((rawMesh) => new RawSmoother(rawMesh, relay.options)));
    this.#handle = new Handle('Smoother', raw);
  }

  tikhonov(values, options) {
    return this.#smooth('tikhonov', values, options);
  }

  interpolate(values, options) {
    return this.#smooth('interpolate', values, options);
  }

  leastSquares(values, options) {
    const { weights, ...others } = toOptions(options) ?? {};
    const hasWeights = weights !== undefined && weights !== null;
    return this.#smooth('leastSquares', values, others, hasWeights ? toNumbers(weights, 'weights') : undefined);
  }

  lowPass(values, options) {
    return this.#smooth('lowPass', values, options);
  }

  bilateral(values, options) {
    return this.#smooth('bilateral', values, options);
  }

  free() {
    this.#handle.free();
  }

  #smooth(method, values, options, weights) {
    const numbers = toNumbers(values, 'values');
    const given = toOptions(options);
    const settings = CONSTRAINED.includes(method) ? withConstraints(given, this.#vertexCount) : given;
    return this.#run(() => this.#handle.useAlone((raw) => raw[method](numbers, settings, weights)));
  }
}

/** Options whose constraints are as the wasm module takes them. */
function withConstraints(settings, vertexCount) {
  const constraints = settings?.constraints;
  if (constraints !== undefined && constraints !== null) settings.constraints = toConstraints(constraints, vertexCount);
  return settings;
}

export function smooth(mesh, values, options) {
  const module = core();
  const source = handleOf(mesh);
  const numbers = toNumbers(values, 'values');
  const relay = relayProgress(withConstraints(toOptions(options), mesh.vertexCount));
  return relay.run(() => source.use((rawMesh) => module.smooth(rawMesh, numbers, relay.options)));
}
