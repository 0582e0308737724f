// The entry `morse-smooth/worker` for browsers.
import { connectorOf } from '../api/worker/connect.js';
import { loaderOf } from '../runtime/load.js';

export { MorseSmoothError } from '../runtime/error.js';

let address = null;
/** Where the worker's script is that lies in a script. */
async function embedded() {
  const { script } = await import('embedded:worker');
  address ??= URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  return address;
}

// Bundlers find the files by these very expressions. Where one does not, or the server has no such file, what is embedded does instead:
// chunks of their own, which are loaded in that case only. What Vite builds has the files, and no second chunk, as in the other entries.
export const connect = connectorOf({
  makers: [
    () => new Worker(new URL('./worker-script.js', import.meta.url), { type: 'module' }),
    ...(import.meta.env?.PROD ? [] : [async () => new Worker(await embedded())]),
  ],
  channel: () => new MessageChannel(),
  sources: {
    core: (target) =>
      loaderOf(target)(
        undefined,
        () => new URL('./morse_smooth_bg.wasm', import.meta.url),
        import.meta.env?.PROD ? null : () => import('embedded:core'),
      ),
    files: (target) =>
      loaderOf(target)(
        undefined,
        () => new URL('./morse_smooth_files_bg.wasm', import.meta.url),
        import.meta.env?.PROD ? null : () => import('embedded:files'),
      ),
    snapshot: (target) =>
      loaderOf(target)(
        undefined,
        () => new URL('./morse_smooth_snapshot_bg.wasm', import.meta.url),
        import.meta.env?.PROD ? null : () => import('embedded:snapshot'),
      ),
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
