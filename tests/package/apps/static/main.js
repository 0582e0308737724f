import init, * as api from '/node_modules/morse-smooth/dist/index.js';
import initPictures, * as pictures from '/node_modules/morse-smooth/dist/snapshot.js';
import { draw } from '../draw.js';
import { use } from '../use.js';

Promise.all([init(), initPictures()]).then(
  () => (globalThis.result = { page: use(api), picture: draw(pictures) }),
  (error) => (globalThis.result = String(error)),
);
