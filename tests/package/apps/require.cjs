const api = require('morse-smooth');

import('./use.js').then(({ use }) => console.log(JSON.stringify({ ...use(api), keys: Object.keys(api).sort() })));
