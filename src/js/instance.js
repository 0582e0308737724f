import { MorseSmoothError } from './error.js';

/**
 * What there is of one wasm module: its glue, and whether it runs. `entry` is the import that loads it, `mark` a name that no other
 * module exports.
 */
export class Instance {
  #glue;
  #entry;
  #mark;
  #started = false;

  constructor(glue, entry, mark) {
    this.#glue = glue;
    this.#entry = entry;
    this.#mark = mark;
  }

  /** The module's functions, once it runs. */
  functions() {
    if (!this.#started) {
      throw new MorseSmoothError('NotInitialized', `call \`await init()\` of ${this.#entry} once before anything else`);
    }
    return this.#glue;
  }

  /** Starts the compiled module. */
  async start(module) {
    this.#refuseForeign(module);
    await this.#glue.default({ module_or_path: module });
    this.#started = true;
  }

  /** The same at once, for Node, where it may block. */
  startSync(module) {
    this.#glue.initSync({ module });
    this.#started = true;
  }

  /** The glue would keep the first module it is given, right or wrong. */
  #refuseForeign(module) {
    const names = WebAssembly.Module.exports(module).map((entry) => entry.name);
    if (!names.includes(this.#mark)) throw new Error(`it is not the module of ${this.#entry}`);
  }
}
