// Whether a field has exactly some extrema, by classification; and fields with noise.
import { expect } from 'vitest';
import { random } from './meshes.js';
import { linkParts } from './truths.js';

/** A field with noise of that width on it. */
export function noise({ positions }, values, width, seed = 3) {
  const next = random(seed);
  return Float64Array.from({ length: positions.length / 3 }, (_, v) => values[v] + width * (next() - 0.5));
}

/** x scaled by what scales f to [0, 1]. */
export function scaled(x, f) {
  const least = Math.min(...f);
  const range = Math.max(...f) - least;
  return Array.from(x, (value) => (value - least) / range);
}

/** The extrema of a field by (value, number), ascending, by the parts of the links. */
export function kindsOf(shape, values) {
  const used = new Set(shape.triangles);
  const where = (down) => {
    const parts = linkParts(shape, values, down);
    return [...parts.keys()].filter((v) => parts[v] === 0 && used.has(v));
  };
  return { minima: where(true), maxima: where(false) };
}

/**
 * Expects a result with exactly these extrema, that says so, with as many saddles as a closed surface then has; but for a preview also after
 * rounding to single precision.
 */
export function expectExact(shape, result, { minima, maxima }, { isSurface = true } = {}) {
  expect([...result.minima]).toEqual(minima);
  expect([...result.maxima]).toEqual(maxima);
  expect(kindsOf(shape, result.values)).toEqual({ minima, maxima });
  const single = Float32Array.from(result.values);
  if (result.route !== 'preview') expect(kindsOf(shape, single)).toEqual({ minima, maxima });
  const { triangles } = shape;
  const edges = new Map();
  for (let t = 0; t < triangles.length; t += 3) {
    for (let i = 0; i < 3; i++) {
      const name = [triangles[t + i], triangles[t + ((i + 1) % 3)]].sort((a, b) => a - b).join();
      edges.set(name, (edges.get(name) ?? 0) + 1);
    }
  }
  const isClosed = [...edges.values()].every((count) => count === 2);
  if (!isClosed || !isSurface) return;
  const euler = new Set(triangles).size - edges.size + triangles.length / 3;
  expect(result.report.after.saddles).toBe(minima.length + maxima.length - euler);
}
