// What the tests need of browsers and servers.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { chromium } from 'playwright-core';

/**
 * Opens a page in a browser of its own: `{ page, problems, messages, close }`. `problems` collects what goes wrong in the page:
 * exceptions, errors in the console, failed requests; `messages` all that the console says. `options` are those of Playwright's pages.
 */
export async function openPage(url, options = {}) {
  const browser = await chromium.launch({ executablePath: process.env.CHROME_PATH, args: ['--no-sandbox'] });
  const page = await browser.newPage(options);
  const problems = [];
  const messages = [];
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('console', (message) => messages.push(message.text()));
  page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  page.on(
    'response',
    (response) => response.status() >= 400 && problems.push(`${response.status()} ${response.url()}`),
  );
  await page.goto(url);
  return { page, problems, messages, close: () => browser.close() };
}

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };

/**
 * A static server for a folder, which knows few MIME types: `{ url, close }`. What `answer(request, response)` says that it has answered
 * is left to it.
 */
export async function serveFolder(folder, headers = {}, answer = () => false) {
  const server = createServer((request, response) => {
    if (answer(request, response)) return;
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
