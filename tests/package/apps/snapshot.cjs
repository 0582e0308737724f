const sizes = require('./compiled.cjs');
const pictures = require('morse-smooth/snapshot');
const main = require('morse-smooth');
const imported = [...sizes];

Promise.all([import('./draw.js'), import('./use.js'), import('./names.js')]).then(
  ([{ draw }, { use }, { namesOf }]) => {
    const result = draw(pictures);
    const alone = [...sizes];
    use(main);
    console.log(JSON.stringify({ ...result, keys: namesOf(pictures), imported, alone, both: sizes }));
  },
);
