// Where results go: a file, which is there completely or not at all, or the standard output.
import { accessSync, constants, realpathSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, extname, resolve } from 'node:path';
import { about, misuse } from './failures.js';

/** Values alone, which every program reads; the module of the files writes meshes. */
const TABLES = { csv: writeColumns, txt: writeNumbers };

export const tables = Object.keys(TABLES);

/** A mesh that everything can be tried with: whether a format has room for fields, say. */
const TRIANGLE = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: [0, 1, 2] };

/** Ends a command where whoever reads its output has gone away, as `head` does: that is no failure. */
export function endWithReader() {
  process.stdout.on('error', (error) => {
    // Whatever else it is, `write` tells.
    if (error.code === 'EPIPE') process.exit(0);
  });
  process.stderr.on('error', () => {});
}

/**
 * Writes to a file by way of another one beside it, or to the standard output (`-`). Devices and pipes are written to as they are.
 * While the file is written, an interruption waits.
 */
export async function write(path, content) {
  if (path === '-') {
    return new Promise((done, fail) => {
      const refuse = (error) => fail(Object.assign(error, { place: 'standard output' }));
      process.stdout.write(content, (error) => (error ? refuse(error) : done()));
    });
  }
  const target = about(path, () => whole(path));
  if (target.isOther) return about(path, () => writeFileSync(path, content));
  const temporary = `${target.path}.${process.pid}.tmp`;
  const held = hold();
  try {
    about(path, () => {
      writeFileSync(temporary, content, { flag: 'wx', ...(target.mode && { mode: target.mode }) });
      renameSync(temporary, target.path);
    });
  } finally {
    rmSync(temporary, { force: true });
    await held.release();
  }
}

/** The file that a path leads to, and what is there already. */
function whole(path) {
  const info = statSync(path, { throwIfNoEntry: false });
  if (info === undefined) return { path: resolve(path), isOther: false };
  return { path: realpathSync(path), isOther: !info.isFile() && !info.isDirectory(), mode: info.mode & 0o777 };
}

/** Says before the work whether its result can be written at all. */
export function checkPlace(path) {
  if (path === undefined || path === '-') return;
  about(path, () => {
    if (statSync(path, { throwIfNoEntry: false })?.isDirectory()) throw Object.assign(new Error(), { code: 'EISDIR' });
    accessSync(dirname(resolve(path)), constants.W_OK);
  });
}

/** Keeps Ctrl-C and the like from ending the process between two steps. */
function hold() {
  const codes = { SIGINT: 130, SIGTERM: 143 };
  let code = null;
  const listeners = Object.entries(codes).map(([signal, value]) => [signal, () => (code = value)]);
  for (const [signal, listener] of listeners) process.on(signal, listener);
  return {
    async release() {
      // What came meanwhile is told once the event loop has looked for it; a timer comes after that, an immediate may not.
      await new Promise((done) => setTimeout(done, 1));
      for (const [signal, listener] of listeners) process.off(signal, listener);
      if (code !== null) process.exit(code);
    },
  };
}

/** Where the mesh of a command goes, and in which format; nothing where it is not asked for. */
export async function targetOf({ output, to, binary = false }) {
  if (output === undefined && to === undefined) {
    if (binary) throw misuse('--binary goes with -o or --to');
    return null;
  }
  const path = output ?? '-';
  const { formats, writeMesh } = await import('morse-smooth/files');
  const writable = formats().filter(({ writes, name }) => writes && !(name in TABLES));
  const names = [...writable.map(({ name }) => name), ...Object.keys(TABLES)];
  const format = to ?? (path === '-' ? undefined : byEnding(path, writable));
  if (format === undefined)
    throw misuse('the standard output has no ending that tells the format', `name it by --to: ${names.join(', ')}`);
  if (!names.includes(format))
    throw misuse(`‘${format}’ is no format that can be written`, `there are ${names.join(', ')}`);
  checkPlace(output);
  const isTable = format in TABLES;
  if (isTable && binary) throw misuse(`--binary is not for ${format}, which is text`);
  const probe = (more) => writeMesh(TRIANGLE, { format, binary, ...more });
  // A terminal that is sent bytes stays in disorder.
  const isBinary = !isTable && probe().includes(0);
  if (isBinary && path === '-' && process.stdout.isTTY) {
    throw misuse('a binary file does not go to a terminal', 'name a file by -o');
  }
  const refuse = isTable ? null : problemOf(() => probe({ fields: { value: [0, 0, 0] } }));
  return {
    path,
    format,
    isTable,
    /** Why the format has no room for fields, or null. */
    refuse,
    write: (mesh, fields) => {
      if (isTable) return write(path, TABLES[format](fields));
      // What is missing stays so.
      const settings = { format, binary, missing: 'omit', ...(refuse ? {} : { fields }) };
      const { positions, triangles } = mesh;
      return write(
        path,
        about(path, () => writeMesh({ positions, triangles }, settings)),
      );
    },
  };
}

/** The format with the ending of a path. */
function byEnding(path, writable) {
  const ending = extname(path).slice(1).toLowerCase();
  if (ending in TABLES) return ending;
  const found = writable.find(({ extensions }) => extensions.includes(ending));
  if (found) return found.name;
  const names = writable.flatMap(({ extensions }) => extensions).concat(Object.keys(TABLES));
  const known = `endings that tell one are ${[...new Set(names)].join(', ')}`;
  throw misuse(
    ending
      ? `the ending ‘${ending}’ tells no format that can be written`
      : `${path} has no ending that tells the format`,
    known,
  );
}

function problemOf(action) {
  try {
    action();
    return null;
  } catch (error) {
    return error;
  }
}

/** Columns with their names above. */
function writeColumns(fields) {
  return tableText(Object.keys(fields), rowsOf(Object.values(fields)));
}

/** One field, a line for each value. */
function writeNumbers(fields) {
  const [values, ...others] = Object.values(fields);
  if (values === undefined) throw misuse('there is no field to write');
  if (others.length > 0)
    throw misuse(
      `txt holds one field, and there are ${Object.keys(fields).join(', ')}`,
      'name one by --field, or write csv',
    );
  return Array.from(values, (value) => `${cell(value)}\n`).join('');
}

function* rowsOf(columns) {
  for (let row = 0; row < (columns[0]?.length ?? 0); row++) yield columns.map((column) => column[row]);
}

/** A table as CSV. */
export function tableText(names, rows) {
  const lines = [names.map(quoted).join(',')];
  for (const row of rows) lines.push(row.map(cell).join(','));
  return `${lines.join('\n')}\n`;
}

const quoted = (text) => (/[",;\n\r\t]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const cell = (value) =>
  typeof value === 'number' ? (Number.isNaN(value) ? 'nan' : String(value)) : quoted(String(value));
