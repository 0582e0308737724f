import * as api from 'morse-smooth';
import * as worker from 'morse-smooth/worker';
import { createRequire } from 'node:module';
import { remote } from './remote.js';

const required = createRequire(import.meta.url)('morse-smooth/worker');
const oneError = worker.MorseSmoothError === api.MorseSmoothError;
console.log(JSON.stringify({ ...(await remote(worker)), oneError, oneInstance: required.connect === worker.connect }));
