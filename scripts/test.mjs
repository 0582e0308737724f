// npm test: everything, from formatting to the installed package. All sections run; the last line counts.
import { mkdirSync } from 'node:fs';
import { NO_BROWSER, findBrowser } from './lib/browser.mjs';
import { Problem, heading, main, say } from './lib/log.mjs';
import { artifacts, inRoot } from './lib/paths.mjs';
import { execute, must } from './lib/run.mjs';
import { rustResults, runChecks, runSections, runVitest } from './lib/sections.mjs';
import { runWasmPack } from './lib/wasm-pack.mjs';
import { build } from './build.mjs';
import { checkLinters, lints, typeChecks } from './lint.mjs';
import { setUp } from './setup.mjs';
import { checkSize } from './size.mjs';

const BUILD = 'Build of the package';
/** The modules whose bindings tests/bindings calls. */
const BINDINGS = 'wasm,wasm-files';
let browser = null;

const sections = [
  { name: 'Formatting and lints', run: () => runChecks(lints) },
  {
    name: 'Rust tests',
    run: async () => rustResults(await execute('cargo', ['test', '--locked', '--features', 'render'], { show: true })),
  },
  {
    name: 'Bindings, in Node',
    run: async () =>
      rustResults(
        await runWasmPack(['test', '--node', '--', '--features', BINDINGS, '--test', 'bindings'], { show: true }),
      ),
  },
  {
    name: BUILD,
    run: async () => {
      await build();
      return { passed: 1, failed: 0 };
    },
  },
  { name: 'Types', needs: BUILD, run: () => runChecks(typeChecks) },
  { name: 'JavaScript tests, in Node', needs: BUILD, run: () => runVitest('node') },
  { name: 'JavaScript tests, in Chromium', needs: BUILD, run: () => inBrowser('chromium') },
  {
    name: 'Page, in Chromium',
    needs: BUILD,
    run: async () => {
      const vite = inRoot('node_modules', 'vite', 'bin', 'vite.js');
      await must(process.execPath, [vite, 'build', inRoot('www')], 'The page does not build.', { show: true });
      return inBrowser('page');
    },
  },
  { name: 'Package: packed, installed, used', needs: BUILD, run: () => inBrowser('package') },
  { name: 'Download size', needs: BUILD, run: checkSize },
];

function inBrowser(project) {
  if (browser === null) throw new Problem(NO_BROWSER);
  return runVitest(project, { CHROME_PATH: browser });
}

await main(async () => {
  heading('Set-up');
  await setUp();
  checkLinters();
  browser = await findBrowser();
  say(`browser: ${browser ?? 'none'}`);
  mkdirSync(artifacts, { recursive: true });
  if ((await runSections(sections)) > 0) process.exitCode = 1;
});
