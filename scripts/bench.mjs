// npm run bench: every benchmark in benches/, one after another.
import { readdirSync } from 'node:fs';
import { heading, main } from './lib/log.mjs';
import { inRoot } from './lib/paths.mjs';
import { must } from './lib/run.mjs';
import { build } from './build.mjs';
import { setUp } from './setup.mjs';

await main(async () => {
  await setUp();
  await build();
  const names = readdirSync(inRoot('benches')).filter((name) => name.endsWith('.mjs'));
  for (const name of names.sort()) {
    heading(name);
    await must(process.execPath, [inRoot('benches', name)], `${name} failed.`, { show: true });
  }
});
