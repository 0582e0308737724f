import { MorseSmoothError, invalidArgument, invalidOption } from './error.js';

const SOURCES = 'a URL, string, Request, Response, BufferSource or WebAssembly.Module';

/**
 * The `init` of a module's entries, `(options, address, embedded)`: loads it once, from `options.wasm`, or else from what `address`
 * returns, or else from what `embedded` imports; either of these may be null. After a failure it can be called again, and so it can
 * where the instance was lost; the code is at hand then.
 */
export function loaderOf(module) {
  let loading = null;
  let isDone = false;
  // Not an async function: later calls return the very same promise.
  return (options, address, embedded) => {
    let source;
    try {
      source = sourceOf(options) ?? module.code ?? undefined;
    } catch (error) {
      return Promise.reject(error);
    }
    if (isDone && module.isLost) loading = null;
    if (loading === null) {
      isDone = false;
      const started = source === undefined ? startItself(module, address, embedded) : start(module, source);
      loading = started.then(
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

/** Starts a module from its file or, where that cannot be had, from the copy in a script. */
async function startItself(module, address, embedded) {
  let failure = null;
  try {
    if (address) return await start(module, address());
  } catch (error) {
    failure = error instanceof MorseSmoothError ? error : loadFailed(module, {}, error);
    if (!embedded) throw failure;
  }
  try {
    await start(module, await unpacked((await embedded()).packed));
  } catch (error) {
    failure ??= loadFailed(module, {}, error);
    failure.message += `; nor could the copy in a script: ${error.message}`;
    throw failure;
  }
  if (failure) console.warn(`morse-smooth: ${failure.message}. The copy in a script, which is larger, does instead.`);
}

async function start(module, source) {
  const detail = {};
  try {
    if (isAddress(source)) detail.url = String(source.url ?? source);
    const code = isAddress(source) ? await fetched(source) : source;
    if (isResponse(code)) {
      if (code.url) detail.url = code.url;
      detail.status = code.status;
    }
    await module.start(await compiled(code));
  } catch (error) {
    throw loadFailed(module, detail, error);
  }
}

function loadFailed({ entry }, detail, error) {
  const from = detail.url ? ` from ${detail.url}` : '';
  const message = `the WebAssembly module of ${entry} could not be loaded${from}: ${error.message}`;
  return new MorseSmoothError('LoadFailed', message, detail, { cause: error });
}

async function fetched(address) {
  try {
    return await fetch(address);
  } catch (cause) {
    const why = 'there was no answer, or the page may not read it (CORS, content security policy)';
    throw new Error(`${why}: ${cause.message}`, { cause });
  }
}

async function compiled(code) {
  if (code instanceof WebAssembly.Module) return code;
  let bytes = code;
  if (isResponse(code)) {
    if (!code.ok) {
      const why = code.status === 404 ? ' (no such file: a bundler, say, moved the script and not the file)' : '';
      throw new Error(`the server answered ${code.status}${why}`);
    }
    // Streaming needs the right MIME type, which some static servers do not send.
    const typed = code.headers.get('content-type')?.startsWith('application/wasm');
    if (typed) return WebAssembly.compileStreaming(code).catch(refused);
    bytes = await code.arrayBuffer();
  }
  const start = String.fromCharCode(
    ...new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset, Math.min(bytes.byteLength, 4)),
  );
  if (start !== '\0asm') {
    const isPage = start.trimStart().startsWith('<');
    throw new Error(
      isPage ? 'what came is a web page: some servers answer so where there is no file' : 'that is no WebAssembly',
    );
  }
  return WebAssembly.compile(bytes).catch(refused);
}

/** Says what to do where pages may not run WebAssembly. */
function refused(error) {
  const isPolicy = /unsafe-eval|Content.Security/i.test(error.message);
  const why = "the content security policy forbids WebAssembly; `script-src` needs 'wasm-unsafe-eval'";
  throw isPolicy ? new Error(`${why}: ${error.message}`, { cause: error }) : error;
}

/** The code from its text in a script. */
async function unpacked(packed) {
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

const isAddress = (value) => typeof value === 'string' || isA('URL', value) || isA('Request', value);
const isResponse = (value) => isA('Response', value);
const isCode = (value) => isA('ArrayBuffer', value) || ArrayBuffer.isView(value) || value instanceof WebAssembly.Module;

/** `instanceof` for a class that an environment may lack. */
function isA(name, value) {
  const constructor = globalThis[name];
  return typeof constructor === 'function' && value instanceof constructor;
}
