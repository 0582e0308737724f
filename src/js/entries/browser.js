// The entry for browsers and bundlers.
import load from 'this:shared';

export * from 'this:shared';

/**
 * Loads the wasm file that lies beside this one: bundlers find it by this very expression. Where it cannot be had, the copy in a
 * script does instead, which bundlers turn into a chunk of its own.
 *
 * What Vite builds has the file, and is to have no second chunk: it refuses that in workers, which it makes classic scripts. (What its
 * development server serves does not have the file before version 8.)
 */
export default function init(options) {
  return load(
    options,
    () => new URL(__WASM__, import.meta.url),
    import.meta.env?.PROD ? null : () => import('this:embedded'),
  );
}
