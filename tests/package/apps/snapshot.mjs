import { MorseSmoothError } from 'morse-smooth';
import init, * as pictures from 'morse-smooth/snapshot';
import { createRequire } from 'node:module';
import { draw } from './draw.js';

await init();
const required = createRequire(import.meta.url)('morse-smooth/snapshot');
const oneInstance = required.Scene === pictures.Scene && required.default === init;
const oneError = pictures.MorseSmoothError === MorseSmoothError;
console.log(JSON.stringify({ ...draw(pictures), oneInstance, oneError }));
