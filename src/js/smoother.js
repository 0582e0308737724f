import { toNumbers, toOptions } from './convert.js';
import { Handle } from './handle.js';
import { core } from './instance.js';
import { handleOf } from './mesh.js';
import { relayProgress } from './progress.js';

export class Smoother {
  #handle;
  /** Makes a call during which `onProgress` may run. */
  #run;

  constructor(mesh, options) {
    const { RawSmoother } = core();
    const source = handleOf(mesh);
    const relay = relayProgress(toOptions(options));
    this.#run = relay.run;
    const raw = relay.run(() => source.use((rawMesh) => new RawSmoother(rawMesh, relay.options)));
    this.#handle = new Handle('Smoother', raw);
  }

  tikhonov(values, options) {
    const numbers = toNumbers(values, 'values');
    const settings = toOptions(options);
    return this.#run(() => this.#handle.useAlone((raw) => raw.tikhonov(numbers, settings)));
  }

  free() {
    this.#handle.free();
  }
}

export function smooth(mesh, values, options) {
  const module = core();
  const source = handleOf(mesh);
  const numbers = toNumbers(values, 'values');
  const relay = relayProgress(toOptions(options));
  return relay.run(() => source.use((rawMesh) => module.smooth(rawMesh, numbers, relay.options)));
}
