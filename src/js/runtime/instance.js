import { MorseSmoothError, internalError, reported } from './error.js';
import { Handle } from './handles.js';

/** A running instance of a WebAssembly module: its memory, and the functions of the glue that work on it. */
export class Instance {
  #glue;
  #entry;
  #hint;
  #isLost = false;

  /** `hint` says more of an option that the module does not know. */
  constructor(glue, entry, hint) {
    this.#glue = glue;
    this.#entry = entry;
    this.#hint = hint;
  }

  get isLost() {
    return this.#isLost;
  }

  /**
   * Makes a call into the module, `action(glue)`, and turns whatever it throws into a `MorseSmoothError`.
   *
   * The module reports failures as plain objects. Anything else is a defect of ours or of what runs the module: a trap, say, or a
   * stack that is too small. It leaves memory in disorder, so that the instance is lost.
   */
  call(action) {
    this.#refuseIfLost();
    let result;
    try {
      result = action(this.#glue);
    } catch (thrown) {
      if (thrown instanceof MorseSmoothError) throw thrown;
      // It may have been lost already, to a call from within a callback.
      this.#refuseIfLost();
      throw reported(thrown, this.#hint) ?? this.#lose(thrown);
    }
    this.#refuseIfLost();
    return result;
  }

  /** Calls like `call`, for what takes memory: makes sure beforehand that there is enough for small things, such as errors. */
  work(action) {
    return this.call((glue) => {
      const bytes = glue.setAside();
      if (bytes === 0) return action(glue);
      const message = `${bytes} bytes of memory are needed, more than can be had here`;
      throw new MorseSmoothError('OutOfMemory', message, { bytes });
    });
  }

  /** An object in the module's memory that `make(glue)` returns. */
  create(kind, make) {
    return new Handle(kind, this, this.work(make));
  }

  /** What is thrown where a lost instance is used. */
  lostError() {
    return new MorseSmoothError(
      'InstanceLost',
      `an earlier call failed inside the WebAssembly module of ${this.#entry} and left its memory in disorder; ` +
        'call `await init()` again, and make the objects anew',
    );
  }

  #refuseIfLost() {
    if (!this.#isLost) return;
    // Once more: where the stack was at its end, the first time may not have come through.
    this.#glue.abandon();
    throw this.lostError();
  }

  #lose(thrown) {
    this.#isLost = true;
    this.#glue.abandon();
    return internalError(thrown);
  }
}
