// A family of smoothed fields beside single calls, in a process of its own.
import { Smoother, TriMesh } from '../../dist/index.js';
import { Stopwatch, median } from './clock.mjs';
import { jitteredTorus, noisyField } from './jittered.mjs';
import { loadWithMemory } from './memory-size.mjs';

/** What a field is smoothed with: options of the smoother, and of the call. */
export const SYSTEMS = {
  mass: [{}, { metric: 'mass' }],
  identity: [{}, { metric: 'identity' }],
  fem: [{ operator: 'fem' }, {}],
};
/** The default range of ε, and where a slider begins. */
const RANGE = [1e-6, 1e4];
const FIRST = 1;
/** Single calls that a median is taken of, and the most families. */
export const CALLS = 5;
/** How many ε are compared with exact calls, over the range and over the three decades around the first. */
const COMPARED = 9;
const NEAR = 7;

const between = (from, to, count) => Array.from({ length: count }, (_, k) => from * (to / from) ** (k / (count - 1)));

export async function run({ system, size, clock, rounds }) {
  const memory = await loadWithMemory();
  const { positions, triangles } = jitteredTorus(size);
  const values = noisyField(positions);
  const mesh = new TriMesh(positions, triangles);
  const [settings, options] = SYSTEMS[system];
  const smoother = new Smoother(mesh, settings);
  smoother.tikhonov(values, { ...options, epsilon: FIRST });
  // Memory of WebAssembly never shrinks: its size is its peak.
  const facts = { vertices: mesh.vertexCount, peakOfCall: memory() };

  const watch = new Stopwatch(clock);
  let family;
  // Each ε differs from the one before, so that it is factorised anew. Calls and families take turns.
  for (let round = 0; round < CALLS; round++) {
    watch.time('call', () => smoother.tikhonov(values, { ...options, epsilon: 0.1 + 0.01 * round }));
    if (round >= rounds) continue;
    family?.free();
    watch.time('first', () => smoother.family(values, { ...options, factorizations: 1, epsilon: FIRST })).free();
    family = watch.time('family', () => smoother.family(values, options));
    facts.peakOfFamily ??= memory();
  }

  const exact = new Map();
  const exactly = (epsilon) => {
    if (!exact.has(epsilon)) exact.set(epsilon, smoother.tikhonov(values, { ...options, epsilon }));
    return exact.get(epsilon);
  };
  const early = smoother.family(values, { ...options, factorizations: 1, epsilon: FIRST });
  facts.firstErrors = between(FIRST / 10 ** 1.5, FIRST * 10 ** 1.5, NEAR).map((epsilon) => {
    return [epsilon, relativeError(early.values(epsilon), exactly(epsilon).values, values)];
  });
  facts.firstEstimate = Math.max(...facts.firstErrors.map(([epsilon]) => early.errorAt(epsilon)));
  early.free();

  for (const name of ['dimension', 'factorizations', 'errorEstimate', 'complete']) facts[name] = family[name];
  facts.errors = between(...RANGE, COMPARED).map((epsilon) => {
    const { values: expected, report } = exactly(epsilon);
    const found = family.at(epsilon);
    const equal = ['minima', 'maxima', 'saddles'].every((name) => found.report.after[name] === report.after[name]);
    return [epsilon, relativeError(found.values, expected, values), family.errorAt(epsilon), equal];
  });
  for (const epsilon of between(...RANGE, 21)) {
    const smoothed = watch.time('values', () => family.values(epsilon));
    watch.time('points', () => mesh.criticalPoints(smoothed));
    watch.time('at', () => family.at(epsilon));
  }
  facts.valuesAndPoints = median(watch.samples.values.map((seconds, k) => seconds + watch.samples.points[k]));
  watch.time('sweep', () => family.sweep({ epsilons: between(...RANGE, 200) }));
  for (const rule of [{ rule: 'gcv' }, { rule: 'lCurve' }, { rule: 'discrepancy' }]) {
    facts[`${rule.rule}/epsilon`] = watch.time(rule.rule, () => family.choose(rule)).epsilon;
  }
  const count = Math.ceil(mesh.vertexCount / 100);
  watch.time('atMostCriticalPoints', () => family.choose({ rule: 'atMostCriticalPoints', count }));
  family.free();
  return { samples: watch.samples, facts };
}

/** ‖x − y‖₂/‖y‖₂ of the fields scaled by what scales f to [0, 1]. */
function relativeError(x, y, f) {
  let low = Infinity;
  for (const value of f) low = Math.min(low, value);
  let [above, below] = [0, 0];
  for (let i = 0; i < x.length; i++) {
    above += (x[i] - y[i]) ** 2;
    below += (y[i] - low) ** 2;
  }
  return Math.sqrt(above / below);
}
