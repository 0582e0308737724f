import { buffersIn } from './encode.js';

/** A call that was asked for: it waits for a worker, runs, and is settled once. */
export class Job {
  static #count = 0;
  /** From 1 to 2³¹ − 1, so that it fits into the flag; 0 is no call. */
  number = (Job.#count = (Job.#count % 0x7fffffff) + 1);
  /** Where it runs. */
  thread = null;
  /** Whether the code of its module is there. */
  isReady = false;
  isSettled = false;
  #settle = {};
  #signal;
  #onAbort;

  /** `object` is what a method is called on, `needs` are all objects that the call names, `makes` is the one that it makes. */
  constructor({ kind, object, name, call, args, needs, makes, onProgress, isLatest }) {
    Object.assign(this, { kind, object, name, call, args, needs, makes, onProgress, isLatest });
    for (const needed of needs) needed.uses++;
    this.promise = new Promise((resolve, reject) => {
      this.#settle = { resolve, reject };
    });
  }

  /** What is called alike: of two such calls, only the later one may matter. */
  isLike({ object, name }) {
    return object === this.object && name === this.name;
  }

  /** What the worker is told. */
  message() {
    return messageOf(this, this.makes);
  }

  /** What makes the object again. It does not hold the job, whose promise holds what stands for the object: that could not be forgotten. */
  recipe() {
    const { kind, object, name, args, needs } = this;
    return { needs, message: (made) => messageOf({ kind, object, name, args }, made) };
  }

  buffers() {
    return [...buffersIn(this.args)];
  }

  abortWith(signal, abort) {
    if (signal === undefined) return;
    this.#signal = signal;
    this.#onAbort = () => abort(signal.reason);
    signal.addEventListener('abort', this.#onAbort);
  }

  resolve(value) {
    this.#done().resolve(value);
  }

  reject(error) {
    this.#done().reject(error);
  }

  /** It needs its objects no longer. */
  release() {
    for (const needed of this.needs) needed.uses--;
  }

  #done() {
    this.isSettled = true;
    this.#signal?.removeEventListener('abort', this.#onAbort);
    return this.#settle;
  }
}

/** A call as it is posted; `made` is the object that it makes, maybe again. */
function messageOf({ kind, object, name, args }, made) {
  return { kind, target: object?.number ?? null, name, args, makes: made?.number ?? null, changes: made?.changes };
}
