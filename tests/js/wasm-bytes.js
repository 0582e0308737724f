// The bytes of the package's WebAssembly modules, and copies of them with a fault.

const inNode = typeof process === 'object' && process.versions?.node !== undefined;

/** The bytes of the module in a file of the package. */
export async function wasmBytes(name = 'morse_smooth_bg.wasm') {
  if (inNode) {
    const { readFile } = await import('node:fs/promises');
    return new Uint8Array(await readFile(new URL(`../../dist/${name}`, import.meta.url)));
  }
  const urls = {
    'morse_smooth_bg.wasm': () => import('morse-smooth/morse_smooth_bg.wasm?url'),
    'morse_smooth_files_bg.wasm': () => import('morse-smooth/morse_smooth_files_bg.wasm?url'),
    'morse_smooth_snapshot_bg.wasm': () => import('morse-smooth/morse_smooth_snapshot_bg.wasm?url'),
  };
  const { default: url } = await urls[name]();
  return new Uint8Array(await (await fetch(url)).arrayBuffer());
}

const [IMPORTS, MEMORY, EXPORTS, CODE] = [2, 5, 7, 10];

/** A number in LEB128 and the place behind it. */
function leb(bytes, at) {
  let [value, shift] = [0, 0];
  for (;;) {
    const byte = bytes[at++];
    value += (byte & 127) * 2 ** shift;
    if (byte < 128) return [value, at];
    shift += 7;
  }
}

function toLeb(value) {
  const bytes = [];
  for (; value > 127; value = Math.floor(value / 128)) bytes.push((value % 128) + 128);
  return [...bytes, value];
}

/** The sections of a module: their kinds, and where the contents begin and end. */
function sections(bytes) {
  const found = [];
  for (let at = 8; at < bytes.length;) {
    const [size, from] = leb(bytes, at + 1);
    found.push({ kind: bytes[at], start: at, from, to: from + size });
    at = from + size;
  }
  return found;
}

/** The module with a memory that cannot grow beyond so many pages of 64 KiB. */
export function withPages(bytes, most) {
  const { start, from, to } = sections(bytes).find(({ kind }) => kind === MEMORY);
  // One memory; a flag that says whether there is a maximum; the minimum.
  const [least] = leb(bytes, from + 2);
  if (bytes[from] !== 1 || least > most) throw new Error('another kind of memory');
  const content = [1, 1, ...toLeb(least), ...toLeb(most)];
  return Uint8Array.from([
    ...bytes.subarray(0, start),
    MEMORY,
    ...toLeb(content.length),
    ...content,
    ...bytes.subarray(to),
  ]);
}

/** The module with an exported function that does nothing but trap. */
export function withTrap(bytes, name) {
  const all = sections(bytes);
  const imports = all.find(({ kind }) => kind === IMPORTS);
  const index = exportedFunction(bytes, all, name) - (imports ? importedFunctions(bytes, imports) : 0);
  const code = all.find(({ kind }) => kind === CODE);
  let [, at] = leb(bytes, code.from);
  for (let k = 0; k < index; k++) {
    const [size, body] = leb(bytes, at);
    at = body + size;
  }
  const [size, body] = leb(bytes, at);
  const copy = bytes.slice();
  // No variables; `unreachable`, `nop` as long as the body is, `end`.
  copy.fill(1, body, body + size);
  copy.set([0, 0], body);
  copy[body + size - 1] = 11;
  return copy;
}

function exportedFunction(bytes, all, wanted) {
  const { from } = all.find(({ kind }) => kind === EXPORTS);
  let [count, at] = leb(bytes, from);
  for (; count > 0; count--) {
    const [length, text] = leb(bytes, at);
    const name = new TextDecoder().decode(bytes.subarray(text, text + length));
    const kind = bytes[text + length];
    const [index, next] = leb(bytes, text + length + 1);
    if (kind === 0 && name === wanted) return index;
    at = next;
  }
  throw new Error(`nothing called ${wanted} is exported`);
}

function importedFunctions(bytes, { from }) {
  let functions = 0;
  let [count, at] = leb(bytes, from);
  for (; count > 0; count--) {
    for (let text = 0; text < 2; text++) {
      const [length, next] = leb(bytes, at);
      at = next + length;
    }
    const kind = bytes[at++];
    if (kind === 0) {
      functions++;
      [, at] = leb(bytes, at);
    } else if (kind === 1 || kind === 2) {
      const flag = bytes[kind === 1 ? ++at : at];
      [, at] = leb(bytes, at + 1);
      if (flag & 1) [, at] = leb(bytes, at);
    } else at += 2;
  }
  return functions;
}
