import init, * as api from '/node_modules/morse-smooth/dist/index.js';
import initFiles, * as files from '/node_modules/morse-smooth/dist/files.js';
import initPictures, * as pictures from '/node_modules/morse-smooth/dist/snapshot.js';
import { draw } from '../draw.js';
import { read } from '../read.js';
import { use } from '../use.js';

Promise.all([init(), initFiles(), initPictures()]).then(
  () => (globalThis.result = { page: use(api), file: read(files), picture: draw(pictures) }),
  (error) => (globalThis.result = String(error)),
);
