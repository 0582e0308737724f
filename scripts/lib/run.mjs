// Running other programs.
import { spawn, spawnSync } from 'node:child_process';
import { Problem } from './log.mjs';
import { environment, root } from './paths.mjs';

/** Kept of a program's output for a failure's message. */
const TAIL_LINES = 40;

/**
 * Runs a program to its end and returns `{ code, output }`, never failing.
 *
 * `show` passes its output on as it comes; `limit` is a time in seconds after which it is ended.
 */
export function execute(command, parameters, { show = false, limit = 0, env = {}, cwd = root } = {}) {
  return new Promise((resolve) => {
    const colors = show && process.stdout.isTTY ? { FORCE_COLOR: '1', CARGO_TERM_COLOR: 'always' } : {};
    const child = spawn(command, parameters, {
      cwd,
      env: { ...environment, ...colors, ...env },
      stdio: ['ignore', 'pipe', 'pipe'],
      timeout: limit * 1000,
      killSignal: 'SIGKILL',
    });
    const chunks = [];
    const collect = (stream, target) =>
      stream.on('data', (chunk) => {
        chunks.push(chunk);
        if (show) target.write(chunk);
      });
    collect(child.stdout, process.stdout);
    collect(child.stderr, process.stderr);
    const end = (code) => resolve({ code, output: Buffer.concat(chunks).toString() });
    child.on('error', (error) => {
      chunks.push(Buffer.from(error.message));
      end(127);
    });
    child.on('close', (code) => end(code ?? 1));
  });
}

/** Runs a program that must succeed; otherwise its last lines and `sentence` are the problem. */
export async function must(command, parameters, sentence, options) {
  const { code, output } = await execute(command, parameters, options);
  if (code === 0) return output;
  const tail = options?.show ? '' : `${output.trimEnd().split('\n').slice(-TAIL_LINES).join('\n')}\n\n`;
  throw new Problem(`${tail}${sentence}`);
}

/** What a program prints, or null where it is missing or fails: for asking after versions. */
export function ask(command, ...parameters) {
  const { status, stdout } = spawnSync(command, parameters, {
    cwd: root,
    env: environment,
    encoding: 'utf8',
    timeout: 30_000,
  });
  return status === 0 ? stdout.trim() : null;
}

/** npm as it was called, or the one on the PATH. */
export function npm(...parameters) {
  const script = process.env.npm_execpath;
  return script ? [process.execPath, [script, ...parameters]] : ['npm', parameters];
}

/** The first version number in a text, as numbers. */
export function versionIn(text) {
  return (/\d+(\.\d+)+/.exec(text ?? '')?.[0] ?? '0').split('.').map(Number);
}

/** Whether version `have` is at least `want`. */
export function atLeast(have, want) {
  const place = want.findIndex((part, index) => part !== (have[index] ?? 0));
  return place < 0 || (have[place] ?? 0) > want[place];
}
