import { MorseSmoothError, invalidArgument, invalidOption } from './error.js';

const SOURCES = 'a URL, string, Request, Response, BufferSource or WebAssembly.Module';

/**
 * The `init` of a module's entries: loads it once, from `options.wasm` or else from what `defaultSource` returns. After a failure
 * it can be called again, and so it can where the instance was lost; the code is at hand then.
 */
export function loaderOf(module) {
  let loading = null;
  let isDone = false;
  // Not an async function: later calls return the very same promise.
  return (defaultSource, options) => {
    let source;
    try {
      source = sourceOf(options) ?? module.code ?? defaultSource();
    } catch (error) {
      return Promise.reject(error);
    }
    if (isDone && module.isLost) loading = null;
    if (loading === null) {
      isDone = false;
      loading = load(module, source).then(
        () => {
          isDone = true;
        },
        (error) => {
          loading = null;
          throw error;
        },
      );
    }
    return loading;
  };
}

/** What the options ask to load: `undefined` when they leave it open. */
export function sourceOf(options) {
  if (options === undefined) return undefined;
  if (typeof options !== 'object' || options === null) throw invalidArgument('options', 'an object');
  const unknown = Object.keys(options).find((key) => key !== 'wasm');
  if (unknown !== undefined) {
    throw new MorseSmoothError('UnknownOption', `there is no option \`${unknown}\``, { option: unknown });
  }
  const { wasm } = options;
  if (wasm === undefined || isAddress(wasm) || isResponse(wasm) || isCode(wasm)) return wasm;
  throw invalidOption('wasm', SOURCES);
}

async function load(module, source) {
  const detail = {};
  try {
    const code = isAddress(source) ? await fetch(source) : source;
    if (isResponse(code)) Object.assign(detail, { url: code.url, status: code.status });
    await module.start(await compile(code));
  } catch (error) {
    const from = detail.url ? ` from ${detail.url}` : '';
    const message = `the WebAssembly module could not be loaded${from}: ${error.message}`;
    throw new MorseSmoothError('LoadFailed', message, detail, { cause: error });
  }
}

async function compile(code) {
  if (code instanceof WebAssembly.Module) return code;
  if (!isResponse(code)) return WebAssembly.compile(code);
  if (!code.ok) throw new Error(`the server answered ${code.status}`);
  // Streaming needs the right MIME type, which some static servers do not send.
  const typed = code.headers.get('content-type')?.startsWith('application/wasm');
  return typed ? WebAssembly.compileStreaming(code) : WebAssembly.compile(await code.arrayBuffer());
}

const isAddress = (value) => typeof value === 'string' || isA('URL', value) || isA('Request', value);
const isResponse = (value) => isA('Response', value);
const isCode = (value) => isA('ArrayBuffer', value) || ArrayBuffer.isView(value) || value instanceof WebAssembly.Module;

/** `instanceof` for a class that an environment may lack. */
function isA(name, value) {
  const constructor = globalThis[name];
  return typeof constructor === 'function' && value instanceof constructor;
}
