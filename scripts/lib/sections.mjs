// Runs the sections of `npm test`, all of them, and sums up.
import { existsSync, readFileSync, rmSync } from 'node:fs';
import { join, relative } from 'node:path';
import { Problem, heading, say, seconds } from './log.mjs';
import { artifacts, inRoot, root } from './paths.mjs';
import { execute } from './run.mjs';

/**
 * Runs sections `{ name, needs?, run }` in their order. `run` returns `{ passed, failed, failures? }`, the last being the names
 * of what failed, or throws a problem, which counts as one failure; a section whose `needs` failed is not run, which counts as
 * one too.
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

/**
 * Prints what failed, a line for each section and the totals on the last line: whoever has only the end of a long log sees what
 * to run again. Returns the number of failures.
 */
function summarise(results) {
  heading('Summary');
  const total = { passed: 0, failed: 0 };
  for (const { failures = [] } of results.values()) for (const failure of failures) console.log(`FAILED: ${failure}`);
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
  const counts = { passed: 0, failed: 0, failures: [] };
  for (const { name, command, parameters } of checks) {
    const since = performance.now();
    const { code } = await execute(command, parameters, { show: true });
    counts[code === 0 ? 'passed' : 'failed']++;
    if (code !== 0) counts.failures.push(name);
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
  const failures = [...plain.matchAll(/^test (.*) \.\.\. FAILED$/gm)].map((match) => match[1]);
  return { passed: sum(1), failed: code === 0 ? 0 : Math.max(1, sum(2)), failures };
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
  const outcome = existsSync(report) ? JSON.parse(readFileSync(report, 'utf8')) : {};
  const { numPassedTests = 0, numFailedTests = 0, testResults = [] } = outcome;
  return {
    passed: numPassedTests,
    failed: code === 0 ? 0 : Math.max(1, numFailedTests),
    failures: failed(testResults),
  };
}

/** The names of the tests that failed, by Vitest's report, each with the first line of why. */
function failed(testResults) {
  const why = (message = '') => message.replace(/\x1b\[[0-9;]*m/g, '').split('\n')[0];
  return testResults.flatMap(({ name, status, message, assertionResults }) => {
    const file = relative(root, name);
    const tests = assertionResults.filter((test) => test.status === 'failed');
    // A file that fails as a whole, as where its set-up does, has no failing test.
    if (tests.length === 0) return status === 'failed' ? [`${file}: ${why(message)}`] : [];
    return tests.map(({ fullName, failureMessages }) => `${file}: ${fullName}: ${why(failureMessages[0])}`);
  });
}
