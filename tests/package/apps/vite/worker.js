import init, * as api from 'morse-smooth';
import { use } from '../use.js';

init().then(
  () => postMessage(use(api)),
  (error) => postMessage(String(error)),
);
