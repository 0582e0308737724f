// The entry for browsers with the WebAssembly module in a script.
import load from 'this:shared';
import { packed } from 'this:embedded';

export * from 'this:shared';

/** Takes the wasm module from the script itself: nothing is fetched. */
export default function init(options) {
  return load(options, null, () => ({ packed }));
}
