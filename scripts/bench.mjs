// npm run bench: every benchmark in benches/, one after another. `npm run bench -- solver --quick` runs one, with options.
import { readdirSync } from 'node:fs';
import { Problem, heading, main } from './lib/log.mjs';
import { inRoot } from './lib/paths.mjs';
import { must } from './lib/run.mjs';
import { build } from './build.mjs';
import { setUp } from './setup.mjs';

await main(async () => {
  const given = process.argv.slice(2);
  const wanted = given[0]?.startsWith('-') ? undefined : given.shift();
  const all = readdirSync(inRoot('benches'), { withFileTypes: true })
    .filter((entry) => entry.isFile() && entry.name.endsWith('.mjs'))
    .map(({ name }) => name.slice(0, -'.mjs'.length))
    .sort();
  if (wanted && !all.includes(wanted))
    throw new Problem(`There is no benchmark ${wanted}; there are ${all.join(', ')}.`);
  await setUp();
  await build();
  for (const name of all.filter((name) => !wanted || name === wanted)) {
    heading(name);
    const script = inRoot('benches', `${name}.mjs`);
    await must(process.execPath, [script, ...given], `${name} failed.`, { show: true });
  }
});
