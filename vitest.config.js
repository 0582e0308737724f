// The same tests in Node and in Chromium (tests/js), the page (tests/browser), the installed package (tests/package).
import { playwright } from '@vitest/browser-playwright';
import { defineConfig } from 'vitest/config';

const MINUTE = 60_000;

/** `npm test` has found a browser and names it. */
const launchOptions = { executablePath: process.env.CHROME_PATH, args: ['--no-sandbox'] };

export default defineConfig({
  test: {
    maxWorkers: 2,
    testTimeout: MINUTE,
    hookTimeout: 5 * MINUTE,
    // The built files, as Node itself loads them.
    server: { deps: { external: [/\/dist\//] } },
    projects: [
      {
        extends: true,
        test: {
          name: 'node',
          include: ['tests/js/**/*.test.js'],
        },
      },
      {
        extends: true,
        test: {
          name: 'chromium',
          include: ['tests/js/**/*.test.js'],
          browser: {
            enabled: true,
            headless: true,
            screenshotFailures: false,
            provider: playwright({ launchOptions }),
            instances: [{ browser: 'chromium' }],
          },
        },
      },
      {
        extends: true,
        test: {
          name: 'page',
          include: ['tests/browser/**/*.test.{js,ts}'],
          // Without a graphics card, beside other work, a page takes seconds for what takes a moment elsewhere.
          testTimeout: 5 * MINUTE,
          fileParallelism: false,
        },
      },
      {
        extends: true,
        test: {
          name: 'package',
          include: ['tests/package/**/*.test.js'],
          globalSetup: 'tests/package/install.js',
          testTimeout: 5 * MINUTE,
          fileParallelism: false,
        },
      },
    ],
  },
});
