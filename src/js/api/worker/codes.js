import { MorseSmoothError } from '../../runtime/error.js';
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

  /** `sources[name]()` says where a module's code is, unless it was `given`. */
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
    let failure;
    for (const source of isOwn ? this.#sources[name] : [() => given]) {
      try {
        this.#codes[name] = await codeFrom(await source(), MARKS[name]);
        if (isOwn) own[name] = this.#codes[name];
        return this.#codes[name];
      } catch (error) {
        failure ??= error;
      }
    }
    if (failure.name === 'MorseSmoothError') throw failure;
    throw new MorseSmoothError(
      'LoadFailed',
      `the WebAssembly module could not be loaded: ${failure.message}`,
      {},
      { cause: failure },
    );
  }
}

/** Loads code as the modules do, without starting it here. */
async function codeFrom(source, mark) {
  const module = {
    code: null,
    isLost: false,
    start(code) {
      const isRight = WebAssembly.Module.exports(code).some(({ name }) => name === mark);
      if (!isRight) throw new Error('it is another module');
      this.code = code;
    },
  };
  await loaderOf(module)(() => source, { wasm: source });
  return module.code;
}
