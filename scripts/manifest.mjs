// node scripts/manifest.mjs: writes into package.json what follows from the table of modules.
import { readFileSync, writeFileSync } from 'node:fs';
import { manifest } from './lib/modules.mjs';
import { inRoot } from './lib/paths.mjs';

const path = inRoot('package.json');
const fields = Object.entries(JSON.parse(readFileSync(path, 'utf8'))).filter(([name]) => !(name in manifest()));
const place = 1 + fields.findIndex(([name]) => name === 'engines');
const all = [...fields.slice(0, place), ...Object.entries(manifest()), ...fields.slice(place)];
writeFileSync(path, `${JSON.stringify(Object.fromEntries(all), null, 2)}\n`);
