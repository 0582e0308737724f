// Compiled, never run: the whole public API as a user writes it, and what must not compile.
import init, { MorseSmoothError, Smoother, TriMesh, smooth, version } from 'morse-smooth';
import type * as api from 'morse-smooth';
import initInline, { TriMesh as InlineTriMesh } from 'morse-smooth/inline';

/** Compiles only where the two types are the same. */
function same<A, B>(_: [A] extends [B] ? ([B] extends [A] ? true : never) : never): void {}

// ------------------------------------------------------------------------------------------------------------ loading
await init();
await init({});
await init({ wasm: '/wasm/morse_smooth_bg.wasm' });
await init({ wasm: new URL('https://example.org/morse_smooth_bg.wasm') });
await init({ wasm: new Request('/x.wasm') });
await init({ wasm: await fetch('/x.wasm') });
await init({ wasm: new Uint8Array(8) });
await init({ wasm: await WebAssembly.compile(new ArrayBuffer(8)) });
const done: Promise<void> = initInline();
// @ts-expect-error there is no such option
await init({ url: '/x.wasm' });
same<typeof version, string>(true);
same<typeof InlineTriMesh, typeof TriMesh>(true);

// --------------------------------------------------------------------------------------------------------------- mesh
const heat = new Float64Array(3);
const mesh = new TriMesh(new Float32Array(9), new Uint16Array(3), { weld: false });
new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0] as const, [0, 1, 2] as const);
new TriMesh(new Float64Array(9), new Uint32Array(3));
// @ts-expect-error strings are not numbers
new TriMesh(['0'], [0]);
// @ts-expect-error ids are not signed
new TriMesh([0, 0, 0], new BigInt64Array(3));
// @ts-expect-error big integers are not numbers
new TriMesh(new BigInt64Array(9), [0, 1, 2]);
// @ts-expect-error a mesh cannot be changed
mesh.area = 3;
// @ts-expect-error nor can its topology
mesh.topology.closed = true;

const { vertexCount, edgeCount, triangleCount, area, topology, warnings } = mesh;
same<[typeof vertexCount, typeof edgeCount, typeof triangleCount, typeof area], [number, number, number, number]>(true);
same<typeof warnings, api.Diagnostic[]>(true);
const genus: number | null = topology.genus;
// @ts-expect-error there may be none
const handles: number = topology.genus;
const { eulerCharacteristic, components, boundaryLoops, closed, orientable } = topology;
const { nonManifoldEdges, nonManifoldVertices, isolatedVertices, degenerateTriangles } = topology;
same<[typeof eulerCharacteristic, typeof closed], [number, boolean]>(true);
same<ReturnType<TriMesh['positions']>, Float64Array<ArrayBuffer>>(true);
same<ReturnType<TriMesh['triangles']>, Uint32Array<ArrayBuffer>>(true);

// -------------------------------------------------------------------------------------------------------- field analysis
const link: api.Link = 'skip';
const points: api.CriticalPoints = mesh.criticalPoints(heat, {
  delta: 0.1,
  deltaIs: 'absolute',
  link,
  rule: 'literal',
});
same<api.CriticalPoints['kinds'], Int8Array<ArrayBuffer>>(true);
const { vertices, kinds, multiplicities, onBoundary, counts } = points;
const { minima, maxima, saddles, indexSum } = counts;
same<typeof indexSum, number | null>(true);
// @ts-expect-error the option is called deltaIs
mesh.criticalPoints(heat, { delta: 0.1, thresholdIs: 'absolute' });
// @ts-expect-error one of two
mesh.criticalPoints(heat, { link: 'closed' });

const lines: api.LevelSets = mesh.levelSets([1, 2, 3], { count: 5 });
mesh.levelSets(new Float32Array(3), [0.5, 0.6]);
mesh.levelSets(heat, Float64Array.of(1));
const polylines: api.Polylines = lines;
const { points: coordinates, offsets, levels, closed: closedLines, edges, parameters } = lines;
// @ts-expect-error a number alone is neither levels nor a count
mesh.levelSets(heat, 5);
// @ts-expect-error levels have no default
mesh.levelSets(heat);

const saddleLevels: api.SaddleLevels = { saddles: true, offset: 0.01 };
mesh.levelSets(heat, saddleLevels);
mesh.levelSets(heat, { saddles: new Uint32Array(2) });
mesh.levelSets(heat, { saddles: [0, 7] as const });
// @ts-expect-error all of them, or these
mesh.levelSets(heat, { saddles: false });

