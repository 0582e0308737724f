import * as glue from '../../pkg/core/morse_smooth.js';
import { Instance } from './instance.js';

export const instance = new Instance(glue, 'morse-smooth', 'rawtrimesh_new');
export const core = () => instance.functions();
