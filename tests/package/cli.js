// The command `morse-smooth` as its users run it: installed, as a process.
import { spawn, spawnSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { inject } from 'vitest';
import { readMesh, writeMesh } from 'morse-smooth/files';

const root = fileURLToPath(new URL('../..', import.meta.url));
const packages = join(inject('installed'), 'node_modules');
/** Where npm puts the commands of packages. */
export const commands = join(packages, '.bin');
const script = join(packages, 'morse-smooth', 'dist', 'cli.mjs');

/** A folder with the files that the examples name, in which commands run. */
export function workplace() {
  const folder = mkdtempSync(join(tmpdir(), 'morse-smooth-cli-'));
  const at = (...parts) => join(folder, ...parts);
  const examples = { torus: 'torus_irregular', terrain: 'jacksboro_dem' };
  for (const [name, example] of Object.entries(examples)) {
    copyFileSync(join(root, 'www', 'public', 'examples', `${example}.ply`), at(`${name}.ply`));
  }
  const torus = readMesh(readFileSync(at('torus.ply')));
  writeFileSync(at('shape.obj'), writeMesh(torus, { format: 'obj' }));
  writeFileSync(at('surface.vtk'), writeMesh(torus, { format: 'vtk', fields: torus.fields }));
  const rows = Array.from(torus.fields.noisy, (value, vertex) => `${vertex},${value}\n`);
  writeFileSync(at('heat.csv'), `id,T\n${rows.join('')}`);
  writeFileSync(at('noisy.txt'), Array.from(torus.fields.noisy).join('\n'));

  /** Runs the command with these words. `stdout` is text, but for `bytes`. */
  function run(words, { input = '', bytes = false } = {}) {
    const { status, stdout, stderr } = spawnSync(process.execPath, [script, ...words], {
      cwd: folder,
      input,
      maxBuffer: 2 ** 28,
    });
    return { status, stdout: bytes ? stdout : stdout.toString(), stderr: stderr.toString() };
  }

  return {
    at,
    torus,
    run,
    /** Runs a command that must succeed. */
    output(words, options) {
      const { status, stdout, stderr } = run(words, options);
      if (status !== 0) throw new Error(`morse-smooth ${words.join(' ')}: ${status}, ${stderr}`);
      return stdout;
    },
    json: (words, options) => JSON.parse(run([...words, '--json'], options).stdout),
    read: (name) => readMesh(readFileSync(at(name)), { fileName: name }),
    start: (words) => spawn(process.execPath, [script, ...words], { cwd: folder }),
    /** Runs a line of a shell that finds the command. */
    shell(line) {
      const PATH = [commands, dirname(process.execPath), process.env.PATH].join(delimiter);
      const env = { ...process.env, PATH };
      const { status, stdout, stderr } = spawnSync('sh', ['-c', line], { cwd: folder, env, encoding: 'utf8' });
      return { status, stdout, stderr };
    },
    remove: () => rmSync(folder, { recursive: true, force: true }),
  };
}
