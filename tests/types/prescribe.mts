// Compiled, never run: fields with prescribed extrema as a user asks for them, and what must not compile.
import { Smoother, TriMesh, smooth } from 'morse-smooth';
import type * as api from 'morse-smooth';

/** Compiles only where the two types are the same. */
function same<A, B>(_: [A] extends [B] ? ([B] extends [A] ? true : never) : never): void {}

const heat = new Float64Array(3);
const mesh = new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
const smoother = new Smoother(mesh);

// ------------------------------------------------------------------------------------------------------- which extrema
const sets: api.Extrema[] = [
  [0, 2],
  new Uint16Array(2),
  { minima: [0], maxima: new Uint32Array(1) },
  { from: 'persistence', threshold: 0.1 },
  { from: 'persistence', threshold: 3, thresholdIs: 'absolute', of: 'input' },
  { from: 'persistence', minima: 1, maxima: 2, of: 'smoothed' },
];
for (const extrema of sets) smoother.prescribe(heat, { epsilon: 0.1, extrema });
// @ts-expect-error both kinds are needed
smoother.prescribe(heat, { epsilon: 0.1, extrema: { minima: [0] } });
// @ts-expect-error numbers of extrema are for the rule
smoother.prescribe(heat, { epsilon: 0.1, extrema: { minima: 1, maxima: 2 } });
// @ts-expect-error vertices are not for the rule
smoother.prescribe(heat, { epsilon: 0.1, extrema: { from: 'persistence', minima: [1], maxima: [2] } });
// @ts-expect-error a rule needs its number
smoother.prescribe(heat, { epsilon: 0.1, extrema: { from: 'persistence' } });
// @ts-expect-error a threshold or numbers
smoother.prescribe(heat, { epsilon: 0.1, extrema: { from: 'persistence', threshold: 0.1, minima: 1, maxima: 1 } });
// @ts-expect-error clusters have no extrema
smoother.prescribe(heat, { epsilon: 0.1, extrema: { from: 'kMeans', clusters: 3 } });

// ------------------------------------------------------------------------------------------------------------- options
const options: api.PrescribeOptions = {
  epsilon: 'auto',
  metric: 'lumped',
  massScale: 'raw',
  missing: 'omit',
  extrema: { from: 'persistence', threshold: 0.1 },
  complete: true,
  values: 'keep',
  margin: 1e-5,
  prominence: 0.02,
  range: 'input',
  representatives: 3,
  again: true,
  preview: false,
};
smoother.prescribe([1, 2, 3], options);
smoother.prescribe(heat, { ...options, onProgress: ({ fraction }) => fraction < 0.5 });
smoother.prescribe(heat, { epsilon: { rule: 'discrepancy', noise: 0.1 }, preview: true });
smoother.prescribe(heat, { cutoffWavelength: 3, range: 'free' });
smoother.prescribe(heat, { epsilon: 1, constraints: [0, 1], weights: [1, 2], unconstrained: 'mean', values: 'free' });
smoother.prescribe(heat, { epsilon: 1, constraints: { from: 'persistence', threshold: 0.1 }, extrema: [0, 1] });
// @ts-expect-error ε has no default
smoother.prescribe(heat, { extrema: [0] });
// @ts-expect-error nor are there defaults for all
smoother.prescribe(heat);
// @ts-expect-error missing values are not filled in
smoother.prescribe(heat, { epsilon: 1, missing: 'fill' });
// @ts-expect-error several channels have no extrema in common
smoother.prescribe(heat, { epsilon: 1, channels: 3 });
// @ts-expect-error one or three
smoother.prescribe(heat, { epsilon: 1, representatives: 2 });
// @ts-expect-error least squares have their own metric
smoother.prescribe(heat, { epsilon: 1, constraints: [0], metric: 'mass' });
// @ts-expect-error weights are those of constraints
smoother.prescribe(heat, { epsilon: 1, weights: [1] });
// @ts-expect-error ε and a length say the same
smoother.prescribe(heat, { epsilon: 1, cutoffWavelength: 3 });
// @ts-expect-error a number
smoother.prescribe(heat, { epsilon: 1, prominence: 'high' });
// @ts-expect-error no such option
smoother.prescribe(heat, { epsilon: 1, extremes: [0] });
// @ts-expect-error it is for prescribed extrema
smoother.tikhonov(heat, { epsilon: 1, extrema: [0] });

// -------------------------------------------------------------------------------------------------------------- result
const result: api.Prescribed = smoother.prescribe(heat, { epsilon: 1 });
const asSmoothed: api.Smoothed = result;
const { minima, maxima, unavoidable, energy, unconstrainedEnergy, leastSlack, margin, gap, iterations, solves, route } =
  result;
same<
  [typeof minima, typeof maxima, typeof unavoidable],
  [Uint32Array<ArrayBuffer>, Uint32Array<ArrayBuffer>, Uint32Array<ArrayBuffer>]
>(true);
same<[typeof energy, typeof unconstrainedEnergy, typeof gap], [number, number, number]>(true);
same<[typeof leastSlack, typeof margin, typeof iterations, typeof solves], [number, number, number, number]>(true);
same<typeof route, 'interiorPoint' | 'dual' | 'preview'>(true);
// @ts-expect-error other methods tell nothing of it
smoother.tikhonov(heat, { epsilon: 1 }).minima;

// ------------------------------------------------------------------------------------------------------- the short way
const short: api.Prescribed = smooth(mesh, heat, { method: 'prescribe' });
smooth(mesh, heat, { method: 'prescribe', epsilon: 0.1, extrema: [0, 1], weights: 'uniform', values: 'keep' });
smooth(mesh, heat, { method: 'prescribe', operator: 'fem', cutoffWavelength: 2, preview: true });
smooth(mesh, heat, { method: 'prescribe', constraints: [0, 1], range: 'input', onProgress: () => {} });
// @ts-expect-error extrema are for that method
smooth(mesh, heat, { extrema: [0, 1] });
// @ts-expect-error a preview is for that method
smooth(mesh, heat, { method: 'tikhonov', preview: true });

export { asSmoothed, short };
