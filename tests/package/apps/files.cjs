// Alone, so that it can be seen what is read.
const fs = require('node:fs');

const { readFileSync } = fs;
const read = [];
fs.readFileSync = (path, ...rest) => {
  read.push(/[^\\/]*$/.exec(String(path))[0]);
  return readFileSync(path, ...rest);
};
const wasm = () => read.filter((name) => name.endsWith('.wasm'));

const files = require('morse-smooth/files');
const alone = wasm();
require('morse-smooth');

import('./read.js').then(({ read }) =>
  console.log(JSON.stringify({ ...read(files), keys: Object.keys(files).sort(), alone, both: wasm() })),
);