const cut: api.Bands = mesh.bands(heat, { count: 5 });
mesh.bands(new Float32Array(3), [0.5]);
same<[typeof cut.bands, typeof cut.points], [Uint32Array<ArrayBuffer>, Float64Array<ArrayBuffer>]>(true);
const { triangles: parts, parents, levels: cuts, edges: cutEdges, parameters: cutParameters } = cut;
// @ts-expect-error bands are cut at levels
mesh.bands(heat, { saddles: true });

const hierarchy: api.DeltaHierarchy = mesh.deltaHierarchy(heat, { link });
mesh.deltaHierarchy([1, 2, 3]);
same<[typeof hierarchy.kinds, typeof hierarchy.vanishesAt], [Int8Array<ArrayBuffer>, Float64Array<ArrayBuffer>]>(true);
const { vanishesAtAbsolute, delta: steps, minima: minimaAt, maxima: maximaAt, saddles: saddlesAt } = hierarchy;
// @ts-expect-error it is about every δ
mesh.deltaHierarchy(heat, { delta: 0.1 });

const { sobolev, laplacianNorm }: api.Smoothness = mesh.smoothness(heat, { weights: 'meanValue' });
mesh.smoothness(heat, { missing: 'omit', onProgress: () => {} });
// @ts-expect-error only smoothing can fill
mesh.smoothness(heat, { missing: 'fill' });
mesh.constrainedVertices(heat, { from: 'kMeans', clusters: 3 }, { missing: 'fill', channels: 1 });
const matrix: api.SparseMatrix = mesh.laplacian({ weights: 'normalizedCotangent' });
const { rows, columns, columnPointers, rowIndices, values } = matrix;
const mass: api.SparseMatrix = mesh.mass({ kind: 'lumped', massScale: 'raw' });
mesh.laplacian({ weights: 'intrinsicDelaunay' });
// @ts-expect-error no such weights
mesh.laplacian({ weights: 'delaunay' });

// ------------------------------------------------------------------------------------- persistence and the Morse complex
const pairs: api.PersistencePairs = mesh.persistence([1, 2, 3]);
same<api.PersistencePairs['kinds'], Int8Array<ArrayBuffer>>(true);
const { extrema, birth, death, persistence, essentialMinima, essentialMaxima, essentialSaddles } = pairs;
same<
  [typeof birth, typeof extrema, typeof essentialSaddles],
  [Float64Array<ArrayBuffer>, Uint32Array<ArrayBuffer>, Uint32Array<ArrayBuffer>]
>(true);
const curve: api.PersistenceCurve = mesh.persistenceCurve(new Float32Array(3));
same<[typeof curve.threshold, typeof curve.minima], [Float64Array<ArrayBuffer>, Uint32Array<ArrayBuffer>]>(true);
// @ts-expect-error it has no options: the curve has every threshold
mesh.persistence(heat, { threshold: 0.1 });
// @ts-expect-error strings are not numbers
mesh.persistenceCurve(['1', '2', '3']);

const simple: { values: Float64Array; unavoidable: Uint32Array } = mesh.simplify(heat, { threshold: 0.1 });
mesh.simplify([1, 2, 3], { threshold: 3, thresholdIs: 'absolute' });
mesh.simplify(heat, { keep: extrema });
mesh.simplify(heat, { keep: new Uint16Array(2) });
mesh.simplify(heat, { keep: [0, 7] as const });
const toKeep: api.SimplifyOptions = { keep: essentialMinima };
// @ts-expect-error what to keep has no default
mesh.simplify(heat);
// @ts-expect-error nor has the threshold
mesh.simplify(heat, { thresholdIs: 'relative' });
// @ts-expect-error one of two
mesh.simplify(heat, { threshold: 0.1, thresholdIs: 'percent' });
// @ts-expect-error ids are not signed
mesh.simplify(heat, { keep: new BigInt64Array(2) });

const complex: api.MorseComplex = mesh.morseComplex(heat, { persistence: 0.1, paths: 'merged' });
const morsePolylines: api.Polylines = complex;
same<[typeof complex.kinds, typeof complex.vertices], [Int8Array<ArrayBuffer>, Uint32Array<ArrayBuffer>]>(true);
mesh.morseComplex(heat);
// @ts-expect-error one of two
mesh.morseComplex(heat, { paths: 'all' });
// @ts-expect-error the option is called persistence
mesh.morseComplex(heat, { threshold: 0.1 });

