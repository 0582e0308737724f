// What the entries share; a file of its own in dist/, so that there is one instance of the module.
export * from './api.js';
export { initFrom } from './init.js';
