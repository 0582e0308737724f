// What several entries of a module for browsers share, in a file of its own, so that there is one instance for all of them.
import module from 'this:module';
import { loaderOf } from '../runtime/load.js';

export * from 'this:api';
/** No name of the API: `export *` passes it by. */
export default loaderOf(module);
