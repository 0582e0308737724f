// The package from `dist/`, and how large its instance's memory is.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import init from '../../dist/index.js';

/** Initialises the package and returns what tells the size of its memory, which is found as the module's export while that is loaded. */
export async function loadWithMemory() {
  const { instantiate } = WebAssembly;
  let memory;
  const Original = WebAssembly.Instance;
  WebAssembly.instantiate = async (...given) => {
    const result = await instantiate(...given);
    memory = (result.instance ?? result).exports.memory ?? memory;
    return result;
  };
  WebAssembly.Instance = new Proxy(Original, {
    construct(target, given) {
      const instance = new target(...given);
      memory = instance.exports.memory ?? memory;
      return instance;
    },
  });
  const wasm = readFileSync(fileURLToPath(new URL('../../dist/morse_smooth_bg.wasm', import.meta.url)));
  await init({ wasm });
  return () => memory.buffer.byteLength;
}