const morse: api.MorseHierarchy = mesh.morseHierarchy(heat);
const { cancelledAt, partners, into, arcs } = morse;
same<[typeof cancelledAt, typeof arcs], [Float64Array<ArrayBuffer>, Uint32Array<ArrayBuffer>]>(true);
// @ts-expect-error it has no options: the hierarchy has every threshold
mesh.morseHierarchy(heat, { persistence: 0.1 });

const basins: api.Basins = mesh.basins(heat, { persistence: 0.1 });
const { descending, ascending } = basins;
same<typeof descending, Uint32Array<ArrayBuffer>>(true);
mesh.basins(heat, {});
// @ts-expect-error only lines have paths
mesh.basins(heat, { paths: 'merged' });

// ---------------------------------------------------------------------------------------------------------- smoothing
const smoother = new Smoother(mesh, {
  weights: 'uniform',
  operator: 'paper',
  solver: 'cg',
  precision: 'double',
  onProgress: ({ phase, fraction }) => console.log(`${phase}: ${Math.round(100 * fraction)} %`),
});
const result: api.Smoothed = smoother.tikhonov(heat, {
  epsilon: 0.05,
  metric: 'lumped',
  massScale: 'raw',
  channels: 3,
});
const { report, reports } = result;
same<typeof reports, api.SmoothReport[]>(true);
const { method, equation, epsilon, constraintCount, before, after, lInfinity, l2, metricNorm } = report;
const { sobolevBefore, sobolevAfter, preserved, freeExtrema, perturbationFactor, solver } = report;
same<typeof method, 'tikhonov' | 'interpolate' | 'leastSquares' | 'lowPass' | 'bilateral' | 'prescribe'>(true);
const { route, precision, unknowns, factorNonzeros, relativeResidual, refinementSteps, iterations } = solver;
same<[typeof before, typeof epsilon, typeof relativeResidual], [api.CriticalCounts, number | null, number]>(true);
// @ts-expect-error ε has no default
smoother.tikhonov(heat, {});
// @ts-expect-error options are needed
smoother.tikhonov(heat);
// @ts-expect-error one of three
smoother.tikhonov(heat, { epsilon: 1, metric: 'euclidean' });
// @ts-expect-error two options for one number
smoother.tikhonov(heat, { cutoffWavelength: 1, epsilon: 1, metric: 'mass' });
// @ts-expect-error no such precision
new Smoother(mesh, { precision: 'half' });
new Smoother(mesh, { bounds: true, weights: 'intrinsicDelaunay' });
// @ts-expect-error true or false
new Smoother(mesh, { bounds: 'all' });
same<
  typeof route,
  'complexCholesky' | 'cholesky' | 'cgComplexCholesky' | 'cgCholesky' | 'cgMultigrid' | 'cgJacobi' | 'family' | 'none'
>(true);
same<typeof precision, 'double' | 'single' | 'doubleAfterSingle'>(true);

const operator: api.Operator = 'fem';
const single: api.Precision = 'single';
const length: api.WavelengthOptions = { cutoffWavelength: 2.5 };
const byLength: api.Smoothed = new Smoother(mesh, { operator, precision: single }).tikhonov(heat, length);
new Smoother(mesh, { operator: 'fem' }).tikhonov(heat, { cutoffWavelength: 1, channels: 3 });
smooth(mesh, heat, { operator: 'fem', cutoffWavelength: 1, precision: 'single' });
smooth(mesh, heat, { operator: 'fem', epsilon: 1 });
// @ts-expect-error only finite elements know lengths
smooth(mesh, heat, { cutoffWavelength: 1 });

const short: api.Smoothed = smooth(mesh, heat, {
  epsilon: 1,
  method: 'tikhonov',
  weights: 'cotangent',
  solver: 'cholesky',
});
smooth(mesh, heat, { epsilon: 'auto' });
smooth(mesh, heat);

