// What the entries for browsers share; a file of its own in dist/, so that there is one module for all of them.
import { core } from '../api/core/module.js';
import { loaderOf } from '../runtime/load.js';

export * from '../api/core/index.js';
export const initFrom = loaderOf(core);
