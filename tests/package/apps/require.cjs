const api = require('morse-smooth');

Promise.all([import('./use.js'), import('./names.js')]).then(([{ use }, { namesOf }]) =>
  console.log(JSON.stringify({ ...use(api), keys: namesOf(api) })),
);
