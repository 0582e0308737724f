import { startFrom } from '../start.js';
import { instance } from './instance.js';

export * from './api.js';
export default startFrom('morse_smooth_snapshot_bg.wasm', instance);
