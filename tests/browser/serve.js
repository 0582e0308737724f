// Serves a folder from this machine to itself, as any static host would: no special headers, no rewriting.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const TYPES = {
  '.css': 'text/css',
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/** `prefix`: the sub path that the folder is served under. */
export async function serve(folder, prefix = '/') {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    try {
      if (!pathname.startsWith(prefix)) throw new Error('outside');
      const inside = normalize(decodeURIComponent(pathname.slice(prefix.length)));
      if (inside.startsWith('..')) throw new Error('outside');
      const path = join(folder, pathname.endsWith('/') ? join(inside, 'index.html') : inside);
      const body = await readFile(path);
      response.writeHead(200, { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return {
    address: `http://127.0.0.1:${server.address().port}${prefix}`,
    close: () => new Promise((resolve) => server.close(resolve)),
  };
}
