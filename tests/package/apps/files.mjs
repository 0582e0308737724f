import { MorseSmoothError } from 'morse-smooth';
import init, * as files from 'morse-smooth/files';
import { createRequire } from 'node:module';
import { read } from './read.js';

await init();
const required = createRequire(import.meta.url)('morse-smooth/files');
const oneInstance = required.readMesh === files.readMesh && required.default === init;
const oneError = files.MorseSmoothError === MorseSmoothError;
console.log(JSON.stringify({ ...read(files), oneInstance, oneError }));
