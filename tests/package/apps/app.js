// What every app does: loads the modules, unless it is not to wait, and uses them. The result is to be the same everywhere.
import init, * as api from 'morse-smooth';
import initFiles, * as files from 'morse-smooth/files';
import initPictures, * as pictures from 'morse-smooth/snapshot';
import { draw } from './draw.js';
import { read } from './read.js';
import { use } from './use.js';

export async function run(waits = true) {
  if (waits) await Promise.all([init(), initFiles(), initPictures()]);
  const oneError = [files, pictures].every(({ MorseSmoothError }) => MorseSmoothError === api.MorseSmoothError);
  return { page: use(api), file: read(files), picture: draw(pictures), oneError };
}
