import * as glue from '../../../pkg/snapshot/morse_smooth_snapshot.js';
import { Instance } from '../instance.js';

export const instance = new Instance(glue, 'morse-smooth/snapshot', 'rawscene_new');
