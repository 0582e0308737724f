import init, * as api from 'morse-smooth';
import { createRequire } from 'node:module';
import { use } from './use.js';

await init();
const required = createRequire(import.meta.url)('morse-smooth');
console.log(
  JSON.stringify({ ...use(api), oneInstance: required.TriMesh === api.TriMesh && required.default === init }),
);
