/** What the worker finds out about a field. No state: session.ts knows what is due. */
import type { LevelSets, PersistencePairs, TriMesh } from 'morse-smooth';
import { omitting } from './gaps';
import { rangeOf } from './measures';
import type { Arcs, Hierarchy, Pairs, Settings } from './protocol';
import { keptPairs } from './reading/pairs';

/** Distance of levels from their saddle, relative to the range: near enough to show its two sides, far enough to be two lines. */
const SADDLE_OFFSET = 0.002;

export function hierarchyOf(mesh: TriMesh, values: Float64Array, { link }: Settings): Hierarchy {
  const { vertices, kinds, vanishesAt, delta, minima, maxima, saddles } = mesh.deltaHierarchy(values, {
    link,
    ...omitting(values),
  });
  return {
    vertices: new Uint32Array(vertices),
    kinds: new Int8Array(kinds),
    vanishesAt: new Float64Array(vanishesAt),
    values: Float64Array.from(vertices, (vertex) => values[vertex]!),
    delta: new Float64Array(delta),
    minima: new Uint32Array(minima),
    maxima: new Uint32Array(maxima),
    saddles: new Uint32Array(saddles),
  };
}

export function pairsOf(found: PersistencePairs, values: Float64Array): Pairs {
  const { essentialMinima, essentialSaddles, essentialMaxima } = found;
  const essential = Uint32Array.from([...essentialMinima, ...essentialSaddles, ...essentialMaxima]);
  const saddlesEnd = essentialMinima.length + essentialSaddles.length;
  return {
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
 * Level sets of the field before, or how many to find. The same levels serve both sides: lines that move are then the field's doing
 * and not the choice of levels.
 */
export function levelsOf(
  mesh: TriMesh,
  values: Float64Array,
  found: PersistencePairs,
  settings: Settings,
): LevelSets | { count: number } {
  if (settings.levelPlaces === 'even') return { count: settings.levels };
  const kept = keptPairs(found, thresholdOf(values, settings), settings.overrides).slice(0, settings.levels);
  const saddles = [...new Set(kept.map((k) => found.saddles[k]!))];
  return saddles.length > 0
    ? mesh.levelSets(values, { saddles, offset: SADDLE_OFFSET, ...omitting(values) })
    : { count: 0 };
}

/** Whole lines take room: on a mesh of more vertices none are sent, and pairs are lit without the way between them. */
const MOST_VERTICES = 300_000;

export function arcsOf(mesh: TriMesh, values: Float64Array): Arcs {
  const isTooLarge = mesh.vertexCount > MOST_VERTICES;
  const complex = isTooLarge ? null : mesh.morseComplex(values, omitting(values));
  return {
    vertices: new Uint32Array(complex?.vertices ?? []),
    offsets: new Uint32Array(complex?.offsets ?? [0]),
    saddles: new Uint32Array(complex?.saddles ?? []),
    extrema: new Uint32Array(complex?.extrema ?? []),
    kinds: new Int8Array(complex?.kinds ?? []),
    heights: Float64Array.from(complex?.saddles ?? [], (vertex) => values[vertex]!),
  };
}
