import { MorseSmoothError } from './error.js';
import { hintsOf } from './hints.js';
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
  #hint;
  #code = null;
  #instance = null;
  /** Gives the code at once, for Node, where that may block. */
  #compile = null;
  #globals = globalThis;

  /** `entry` is the import that loads the module, `mark` a name that no other module exports, `options` what its functions take. */
  constructor(createGlue, entry, mark, options) {
    this.#createGlue = createGlue;
    this.#entry = entry;
    this.#mark = mark;
    this.#hint = hintsOf(options);
  }

  /** The compiled code, once there is some. */
  get code() {
    return this.#code;
  }

  get entry() {
    return this.#entry;
  }

  get isLost() {
    return this.#instance?.isLost ?? false;
  }

  /** The running instance. */
  get instance() {
    if (this.#instance === null || this.#instance.isLost) {
      if (this.#compile !== null) this.#startNow();
      else if (this.#instance === null) throw this.#notInitialized();
      else throw this.#instance.lostError();
    }
    return this.#instance;
  }

  /** Starts an instance of the compiled code. */
  async start(code) {
    this.#refuseForeign(code);
    const glue = this.#createGlue(this.#globals);
    this.#running(glue, await WebAssembly.instantiate(code, glue.imports()), code);
  }

  /** Starts an instance whenever there is none, of what `compile` gives; `globals` has the classes for text. */
  onDemand(compile, globals) {
    this.#compile = compile;
    this.#globals = globals;
  }

  #startNow() {
    const code = this.#code ?? this.#compile();
    const glue = this.#createGlue(this.#globals);
    this.#running(glue, new WebAssembly.Instance(code, glue.imports()), code);
  }

  #running(glue, instance, code) {
    glue.run(instance, code);
    this.#code = code;
    this.#instance = new Instance(glue, this.#entry, this.#hint);
  }

  #notInitialized() {
    return new MorseSmoothError('NotInitialized', `call \`await init()\` of ${this.#entry} once before anything else`);
  }

  #refuseForeign(code) {
    const names = WebAssembly.Module.exports(code).map((entry) => entry.name);
    if (!names.includes(this.#mark)) throw new Error(`it is not the module of ${this.#entry}`);
  }
}
