const sizes = require('./compiled.cjs');
const files = require('morse-smooth/files');
const main = require('morse-smooth');
const imported = [...sizes];

Promise.all([import('./read.js'), import('./use.js'), import('./names.js')]).then(
  ([{ read }, { use }, { namesOf }]) => {
    const result = read(files);
    const alone = [...sizes];
    use(main);
    console.log(JSON.stringify({ ...result, keys: namesOf(files), imported, alone, both: sizes }));
  },
);
