// wasm-bindgen's glue between JavaScript and a WebAssembly module, made so that there can be several instances of the module.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Problem } from './log.mjs';
import { modules } from './modules.mjs';
import { pkg } from './paths.mjs';

/** How src/js imports the glue of a module: `import { createGlue } from 'glue:core'`. */
const GLUE = /^glue:(\w+)$/;
const MARK = '?factory';

/**
 * A plugin for rolldown. The glue is a script with one instance in its variables; this makes it the body of a function `createGlue`,
 * each call of which returns the script's exports with an instance of their own, and `abandon`.
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
  const exported = [];
  let body = '';
  let end = 0;
  const variables = [];
  for (const node of statements) {
    if (node.type === 'ImportDeclaration') throw unexpected('imports something');
    if (node.type === 'VariableDeclaration') variables.push(...node.declarations.map(({ id }) => id.name));
    if (node.type !== 'ExportNamedDeclaration') continue;
    const { declaration, specifiers } = node;
    body += code.slice(end, node.start);
    if (declaration) {
      exported.push(declaration.id.name);
      end = declaration.start;
    } else {
      exported.push(...specifiers.map(({ local, exported }) => `${exported.name}: ${local.name}`));
      end = node.end;
    }
  }
  body += code.slice(end);
  if (!variables.includes('wasm')) throw unexpected('has no variable `wasm`');
  // What was cached of the instance's memory would keep it.
  const caches = variables.filter((name) => name.startsWith('cached') && /Memory\d*$/.test(name));
  return `export function createGlue() {
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
