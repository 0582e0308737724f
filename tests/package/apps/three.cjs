const main = require('morse-smooth');
const api = require('morse-smooth/three');
const THREE = require('three');

import('./surface.js').then(({ surface }) => console.log(JSON.stringify(surface(THREE, api, main))));
