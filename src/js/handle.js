import { MorseSmoothError, attempt } from './error.js';

/**
 * Owns one object in wasm memory and knows whether it was freed and whether a call is running on it.
 *
 * A call can be running when another begins: `onProgress` is user code, called from within.
 */
export class Handle {
  #kind;
  #raw;
  #running = 0;

  constructor(kind, raw) {
    this.#kind = kind;
    this.#raw = raw;
  }

  /** Calls `action` with the object; other calls may run meanwhile. */
  use(action) {
    if (this.#raw === null) {
      const object = this.#kind;
      throw new MorseSmoothError('UseAfterFree', `this ${object} was freed`, { object });
    }
    this.#running++;
    try {
      return attempt(() => action(this.#raw));
    } finally {
      this.#running--;
    }
  }

  /** Calls `action` with the object, which it changes: no other call may run meanwhile. */
  useAlone(action) {
    this.#refuseWhileRunning('used again');
    return this.use(action);
  }

  free() {
    this.#refuseWhileRunning('freed');
    const raw = this.#raw;
    this.#raw = null;
    attempt(() => raw?.free());
  }

  #refuseWhileRunning(what) {
    if (this.#running === 0) return;
    const object = this.#kind;
    throw new MorseSmoothError('Busy', `this ${object} cannot be ${what} while a call on it is running`, { object });
  }
}

/** `using mesh = new TriMesh(…)`, where the language has it. */
export function makeDisposable(...classes) {
  if (!Symbol.dispose) return;
  for (const { prototype } of classes) {
    Object.defineProperty(prototype, Symbol.dispose, { value: prototype.free, configurable: true, writable: true });
  }
}
