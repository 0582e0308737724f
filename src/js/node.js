import { instance } from './core-instance.js';
import { startFrom } from './start.js';

export * from './api.js';
export default startFrom('morse_smooth_bg.wasm', instance);
