// Geometries of three.js as meshes, and the other way round.
import { TriMesh } from 'morse-smooth';
import { BufferAttribute, BufferGeometry } from 'three';
import { isRecord, toNumbers, toTriangles } from '../../runtime/convert.js';
import { MorseSmoothError, invalidArgument } from '../../runtime/error.js';
import { componentsOf, readable, unsupported } from './attributes.js';
import { optionsOf } from './options.js';

/** Single precision rounds to 6e-8 of a coordinate: what three.js makes of seams lies farther apart than nothing, and within this. */
const SEAM = { tolerance: 1e-6 };

/** What holds no triangles of its own, by the flags of objects. */
const NO_MESHES = {
  isLine: ['lines', 'it is drawn as lines'],
  isPoints: ['points', 'it is drawn as points'],
  isSprite: ['points', 'it is drawn as a point'],
  isBatchedMesh: ['several', 'it holds several geometries; take one of these'],
};
const LINES = ['EdgesGeometry', 'WireframeGeometry'];

export function arraysOf(source) {
  const geometry = geometryIn(source);
  const attribute = geometry.getAttribute('position');
  if (attribute === undefined) {
    throw unsupported('noPositions', 'the geometry has no attribute `position`; wait until it is filled');
  }
  readable(attribute, 'position');
  const { count, itemSize } = attribute;
  if (itemSize !== 3) {
    const message = `the attribute \`position\` has ${itemSize} components per vertex, but a mesh needs x, y and z`;
    throw unsupported('itemSize', message, { itemSize });
  }
  return { positions: componentsOf(attribute, 3), triangles: trianglesOf(geometry, count) };
}

export function meshOf(source, options) {
  const { weld = SEAM } = optionsOf('meshOf', options);
  const { positions, triangles } = arraysOf(source);
  const mesh = new TriMesh(positions, triangles, { weld });
  const vertexMap = mesh.vertexMap() ?? Uint32Array.from({ length: mesh.vertexCount }, (_, vertex) => vertex);
  return { mesh, vertexMap };
}

export function geometryOf(arrays) {
  if (!isRecord(arrays)) throw invalidArgument('arrays', 'an object with `positions` and `triangles`');
  const positions = toNumbers(arrays.positions, 'positions');
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(positions), 3));
  if (arrays.triangles !== null) {
    const triangles = toTriangles(arrays.triangles, Math.floor(positions.length / 3));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(triangles), 1));
  }
  geometry.computeVertexNormals();
  return geometry;
}

/** The geometry of an object, or the geometry itself, if it is one of triangles. */
function geometryIn(source) {
  const flag = Object.keys(NO_MESHES).find((name) => source?.[name]);
  if (flag) throw noTriangles(source.type, ...NO_MESHES[flag]);
  const geometry = source?.isMesh ? source.geometry : source;
  if (!geometry?.isBufferGeometry) throw invalidArgument('geometry', 'a BufferGeometry or a Mesh of three.js');
  const { type } = geometry;
  if (geometry.isLineSegmentsGeometry || LINES.includes(type)) throw noTriangles(type, ...NO_MESHES.isLine);
  if (geometry.isInstancedBufferGeometry) {
    throw noTriangles(type, 'instances', 'it is drawn as instances; take the geometry of one');
  }
  return geometry;
}

function noTriangles(type, reason, what) {
  return unsupported(reason, `this ${type} has no triangles of a surface: ${what}`, { type });
}

/** Of what is drawn three vertices for each triangle. */
function trianglesOf(geometry, vertexCount) {
  const { index, drawRange } = geometry;
  const all = index ? readable(index, 'index').array.subarray(0, index.count) : null;
  const from = Math.max(0, drawRange.start);
  const to = Math.min(all ? all.length : vertexCount, from + drawRange.count);
  const length = Math.max(0, to - from);
  if (length % 3 !== 0) {
    const message = `triangles have three vertices each, but the geometry has ${length}${all ? ' in its index' : ''}; if it is drawn as lines or points, it is no mesh`;
    throw new MorseSmoothError('TrianglesNotTriples', message, { length });
  }
  return all ? Uint32Array.from(all.subarray(from, to)) : Uint32Array.from({ length }, (_, corner) => from + corner);
}
