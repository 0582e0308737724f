// What the commands say while they work.

/** A failure that one sentence explains: printed without a stack trace. */
export class Problem extends Error {}

const bold = (text) => (process.stdout.isTTY ? `\x1b[1m${text}\x1b[0m` : text);

export function heading(text) {
  console.log(`\n${bold(`== ${text} ==`)}`);
}

export function say(text) {
  console.log(`- ${text}`);
}

export const seconds = (since) => `${((performance.now() - since) / 1000).toFixed(1)} s`;

/** Announces a piece of work, does it, and says how long it took. */
export async function step(text, work) {
  say(`${text} …`);
  const since = performance.now();
  const result = await work();
  say(`  done in ${seconds(since)}`);
  return result;
}

/** Runs a command's main function: a problem ends in its sentence, not in a stack trace. */
export async function main(work) {
  try {
    await work();
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    console.error(`\n${error.message}`);
    process.exitCode = 1;
  }
}
