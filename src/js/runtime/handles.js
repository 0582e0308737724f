import { MorseSmoothError } from './error.js';

/**
 * Owns one object in the memory of an instance and knows whether it was freed and whether a call is running on it.
 *
 * A call can be running when another begins: `onProgress` is user code, called from within.
 */
export class Handle {
  #kind;
  #instance;
  #raw;
  #running = 0;
  /** Whether the call that is running changes the object. */
  #isChanging = false;

  constructor(kind, instance, raw) {
    this.#kind = kind;
    this.#instance = instance;
    this.#raw = raw;
  }

  /** The instance that the object lives in. */
  get instance() {
    return this.#instance;
  }

  /** Reads something small: `action(raw)`. */
  read(action) {
    return this.#run('call', action);
  }

  /** Calls `action(raw, glue)`; other calls that do not change the object may run meanwhile. */
  use(action) {
    return this.#run('work', action);
  }

  /** Calls `action(raw, glue)`, which changes the object: no other call may run meanwhile. */
  useAlone(action) {
    this.#refuseWhileRunning('used again');
    return this.use((raw, glue) => {
      this.#isChanging = true;
      try {
        return action(raw, glue);
      } finally {
        this.#isChanging = false;
      }
    });
  }

  /** Gives the memory back. An object of an instance that was lost has none. */
  free() {
    this.#refuseWhileRunning('freed');
    const raw = this.#raw;
    this.#raw = null;
    if (raw !== null && !this.#instance.isLost) this.#instance.call(() => raw.free());
  }

  #run(how, action) {
    if (this.#raw === null) {
      const object = this.#kind;
      throw new MorseSmoothError('UseAfterFree', `this ${object} was freed`, { object });
    }
    if (this.#isChanging) this.#refuseWhileRunning('used again');
    this.#running++;
    try {
      return this.#instance[how]((glue) => action(this.#raw, glue));
    } finally {
      this.#running--;
    }
  }

  #refuseWhileRunning(what) {
    if (this.#running === 0 || this.#instance.isLost) return;
    const object = this.#kind;
    throw new MorseSmoothError('Busy', `this ${object} cannot be ${what} while a call on it is running`, { object });
  }
}

/** Lets objects of these classes be used as in `using mesh = new TriMesh(…)`, where the language has it: `free` is called at the end. */
export function makeDisposable(...classes) {
  if (!Symbol.dispose) return;
  for (const { prototype } of classes) {
    Object.defineProperty(prototype, Symbol.dispose, { value: prototype.free, configurable: true, writable: true });
  }
}