// -------------------------------------------------------------------------------------------------------- constraints
const named: api.Constraints = new Uint32Array(3);
const rules: api.Constraints[] = [
  ...[[0, 7] as const, new Uint16Array(2), { from: 'vertices', vertices: [0, 7] as const, stars: false } as const],
  { from: 'criticalPoints' },
  { from: 'criticalPoints', delta: 0.1, deltaIs: 'absolute', link, stars: true },
  { from: 'persistence', threshold: 0.1, thresholdIs: 'absolute', stars: false },
  { from: 'kMeans', clusters: 7, seed: 3 },
];
const byPersistence: api.PersistenceConstraints = { from: 'persistence', threshold: 0.1 };
const byClusters: api.KMeansConstraints = { from: 'kMeans', clusters: 7 };
const byDelta: api.CriticalPointConstraints = { from: 'criticalPoints', link: 'skip' };
const byNumber: api.VertexConstraints = { from: 'vertices', vertices: named };
const constrained: Uint32Array = mesh.constrainedVertices(heat, byPersistence, { channels: 3 });
mesh.constrainedVertices([1, 2, 3], [0]);
// @ts-expect-error constraints have no default
mesh.constrainedVertices(heat);
// @ts-expect-error ids are not signed
mesh.constrainedVertices(heat, new BigInt64Array(2));
// @ts-expect-error a number alone is none
mesh.constrainedVertices(heat, 7);
// @ts-expect-error it must be said where they come from
mesh.constrainedVertices(heat, { threshold: 0.1 });
// @ts-expect-error no such rule
mesh.constrainedVertices(heat, { from: 'extrema' });
// @ts-expect-error the threshold has no default
mesh.constrainedVertices(heat, { from: 'persistence' });
// @ts-expect-error nor has the number of clusters
mesh.constrainedVertices(heat, { from: 'kMeans' });
// @ts-expect-error nor have vertices
mesh.constrainedVertices(heat, { from: 'vertices' });
// @ts-expect-error an option of another rule
mesh.constrainedVertices(heat, { from: 'kMeans', clusters: 7, delta: 0.1 });
// @ts-expect-error extrema of the literal rule grow with δ: only a comparison
mesh.constrainedVertices(heat, { from: 'criticalPoints', rule: 'literal' });
// @ts-expect-error the smoother's option, not the rule's
mesh.constrainedVertices(heat, byNumber, { unconstrained: 'keep' });

const interpolated: api.Smoothed = smoother.interpolate(heat, { constraints: byDelta });
smoother.interpolate(heat, { constraints: [0, 7], energy: 'biharmonic', unconstrained: 'mean', channels: 3 });
const toInterpolate: api.InterpolateOptions = { constraints: named, energy: 'harmonic', unconstrained: 'error' };
// @ts-expect-error constraints have no default
smoother.interpolate(heat, {});
// @ts-expect-error it has no ε
smoother.interpolate(heat, { constraints: [0], epsilon: 1 });
// @ts-expect-error one of two
smoother.interpolate(heat, { constraints: [0], energy: 'triharmonic' });
// @ts-expect-error one of three
smoother.interpolate(heat, { constraints: [0], unconstrained: 'zero' });

const fitted: api.Smoothed = smoother.leastSquares(heat, { constraints: byClusters, epsilon: 0.05 });
const toFit: api.LeastSquaresOptions = { constraints: [0, 7], epsilon: 1, weights: [1, 2] as const };
smoother.leastSquares(heat, { ...toFit, weights: new Float32Array(2), unconstrained: 'keep', channels: 2 });
// @ts-expect-error ε has no default
smoother.leastSquares(heat, { constraints: [0] });
// @ts-expect-error nor have constraints
smoother.leastSquares(heat, { epsilon: 1 });
// @ts-expect-error it has one energy
smoother.leastSquares(heat, { constraints: [0], epsilon: 1, energy: 'harmonic' });
// @ts-expect-error weights are numbers
smoother.leastSquares(heat, { constraints: [0], epsilon: 1, weights: 'cotangent' });

smooth(mesh, heat, { constraints: byPersistence, epsilon: 1, bounds: true });
smooth(mesh, heat, { method: 'leastSquares', constraints: [0], epsilon: 1, weights: 'uniform', channels: 3 });
smooth(mesh, heat, { method: 'interpolate', constraints: byNumber, energy: 'biharmonic', unconstrained: 'keep' });
const toSmooth: [api.SmoothByLeastSquaresOptions, api.SmoothByInterpolationOptions] = [
  { constraints: rules[0]!, epsilon: 1 },
  { method: 'interpolate', constraints: rules[1]! },
];
// @ts-expect-error Tikhonov smoothing has no constraints
smooth(mesh, heat, { method: 'tikhonov', constraints: [0], epsilon: 1 });
// @ts-expect-error interpolation must be asked for
smooth(mesh, heat, { constraints: [0], energy: 'harmonic' });
// @ts-expect-error weights of constraints are for `leastSquares` of a smoother
smooth(mesh, heat, { constraints: [0], epsilon: 1, weights: [1] });
smooth(mesh, heat, { method: 'leastSquares', constraints: [0] });
smooth(mesh, heat, { constraints: [0], epsilon: { rule: 'discrepancy' } });

