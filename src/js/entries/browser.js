// The entry for browsers and bundlers.
import load from 'this:shared';

export * from 'this:shared';

/**
 * Loads the wasm file that lies beside this one: bundlers find it by this very expression. Where it cannot be had, the copy in a
 * script does instead, which bundlers turn into a chunk of its own.
 */
export default function init(options) {
  return load(
    options,
    () => import('this:embedded'),
    () => new URL(__WASM__, import.meta.url),
  );
}
