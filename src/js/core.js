// What the entries share; a file of its own in dist/, so that there is one instance of the module.
import { instance } from './core-instance.js';
import { loaderOf } from './init.js';

export * from './api.js';
export const initFrom = loaderOf(instance);
