// Alone, so that it can be seen what is read.
const fs = require('node:fs');

const { readFileSync } = fs;
const read = [];
fs.readFileSync = (path, ...rest) => {
  read.push(/[^\\/]*$/.exec(String(path))[0]);
  return readFileSync(path, ...rest);
};
const wasm = () => read.filter((name) => name.endsWith('.wasm'));

const pictures = require('morse-smooth/snapshot');
const alone = wasm();
require('morse-smooth');

import('./draw.js').then(({ draw }) =>
  console.log(JSON.stringify({ ...draw(pictures), keys: Object.keys(pictures).sort(), alone, both: wasm() })),
);
