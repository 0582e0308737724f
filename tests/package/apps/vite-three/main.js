import { run } from '../three.js';

run().then(
  (result) => (globalThis.result = result),
  (error) => (globalThis.result = String(error)),
);
