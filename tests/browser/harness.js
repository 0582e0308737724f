// A page in Chromium, for tests: opened, watched, closed.
import { createReadStream, existsSync, mkdirSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const inRoot = (path) => fileURLToPath(new URL(`../../${path}`, import.meta.url));
const artifacts = inRoot('artifacts');

/**
 * Opens a page in a browser of its own: `{ page, problems, close }`. `problems` collects what goes wrong in the page: exceptions,
 * errors in the console, failed requests. WebGL works, drawn by the processor.
 */
export async function openPage(url, { width = 1280, height = 800 } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROME_PATH,
    args: ['--no-sandbox', '--enable-unsafe-swiftshader'],
  });
  const page = await browser.newPage({ viewport: { width, height } });
  const problems = [];
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  page.on(
    'response',
    (response) => response.status() >= 400 && problems.push(`${response.status()} ${response.url()}`),
  );
  await page.goto(url);
  return { page, problems, close: () => browser.close() };
}

/** Serves the built page: `{ url, close }`. */
export const servePage = () => serveFolder(inRoot('www/dist'));

/** Keeps a screenshot as artifacts/NAME.png; returns its path. */
export async function keepScreenshot(page, name) {
  mkdirSync(artifacts, { recursive: true });
  const path = join(artifacts, `${name}.png`);
  await page.screenshot({ path });
  return path;
}

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };

/** A static server for a folder, which knows few MIME types: `{ url, close }`. */
export async function serveFolder(folder, headers = {}) {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    const path = join(folder, normalize(pathname.endsWith('/') ? `${pathname}index.html` : pathname));
    if (!existsSync(path) || !statSync(path).isFile()) {
      // Browsers ask for an icon that nobody has.
      response.writeHead(path.endsWith('favicon.ico') ? 204 : 404).end();
      return;
    }
    response.writeHead(200, { ...headers, 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' });
    createReadStream(path).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const url = `http://127.0.0.1:${server.address().port}`;
  return { url, close: () => new Promise((resolve) => server.close(resolve).closeAllConnections()) };
}
