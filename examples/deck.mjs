// Layers of deck.gl for a field on a mesh. (npm install @deck.gl/core @deck.gl/layers @deck.gl/mesh-layers morse-smooth)
import { COORDINATE_SYSTEM } from '@deck.gl/core';
import { PathLayer } from '@deck.gl/layers';
import { SimpleMeshLayer } from '@deck.gl/mesh-layers';

const { CARTESIAN } = COORDINATE_SYSTEM;

/** The surface with the colors of a field. `scene` is a `Scene` of morse-smooth/snapshot, which has normals and color maps. */
export function surfaceLayer(scene, values, options) {
  const { positions, normals, triangles, center, scale } = scene.surface();
  const { shades, colors, gap } = scene.drawList(values, {
    levels: [],
    criticalPoints: false,
    missing: 'omit',
    ...options,
  });
  const last = colors.length / 3 - 1;
  const painted = new Float32Array(3 * shades.length);
  shades.forEach((shade, corner) => {
    const place = 3 * Math.round(last * Math.min(1, Math.max(0, shade)));
    const color = Number.isNaN(shade) ? [gap >> 16, (gap >> 8) & 255, gap & 255] : colors.subarray(place, place + 3);
    painted.set(
      [...color].map((part) => part / 255),
      3 * corner,
    );
  });
  const places = Float32Array.from(positions, (x, k) => x / scale + center[k % 3]);
  const attribute = (value) => ({ value, size: 3 });
  return new SimpleMeshLayer({
    id: 'surface',
    coordinateSystem: CARTESIAN,
    data: [{ position: [0, 0, 0] }],
    mesh: {
      attributes: { positions: attribute(places), normals: attribute(normals), colors: attribute(painted) },
      indices: { value: triangles, size: 1 },
    },
    getColor: [255, 255, 255],
  });
}

/** Level sets as paths. */
export function levelLayer({ points, offsets, closed, levels }) {
  const data = Array.from(levels, (level, line) => {
    const path = points.slice(3 * offsets[line], 3 * offsets[line + 1]);
    return { level, path: closed[line] ? [...path, ...path.subarray(0, 3)] : [...path] };
  });
  return new PathLayer({
    id: 'levels',
    coordinateSystem: CARTESIAN,
    data,
    getPath: ({ path }) => path,
    positionFormat: 'XYZ',
    getColor: [13, 19, 32],
    getWidth: 2,
    widthUnits: 'pixels',
  });
}
