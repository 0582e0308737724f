// The entry `morse-smooth/three`. It imports three.js and the main entry by their names, so that there is one of each.
export * from '../api/three/index.js';
