// The entry `morse-smooth/worker` for browsers.
import { connectorOf } from '../api/worker/connect.js';

export { MorseSmoothError } from '../runtime/error.js';

const bytesOf = (base64) => Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));

let address = null;
/** Where the script is that lies in a script. */
async function embedded() {
  const { default: text } = await import('./worker-embedded.js');
  address ??= URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
  return address;
}

export const connect = connectorOf({
  // Bundlers find the files by these very expressions. Where one does not, or the server has no such file, the script comes from a
  // chunk of its own, which is loaded in that case only.
  makers: [
    () => new Worker(new URL('./worker-script.js', import.meta.url), { type: 'module' }),
    async () => new Worker(await embedded()),
  ],
  sources: {
    core: [
      () => new URL('./morse_smooth_bg.wasm', import.meta.url),
      async () => bytesOf((await import('./wasm-base64.js')).default),
    ],
    files: [() => new URL('./morse_smooth_files_bg.wasm', import.meta.url)],
    snapshot: [() => new URL('./morse_smooth_snapshot_bg.wasm', import.meta.url)],
  },
  watch(worker, onEnd) {
    const onError = ({ message }) => onEnd(message || 'its script could not be loaded', false);
    const onUnreadable = () => onEnd('a message could not be read', false);
    worker.addEventListener('error', onError);
    worker.addEventListener('messageerror', onUnreadable);
    return () => {
      worker.removeEventListener('error', onError);
      worker.removeEventListener('messageerror', onUnreadable);
    };
  },
  hold() {},
  end: (worker) => worker.terminate(),
});
