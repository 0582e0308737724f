// One measurement in a process of its own, so that memory and compiled code of the one before are gone.
import { fork } from 'node:child_process';
import { fileURLToPath } from 'node:url';

/** Runs `lib/<task>.mjs` with the options, and returns its result, or `{ failure }`. */
export function inChild(task, options) {
  return new Promise((resolve) => {
    const child = fork(fileURLToPath(import.meta.url), [task, JSON.stringify(options)]);
    let result = { failure: 'it ended without a result' };
    child.on('message', (message) => (result = message));
    child.on('error', (error) => resolve({ failure: error.message }));
    child.on('close', () => resolve(result));
  });
}

if (process.send && process.argv[1] === fileURLToPath(import.meta.url)) {
  const [task, options] = process.argv.slice(2);
  try {
    const { run } = await import(`./${task}.mjs`);
    process.send(await run(JSON.parse(options)));
  } catch (error) {
    process.send({ failure: error.message });
  }
}
