/** What the worker finds out about a field, as the parts that the page is sent. No state: session.ts knows what is due. */
import type { MorseComplex, PersistencePairs, TriMesh } from 'morse-smooth';
import { differenceOf, pathsOf, placed, rangeOf, segmentsOf } from './display';
import type { Placement } from './display';
import type { Pairs, Part, Settings, Side } from './protocol';
import { keptPairs } from './reading/pairs';

/** Distance of levels from their saddle, relative to the range: near enough to show its two sides, far enough to be two lines. */
const SADDLE_OFFSET = 0.002;

export function hierarchyPart(mesh: TriMesh, side: Side, values: Float64Array, { link }: Settings): Part {
  const { vertices, kinds, vanishesAt, delta, minima, maxima, saddles } = mesh.deltaHierarchy(values, { link });
  return {
    kind: 'hierarchy',
    side,
    // For the index sum, which is checked against the Euler characteristic.
    counts: mesh.criticalPoints(values).counts,
    hierarchy: {
      vertices: new Uint32Array(vertices),
      kinds: new Int8Array(kinds),
      vanishesAt: new Float64Array(vanishesAt),
      values: Float64Array.from(vertices, (vertex) => values[vertex]!),
      delta: new Float64Array(delta),
      minima: new Uint32Array(minima),
      maxima: new Uint32Array(maxima),
      saddles: new Uint32Array(saddles),
    },
  };
}

export function pairsPart(found: PersistencePairs, values: Float64Array): Part {
  const { essentialMinima, essentialSaddles, essentialMaxima } = found;
  const essential = Uint32Array.from([...essentialMinima, ...essentialSaddles, ...essentialMaxima]);
  const saddlesEnd = essentialMinima.length + essentialSaddles.length;
  const pairs: Pairs = {
    extrema: new Uint32Array(found.extrema),
    saddles: new Uint32Array(found.saddles),
    kinds: new Int8Array(found.kinds),
    birth: new Float64Array(found.birth),
    death: new Float64Array(found.death),
    persistence: new Float64Array(found.persistence),
    essential,
    essentialKinds: Int8Array.from(essential, (_, k) => (k < essentialMinima.length ? -1 : k < saddlesEnd ? 0 : 1)),
    essentialValues: Float64Array.from(essential, (vertex) => values[vertex]!),
  };
  return { kind: 'pairs', range: rangeOf(values), pairs };
}

/** In units of the field. */
export function thresholdOf(values: Float64Array, { persistence }: Settings): number {
  const [low, high] = rangeOf(values);
  return persistence * (high - low);
}

/** By a threshold, or by name where the user has decided otherwise about some pair. What has no partner always stays. */
export function keptExtrema(found: PersistencePairs, values: Float64Array, settings: Settings): number[] {
  const kept = keptPairs(found, thresholdOf(values, settings), settings.overrides);
  return [...found.essentialMinima, ...found.essentialMaxima, ...kept.map((k) => found.extrema[k]!)];
}

/**
 * Level sets of the field before, and the levels for the field after. The same levels serve both sides: lines that move are
 * then the field's doing and not the choice of levels.
 */
export function levelLines(
  mesh: TriMesh,
  values: Float64Array,
  found: PersistencePairs,
  placement: Placement,
  settings: Settings,
): Extract<Part, { kind: 'lines' }> {
  if (settings.levelPlaces === 'even')
    return linesPart(mesh, 'before', values, evenLevels(values, settings), placement);
  const kept = keptPairs(found, thresholdOf(values, settings), settings.overrides).slice(0, settings.levels);
  const saddles = [...new Set(kept.map((k) => found.saddles[k]!))];
  if (saddles.length === 0) return linesPart(mesh, 'before', values, [], placement);
  const lines = mesh.levelSets(values, { saddles, offset: SADDLE_OFFSET });
  const levels = [...new Set(lines.levels)].sort((a, b) => a - b);
  return { kind: 'lines', side: 'before', levels, segments: segmentsOf(lines, placement) };
}

export function linesPart(
  mesh: TriMesh,
  side: Side,
  values: Float64Array,
  levels: number[],
  placement: Placement,
): Extract<Part, { kind: 'lines' }> {
  return { kind: 'lines', side, levels, segments: segmentsOf(mesh.levelSets(values, levels), placement) };
}

/** Evenly spaced inside the range, ends left out. */
function evenLevels(values: Float64Array, { levels }: Settings): number[] {
  const [low, high] = rangeOf(values);
  if (!(high > low)) return [];
  return Array.from({ length: levels }, (_, k) => low + ((high - low) * (k + 1)) / (levels + 1));
}

/** `persistence`: pairs up to it, relative to the range, are left out. */
export function complexPart(
  mesh: TriMesh,
  side: Side,
  values: Float64Array,
  persistence: number,
  placement: Placement,
): Part {
  const complex: MorseComplex = mesh.morseComplex(values, { persistence, paths: 'merged' });
  return {
    kind: 'complex',
    side,
    descending: pathsOf(complex, -1, placement),
    ascending: pathsOf(complex, 1, placement),
  };
}

export function differencePart(before: Float64Array, after: Float64Array): Part {
  return { kind: 'difference', ...differenceOf(before, after) };
}

/** Whole lines take room: on a mesh of more vertices none are sent, and pairs are lit without the way between them. */
const MOST_VERTICES = 300_000;

export function arcsPart(mesh: TriMesh, values: Float64Array, placement: Placement): Part {
  const isTooLarge = mesh.vertexCount > MOST_VERTICES;
  const complex = isTooLarge ? null : mesh.morseComplex(values);
  return {
    kind: 'arcs',
    arcs: {
      points: placed(complex?.points ?? new Float64Array(0), placement),
      offsets: new Uint32Array(complex?.offsets ?? [0]),
      saddles: new Uint32Array(complex?.saddles ?? []),
      extrema: new Uint32Array(complex?.extrema ?? []),
      kinds: new Int8Array(complex?.kinds ?? []),
      heights: Float64Array.from(complex?.saddles ?? [], (vertex) => values[vertex]!),
    },
  };
}
