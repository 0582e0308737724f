// What runs in the worker, in browsers: `morse-smooth/worker-script`. It waits for connections.
import { answer } from '../api/worker/serve.js';

globalThis.addEventListener('message', ({ data }) => answer(data));
