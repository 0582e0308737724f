// What runs in the worker, in Node: `morse-smooth/worker-script`. It waits for connections.
import { parentPort } from 'node:worker_threads';
import { answer } from '../api/worker/serve.js';

parentPort?.on('message', answer);
