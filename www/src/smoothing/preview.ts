/** The worker's side of previews, which show another ε while the slider moves: what can be had in a frame's time. No state. */
import type { TriMesh } from 'morse-smooth';
import { omitting } from '../gaps';
import type { Field } from '../gaps';
import { rangeOf } from '../measures';
import type { Part, Settings } from '../protocol';

/** Up to so many vertices, a frame's time is enough for level sets and all the rest, too. */
const QUICK_VERTICES = 20_000;

export const isQuick = ({ vertexCount }: TriMesh): boolean => vertexCount <= QUICK_VERTICES;

/** Colors and critical points alone. `corners`: the vertex of each corner of the surface. `before`: the field that is smoothed. */
export function quickPart(
  mesh: TriMesh,
  values: Float64Array,
  corners: Uint32Array,
  before: Field,
  { delta, link }: Settings,
): Part {
  const { vertices, kinds, counts } = mesh.criticalPoints(values, {
    delta,
    link,
    ...(before.gaps > 0 ? omitting(values) : {}),
  });
  return {
    kind: 'preview',
    shades: shadesOf(values, corners, rangeOf(before.known)),
    vertices: new Uint32Array(vertices),
    kinds: new Int8Array(kinds),
    counts,
  };
}

/** As a draw list has them. */
function shadesOf(values: Float64Array, corners: Uint32Array, [low, high]: [number, number]): Float32Array {
  const shades = new Float32Array(corners.length);
  // A field of one value has the color in the middle.
  const [scale, shift] = high > low ? [1 / (high - low), 0] : [0, 0.5];
  for (let i = 0; i < corners.length; i++) shades[i] = (values[corners[i]!]! - low) * scale + shift;
  return shades;
}
