// Runs the sections of `npm test`, all of them, and sums up.
import { existsSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { Problem, heading, say, seconds } from './log.mjs';
import { artifacts, inRoot } from './paths.mjs';
import { execute } from './run.mjs';

/**
 * Runs sections `{ name, needs?, run }` in their order. `run` returns `{ passed, failed }` or throws a problem, which counts as
 * one failure; a section whose `needs` failed is not run, which counts as one too.
 */
export async function runSections(sections) {
  const results = new Map();
  for (const { name, needs, run } of sections) {
    heading(name);
    const since = performance.now();
    const counts = results.get(needs)?.failed ? notRun(needs) : await attempt(run);
    results.set(name, { ...counts, time: seconds(since) });
  }
  return summarise(results);
}

function notRun(needs) {
  console.error(`not run, because "${needs}" failed`);
  return { passed: 0, failed: 1 };
}

async function attempt(run) {
  try {
    return await run();
  } catch (error) {
    console.error(error instanceof Problem ? error.message : error);
    return { passed: 0, failed: 1 };
  }
}

/** Prints a line for each section and the totals on the last line; returns the number of failures. */
function summarise(results) {
  heading('Summary');
  const total = { passed: 0, failed: 0 };
  for (const [name, { passed, failed, time }] of results) {
    total.passed += passed;
    total.failed += failed;
    const outcome = failed ? `FAILED ${failed}` : 'ok';
    console.log(`${outcome.padEnd(10)}${name.padEnd(44)}${String(passed).padStart(5)} passed ${time.padStart(9)}`);
  }
  console.log(`\n${total.passed} passed, ${total.failed} failed`);
  return total.failed;
}

/** Runs commands that have no tests to count: each is one. */
export async function runChecks(checks) {
  const counts = { passed: 0, failed: 0 };
  for (const { name, command, parameters } of checks) {
    const since = performance.now();
    const { code } = await execute(command, parameters, { show: true });
    counts[code === 0 ? 'passed' : 'failed']++;
    say(`${name}: ${code === 0 ? 'ok' : 'FAILED'} (${seconds(since)})`);
  }
  return counts;
}

/** Adds up the result lines of Rust's test runner in a command's output. */
export function rustResults({ code, output }) {
  const plain = output.replace(/\x1b\[[0-9;]*m/g, '');
  const results = [...plain.matchAll(/^test result: .*? (\d+) passed; (\d+) failed/gm)];
  const sum = (group) => results.reduce((total, match) => total + Number(match[group]), 0);
  // A failure to compile has no result line.
  return { passed: sum(1), failed: code === 0 ? 0 : Math.max(1, sum(2)) };
}

/** Runs one of the projects of vitest.config.js. */
export async function runVitest(project, env) {
  const report = join(artifacts, `vitest-${project}.json`);
  rmSync(report, { force: true });
  const { code } = await execute(
    process.execPath,
    [inRoot('node_modules', 'vitest', 'vitest.mjs'), 'run', '--project', project].concat([
      '--reporter=default',
      '--reporter=json',
      `--outputFile.json=${report}`,
    ]),
    { show: true, env },
  );
  const { numPassedTests = 0, numFailedTests = 0 } = existsSync(report) ? JSON.parse(readFileSync(report, 'utf8')) : {};
  return { passed: numPassedTests, failed: code === 0 ? 0 : Math.max(1, numFailedTests) };
}
