import init, * as api from '/node_modules/morse-smooth/dist/index.js';
import { use } from '../use.js';

init().then(
  () => (globalThis.result = use(api)),
  (error) => (globalThis.result = String(error)),
);
