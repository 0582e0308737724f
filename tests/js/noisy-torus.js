// A small torus with a height and noise, for the tests of families.
import { TriMesh } from 'morse-smooth';
import { dot, heights, random, torus } from './meshes.js';

export const shape = torus(16, 9);
export const n = 16 * 9;
const next = random(11);
/** A height with noise. */
export const f = Float64Array.from(heights(shape), (height) => height + 0.6 * (next() - 0.5));
export const constraints = Array.from({ length: 24 }, (_, k) => 6 * k);
export const sample = [1e-6, 3e-4, 0.05, 1, 20, 1e4];
export const rules = ['auto', { rule: 'gcv' }, { rule: 'lCurve' }, { rule: 'discrepancy' }, { rule: 'discrepancy', noise: 0.2 }, { rule: 'atMostCriticalPoints', count: 6 }]; // prettier-ignore

export const make = () => new TriMesh(shape.positions, shape.triangles);
export const norm = (x) => Math.sqrt(dot(x, x));
const least = Math.min(...f);
const range = Math.max(...f) - least;
const scaled = (x) => Array.from(x, (value) => (value - least) / range);
/** ‖x − y‖/‖y‖ of the fields scaled by the range of f. */
export const distance = (x, y) => norm(scaled(x).map((value, i) => value - scaled(y)[i])) / norm(scaled(y));
export const geometric = (from, to, count) =>
  Array.from({ length: count }, (_, k) => from * (to / from) ** (k / (count - 1)));
