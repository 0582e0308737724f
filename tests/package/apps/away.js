// The app of users of workers.
import * as api from 'morse-smooth/worker';
import { remote } from './remote.js';

export const away = () => remote(api);
