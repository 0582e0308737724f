// A Chromium to test in: one that is installed, else Playwright's, else the system's package.
import { existsSync } from 'node:fs';
import { delimiter, join } from 'node:path';
import { step } from './log.mjs';
import { environment, executable, inRoot } from './paths.mjs';
import { ask, execute } from './run.mjs';

const NAMES = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'chrome', 'microsoft-edge'];
const PLACES = [
  '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
  '/Applications/Chromium.app/Contents/MacOS/Chromium',
  ...[process.env.PROGRAMFILES, process.env['PROGRAMFILES(X86)'], process.env.LOCALAPPDATA]
    .filter(Boolean)
    .map((folder) => join(folder, 'Google', 'Chrome', 'Application', 'chrome.exe')),
];

/** Longest wait for Playwright's download, in seconds; apt is given as long as it needs. */
const DOWNLOAD_LIMIT = 300;

export const NO_BROWSER =
  'No Chrome or Chromium was found or could be installed. Install one (Debian: apt-get install chromium), or name it in CHROME_PATH.';

/** The path of a browser that starts, installing one where there is none; null where that fails. */
export async function findBrowser() {
  const installed = installedBrowser();
  if (installed) return installed;
  const { chromium } = await import('playwright-core');
  const downloaded = () => [chromium.executablePath()].find(works) ?? null;
  if (downloaded()) return downloaded();
  return step('no Chrome or Chromium here: fetching one for the tests (130 to 180 MB, once)', async () => {
    const cli = inRoot('node_modules', 'playwright-core', 'cli.js');
    await execute(process.execPath, [cli, 'install', '--no-shell', 'chromium'], { limit: DOWNLOAD_LIMIT });
    return downloaded() ?? (await debianPackage());
  });
}

function installedBrowser() {
  const folders = environment.PATH.split(delimiter);
  const named = NAMES.flatMap((name) => folders.map((folder) => join(folder, executable(name))));
  return [process.env.CHROME_PATH ?? '', ...named, ...PLACES].find(works) ?? null;
}

async function debianPackage() {
  if (process.getuid?.() !== 0 || !existsSync('/usr/bin/apt-get')) return null;
  const env = { DEBIAN_FRONTEND: 'noninteractive' };
  await execute('apt-get', ['update'], { env });
  await execute('apt-get', ['install', '--yes', '--no-install-recommends', 'chromium'], { env });
  return installedBrowser();
}

/** There, and with all the libraries it needs. (Windows' Chrome does not answer to --version.) */
function works(path) {
  return existsSync(path) && (process.platform === 'win32' || ask(path, '--version') !== null);
}
