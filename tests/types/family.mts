// Compiled, never run: families of all ε, and rules for ε, as a user writes them, and what must not compile.
import { Smoother, SmoothingFamily, TriMesh, smooth } from 'morse-smooth';
import type * as api from 'morse-smooth';
import { SmoothingFamily as InlineFamily } from 'morse-smooth/inline';

/** Compiles only where the two types are the same. */
function same<A, B>(_: [A] extends [B] ? ([B] extends [A] ? true : never) : never): void {}
same<typeof InlineFamily, typeof SmoothingFamily>(true);

const heat = new Float64Array(3);
const mesh = new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
const smoother = new Smoother(mesh);

// ----------------------------------------------------------------------------------------------------------- families
const family: SmoothingFamily = smoother.family(heat);
const options: api.FamilyOptions = {
  metric: 'identity',
  missing: 'fill',
  channels: 3,
  epsilonRange: [1e-3, 10],
  tolerance: 1e-4,
  epsilon: 0.1,
  factorizations: 3,
  onProgress: ({ fraction }) => fraction < 0.5,
};
smoother.family([1, 2, 3], options);
smoother.family(heat, { method: 'leastSquares', constraints: [0, 1], weights: [1, 2], unconstrained: 'keep' });
smoother.family(new Float32Array(3), { constraints: { from: 'persistence', threshold: 0.1 } });
// @ts-expect-error a smoother makes it
new SmoothingFamily();
// @ts-expect-error strings are not numbers
smoother.family(['1', '2', '3']);
// @ts-expect-error two numbers
smoother.family(heat, { epsilonRange: [1] });
// @ts-expect-error where a family begins is a number
smoother.family(heat, { epsilon: 'auto' });
// @ts-expect-error interpolation has no ε
smoother.family(heat, { method: 'interpolate', constraints: [0] });
// @ts-expect-error an option of curves
smoother.family(heat, { counts: true });

const { epsilonRange, dimension, factorizations, shifts, errorEstimate, complete } = family;
same<typeof epsilonRange, [number, number]>(true);
same<[typeof dimension, typeof factorizations, typeof errorEstimate], [number, number, number]>(true);
same<[typeof shifts, typeof complete], [Float64Array<ArrayBuffer>, boolean]>(true);
// @ts-expect-error it cannot be set
family.dimension = 3;
// @ts-expect-error nor can this
family.complete = true;

const estimate: number = family.errorAt(0.1);
const isComplete: boolean = family.grow({ onProgress: () => false });
const values: Float64Array = family.values(0.1);
const { report }: api.Smoothed = family.at(0.1, { onProgress: () => {} });
// @ts-expect-error ε has no default
family.values();
// @ts-expect-error a rule chooses first
family.at('auto');
// @ts-expect-error one factorisation at a time
family.grow({ factorizations: 2 });

// ------------------------------------------------------------------------------------------------------------- curves
const curves: api.Sweep = family.sweep({ epsilons: [0.1, 1] as const, counts: true, channel: 1 });
const direct: api.Sweep = smoother.sweep(heat, { ...options, epsilons: Float64Array.of(1), counts: true });
family.sweep();
smoother.sweep(heat);
same<[typeof curves.metricNorm, typeof curves.minima], [Float64Array<ArrayBuffer>, Uint32Array<ArrayBuffer>]>(true);
const { epsilons, lInfinity, laplacianNorm, sobolev, maxima, saddles, lCurveCorner } = curves;
const corner: number | undefined = epsilons[lCurveCorner];
// @ts-expect-error numbers, not one
family.sweep({ epsilons: 3 });
// @ts-expect-error the option is called counts
family.sweep({ count: true });

const lives: api.ExtremumLives = family.lives({ channel: 0, perDecade: 20 });
const { kinds, firstVertices, lastVertices, largestEpsilons, leastEpsilons } = lives;
same<
  [typeof kinds, typeof firstVertices, typeof leastEpsilons],
  [Int8Array<ArrayBuffer>, Uint32Array<ArrayBuffer>, Float64Array<ArrayBuffer>]
>(true);
// @ts-expect-error lives are followed along the whole range
family.lives({ epsilons: [1] });

// -------------------------------------------------------------------------------------------------------------- rules
const rules: api.EpsilonRule[] = [
  'auto',
  { rule: 'gcv' },
  { rule: 'lCurve' },
  { rule: 'discrepancy' },
  { rule: 'discrepancy', noise: 0.1 },
  { rule: 'atMostCriticalPoints', count: 10 },
];
for (const rule of rules) {
  const chosen: api.ChosenEpsilon = family.choose(rule, { onProgress: () => {} });
  const epsilon: api.Epsilon = rule;
  smoother.tikhonov(heat, { epsilon, metric: 'lumped' });
  smoother.leastSquares(heat, { epsilon, constraints: [0] });
  smooth(mesh, heat, { epsilon });
  smooth(mesh, heat, { epsilon, constraints: [0] });
  same<[typeof chosen.epsilon, typeof chosen.reason, typeof chosen.runnersUp], [number, string, number[]]>(true);
}
smooth(mesh, heat);
smooth(mesh, heat, { metric: 'identity' });
smooth(mesh, heat, { operator: 'fem' });
smooth(mesh, heat, { constraints: [0] });
const choice: api.ChosenEpsilon | null = report.choice;
// @ts-expect-error there may be none
const reason: string = report.choice.reason;
const noise: api.NoiseLevel | null | undefined = choice?.noise;
const level: number | undefined = noise?.standardDeviation;
// @ts-expect-error no such rule
family.choose({ rule: 'best' });
// @ts-expect-error rules but "auto" are objects
family.choose('gcv');
// @ts-expect-error how many has no default
family.choose({ rule: 'atMostCriticalPoints' });
// @ts-expect-error an option of another rule
family.choose({ rule: 'gcv', noise: 1 });
// @ts-expect-error a number is none
family.choose(3);
// @ts-expect-error only `smooth` chooses by itself
smoother.tikhonov(heat, {});
// @ts-expect-error neither does least squares
smoother.leastSquares(heat, { constraints: [0] });
// @ts-expect-error interpolation has no ε
smoother.interpolate(heat, { constraints: [0], epsilon: 'auto' });

{
  using scoped = smoother.family(heat);
  void scoped;
}
family.free();
const all = { estimate, isComplete, values, direct, lInfinity, laplacianNorm, sobolev, maxima, saddles, corner, level };
export { all, lastVertices, largestEpsilons, reason };
