import { MorseSmoothError } from './error.js';

/** As many objects may be there at once before the garbage collector is made to look whether some were forgotten. */
const FEW = 4;
/** More than engines let pass: V8 looks after 64 MB. Pages that nobody touches take no memory. */
const PRESSURE = 128 << 20;

/** The objects that are there, and as many as may be. */
let living = 0;
let limit = FEW;
let forgotten = null;

/**
 * The garbage collector knows nothing of the memory behind these objects, which are a few bytes to it: it would collect forgotten ones
 * when gigabytes are taken. A buffer that is let go of at once reminds it, each time that there are half as many again.
 */
function count(handle) {
  forgotten ??= globalThis.FinalizationRegistry
    ? new FinalizationRegistry(discount)
    : { register() {}, unregister() {} };
  forgotten.register(handle, undefined, handle);
  living++;
  if (living <= limit) return;
  limit = 1.5 * living;
  try {
    // That its length is looked at keeps bundlers from leaving it out.
    limit += Math.min(0, new ArrayBuffer(PRESSURE).byteLength);
  } catch {
    // There is no room for it: the collector has been at work, then.
  }
}

function discount() {
  living--;
  limit = Math.max(FEW, Math.min(limit, 1.5 * living));
}

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
    count(this);
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
    if (raw === null) return;
    this.#raw = null;
    forgotten.unregister(this);
    discount();
    if (!this.#instance.isLost) this.#instance.call(() => raw.free());
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
