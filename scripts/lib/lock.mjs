// Keeps two runs from writing to the same place at once.
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';
import { Problem, say } from './log.mjs';

const PAUSE = 500;
/** No set-up takes that long: the process number in such a lock belongs to something else by now. */
const STALE_AFTER = 30 * 60_000;

/** Runs `work` while holding the lock file `path`; waits while another living process holds it. */
export async function withLock(path, work) {
  let told = false;
  while (!take(path)) {
    if (!told) say('another run is setting things up; waiting for it …');
    told = true;
    await sleep(PAUSE);
  }
  const release = () => rmSync(path, { force: true });
  process.once('exit', release);
  try {
    return await work();
  } finally {
    process.off('exit', release);
    release();
  }
}

function take(path) {
  try {
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(path, String(process.pid), { flag: 'wx' });
    return true;
  } catch (error) {
    if (error.code !== 'EEXIST') throw new Problem(`${dirname(path)} cannot be written to (${error.code}).`);
    if (isAbandoned(path)) rmSync(path, { force: true });
    return false;
  }
}

function isAbandoned(path) {
  try {
    if (Date.now() - statSync(path).mtimeMs > STALE_AFTER) return true;
    process.kill(Number(readFileSync(path, 'utf8')), 0);
    return false;
  } catch (error) {
    // ENOENT: released meanwhile. EPERM: another user's living process. ESRCH: gone.
    return error.code === 'ESRCH';
  }
}
