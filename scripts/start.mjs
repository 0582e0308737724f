// npm start: builds what is out of date and serves the page.
import { existsSync } from 'node:fs';
import { Problem, main } from './lib/log.mjs';
import { inRoot } from './lib/paths.mjs';
import { build } from './build.mjs';
import { setUp } from './setup.mjs';

const PORT = 5173;

await main(async () => {
  await setUp();
  await build();
  const page = inRoot('www');
  if (!existsSync(inRoot('www', 'index.html'))) throw new Problem(`There is no page in ${page}.`);

  const { createServer } = await import('vite');
  const interactive = process.stdout.isTTY && !process.env.CI && !process.env.NO_OPEN;
  // A port that is taken makes Vite try the next one.
  const server = await createServer({ root: page, server: { port: PORT, open: Boolean(interactive) } });
  await server.listen();
  for (const signal of ['SIGINT', 'SIGTERM']) {
    process.once(signal, async () => {
      await server.close();
      process.exit(0);
    });
  }
  console.log(`\n  http://localhost:${server.httpServer.address().port}/\n\n  Ctrl-C stops it.`);
});
