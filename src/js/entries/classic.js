// One script for pages without modules, which are opened from a disk, say: everything is in it, and a global variable has the API.
import { packed } from 'this:embedded';
import load from './api.js';

export * from 'this:api';

export function init(options) {
  return load(options, null, () => ({ packed }));
}
