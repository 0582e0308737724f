import init, * as api from 'morse-smooth';
import initInline, * as inline from 'morse-smooth/inline';
import wasmUrl from 'morse-smooth/morse_smooth_bg.wasm?url';
import initFiles, * as files from 'morse-smooth/files';
import initPictures, * as pictures from 'morse-smooth/snapshot';
import * as remoteApi from 'morse-smooth/worker';
import { draw } from '../draw.js';
import { read } from '../read.js';
import { remote } from '../remote.js';
import { use } from '../use.js';

const inWorker = () =>
  new Promise((resolve) => {
    const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }) => resolve(data);
    worker.onerror = ({ message }) => resolve(message);
  });

async function all() {
  await init();
  await initInline();
  await initFiles();
  await initPictures();
  const { byteLength } = await (await fetch(wasmUrl)).arrayBuffer();
  const oneError = [files, pictures, remoteApi].every(
    ({ MorseSmoothError }) => MorseSmoothError === api.MorseSmoothError,
  );
  return {
    page: use(api),
    inline: use(inline),
    file: read(files),
    picture: draw(pictures),
    oneError,
    worker: await inWorker(),
    byteLength,
    remote: await remote(remoteApi),
  };
}

all().then(
  (result) => (globalThis.result = result),
  (error) => (globalThis.result = String(error)),
);
