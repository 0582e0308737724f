// wasm-bindgen's glue between JavaScript and a WebAssembly module, made so that there can be several instances of the module.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Problem } from './log.mjs';
import { modules } from './modules.mjs';
import { pkg } from './paths.mjs';

/** How src/js imports the glue of a module: `import { createGlue } from 'glue:core'`. */
const GLUE = /^glue:(\w+)$/;
const MARK = '?factory';

/** Functions of the glue that `src/js/runtime/module.js` calls. */
const CALLED = { imports: '__wbg_get_imports', run: '__wbg_finalize_init' };
/** What loads the module, which `src/js/runtime/` does itself, and so what would fetch a file. */
const LEFT_OUT = ['initSync', '__wbg_init', '__wbg_init_once', '__wbg_init_promise', '__wbg_load'];

/**
 * A plugin for rolldown. The glue is a script with one instance in its variables; this makes it the body of a function `createGlue`,
 * each call of which returns the script's exports with an instance of their own: `imports()` for it, `run(instance, code)` once it is
 * made, and `abandon`. It takes the classes for text: where there are none the script would fail, and it must not when it is imported.
 */
export const glueFactory = {
  name: 'glue-factory',
  resolveId(id) {
    const key = GLUE.exec(id)?.[1];
    return key && key in modules ? join(pkg, key, `${modules[key].name}.js${MARK}`) : null;
  },
  load: {
    filter: { id: /\?factory$/ },
    handler(id) {
      const code = readFileSync(id.slice(0, -MARK.length), 'utf8');
      return factory(code, this.parse(code).body);
    },
  },
};

/** Turns the text of a script with these statements into that of a module which exports `createGlue`. */
function factory(code, statements) {
  const exported = Object.entries(CALLED).map(([name, local]) => `${name}: ${local}`);
  const names = statements.flatMap(({ id, declarations }) => [id, ...(declarations ?? []).map(({ id }) => id)]);
  const declared = names.filter(Boolean).map(({ name }) => name);
  const missing = ['wasm', ...Object.values(CALLED)].find((name) => !declared.includes(name));
  if (missing) throw unexpected(`has no \`${missing}\``);
  let body = '';
  let end = 0;
  for (const node of statements) {
    if (node.type === 'ImportDeclaration') throw unexpected('imports something');
    const { declaration, start } = node;
    const name = (node.id ?? declaration?.id ?? node.declarations?.[0].id)?.name;
    const isLeftOut = LEFT_OUT.includes(name);
    if (node.type !== 'ExportNamedDeclaration' && !isLeftOut) continue;
    body += code.slice(end, start);
    end = declaration && !isLeftOut ? declaration.start : node.end;
    if (declaration && !isLeftOut) exported.push(name);
  }
  body += code.slice(end);
  // What was cached of the instance's memory would keep it.
  const caches = declared.filter((name) => name.startsWith('cached') && /Memory\d*$/.test(name));
  return `export function createGlue({ TextDecoder, TextEncoder }) {
${body}
/** Lets go of an instance that is no longer to be trusted: objects that are collected later free nothing. */
function abandon() {
  wasm = new Proxy({}, { get: () => () => undefined });
  wasmModule = wasmInstance = undefined;
  ${caches.map((name) => `${name} = `).join('')}null;
}
return { ${exported.join(', ')}, abandon };
}
`;
}

const unexpected = (what) =>
  new Problem(`The glue of wasm-bindgen ${what}, which scripts/lib/glue.mjs does not expect.`);
