import { MorseSmoothError } from './error.js';
import { Instance } from './instance.js';

/**
 * A WebAssembly module: it is compiled once and has one running instance at a time.
 *
 * An instance that failed in a way that leaves its memory in disorder is lost; a new one is then made from the same code.
 */
export class Module {
  #createGlue;
  #entry;
  #mark;
  #code = null;
  #instance = null;
  #renewsItself = false;

  /** `entry` is the import that loads the module, `mark` a name that no other module exports. */
  constructor(createGlue, entry, mark) {
    this.#createGlue = createGlue;
    this.#entry = entry;
    this.#mark = mark;
  }

  /** The compiled code, once there is some. */
  get code() {
    return this.#code;
  }

  get isLost() {
    return this.#instance?.isLost ?? false;
  }

  /** The running instance. */
  get instance() {
    if (this.#instance === null) {
      throw new MorseSmoothError('NotInitialized', `call \`await init()\` of ${this.#entry} once before anything else`);
    }
    if (this.#instance.isLost) {
      if (!this.#renewsItself) throw this.#instance.lostError();
      this.startSync(this.#code);
    }
    return this.#instance;
  }

  /** Starts an instance of the compiled code. */
  async start(code) {
    this.#refuseForeign(code);
    const glue = this.#createGlue();
    await glue.default({ module_or_path: code });
    this.#running(glue, code);
  }

  /** Starts an instance at once, for Node, where that may block; and starts another one whenever one was lost. */
  startSync(code) {
    const glue = this.#createGlue();
    glue.initSync({ module: code });
    this.#running(glue, code);
    this.#renewsItself = true;
  }

  #running(glue, code) {
    this.#code = code;
    this.#instance = new Instance(glue, this.#entry);
  }

  #refuseForeign(code) {
    const names = WebAssembly.Module.exports(code).map((entry) => entry.name);
    if (!names.includes(this.#mark)) throw new Error(`it is not the module of ${this.#entry}`);
  }
}