const { constrainedCriticalPoints, maximumPrinciple } = interpolated.report;
same<typeof constrainedCriticalPoints | typeof preserved | typeof freeExtrema, number | null>(true);
same<typeof maximumPrinciple, api.MaximumPrinciple | null>(true);
const smallestWeight: number | undefined = maximumPrinciple?.smallestWeight;
const numberOfExtrema: number = maximumPrinciple!.extrema + maximumPrinciple!.meshExtrema;
// @ts-expect-error there may be none
const kept: number = interpolated.report.preserved;

// ------------------------------------------------------------------------------------------------------------ filters
const filtered: api.Smoothed = smoother.lowPass(heat, { iterations: 10 });
const taubin: api.LowPassOptions = { iterations: 10, lambda: 0.5, mu: -0.53, channels: 3 };
smoother.lowPass(heat, taubin);
// @ts-expect-error how often has no default
smoother.lowPass(heat, {});
// @ts-expect-error it has no ε
smoother.lowPass(heat, { iterations: 1, epsilon: 1 });
const toBlur: api.BilateralOptions = { iterations: 2, radius: 0.1, sigmaDistance: 0.05, sigmaValue: 1, channels: 2 };
const blurred: api.Smoothed = smoother.bilateral(heat, toBlur);
// @ts-expect-error the radius has no default
smoother.bilateral(heat, { iterations: 2, sigmaDistance: 0.05, sigmaValue: 1 });
// @ts-expect-error nor have the deviations
smoother.bilateral(heat, { iterations: 2, radius: 0.1 });
// @ts-expect-error `smooth` solves systems
smooth(mesh, heat, { method: 'lowPass', iterations: 2 });

// ------------------------------------------------------------------------------------------------------- end and errors
{
  using scoped = new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
  using scopedSmoother = new Smoother(scoped);
  void scopedSmoother;
}
smoother.free();
mesh.free();
try {
  mesh.positions();
} catch (error) {
  if (error instanceof MorseSmoothError) {
    const { code, detail, name, cause } = error;
    same<typeof code, string>(true);
    const vertex: unknown = detail.vertex;
    // @ts-expect-error what a detail holds must be looked at
    const id: number = detail.vertex;
    // @ts-expect-error a code does not change
    error.code = '';
    void [vertex, id, name, cause];
  }
}
const remade: Error = new MorseSmoothError('NonFiniteValue', 'the value at vertex 3 is not finite', { vertex: 3 });

export const used = [
  ...[done, genus, handles, components, boundaryLoops, orientable, nonManifoldEdges, nonManifoldVertices],
  ...[
    isolatedVertices,
    degenerateTriangles,
    vertices,
    kinds,
    multiplicities,
    onBoundary,
    minima,
    maxima,
    saddles,
    polylines,
  ],
  ...[
    coordinates,
    offsets,
    levels,
    closedLines,
    edges,
    parameters,
    sobolev,
    laplacianNorm,
    rows,
    columns,
    columnPointers,
  ],
  ...[rowIndices, values, mass, method, equation, constraintCount, after, lInfinity, l2, metricNorm, sobolevBefore],
  ...[
    sobolevAfter,
    preserved,
    freeExtrema,
    perturbationFactor,
    route,
    precision,
    unknowns,
    factorNonzeros,
    refinementSteps,
    iterations,
  ],
  ...[death, persistence, essentialMaxima, simple, toKeep, morsePolylines, partners, into, ascending],
  ...[short, byLength, remade],
  ...[constrained, toInterpolate, fitted, toSmooth, smallestWeight, numberOfExtrema, kept, filtered, blurred],
  ...[parts, parents, cuts, cutEdges, cutParameters, vanishesAtAbsolute, steps, minimaAt, maximaAt, saddlesAt],
];

// -------------------------------------------------------------------------------------- errors on their way to other threads
export const arrived: MorseSmoothError = MorseSmoothError.from(new MorseSmoothError('Code', 'message').toJSON());
MorseSmoothError.from({ code: 'Code', message: 'message' });
// @ts-expect-error an error has a code
MorseSmoothError.from({ message: 'message' });
