import { loaderOf } from '../../runtime/load.js';

/** What each module exports and no other, as in the modules themselves. */
const MARKS = { core: 'rawtrimesh_new', files: 'readMesh', snapshot: 'rawscene_new' };

/** The code that came from the package's own files, for all connections. */
const own = {};

/** The compiled code of the modules: loaded once, for all workers. */
export class Codes {
  #sources;
  #given;
  #codes = {};
  #loading = {};

  /** `sources[name](target)` loads a module's code into the target, unless it was `given`. */
  constructor(sources, given) {
    this.#sources = sources;
    this.#given = given;
  }

  /** Loads a module unless it is there; after a failure it can be tried again. */
  load(name) {
    this.#loading[name] ??= this.#load(name).catch((error) => {
      delete this.#loading[name];
      throw error;
    });
    return this.#loading[name];
  }

  /** Those of these modules that are there. */
  loaded(names) {
    return Object.fromEntries(names.map((name) => [name, this.#codes[name]]));
  }

  async #load(name) {
    const given = this.#given[name];
    const isOwn = given === undefined || given === null;
    if (isOwn && own[name]) return (this.#codes[name] = own[name]);
    const target = new Target(name);
    if (isOwn) await this.#sources[name](target);
    else await loaderOf(target)({ wasm: given });
    this.#codes[name] = target.code;
    if (isOwn) own[name] = target.code;
    return target.code;
  }
}

/** What takes a module's code in its place, for it is not started here. */
class Target {
  code = null;
  isLost = false;
  #mark;

  constructor(name) {
    this.entry = name === 'core' ? 'morse-smooth' : `morse-smooth/${name}`;
    this.#mark = MARKS[name];
  }

  start(code) {
    const isRight = WebAssembly.Module.exports(code).some(({ name }) => name === this.#mark);
    if (!isRight) throw new Error(`it is not the module of ${this.entry}`);
    this.code = code;
  }
}
