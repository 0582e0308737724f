// Geometries of three.js, as TypeScript users meet them.
import { BoxGeometry, BufferAttribute, BufferGeometry, Mesh, MeshBasicMaterial, Raycaster } from 'three';
import type { DataTexture, InstancedMesh, InterleavedBufferAttribute, LineSegments, Points } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { Smoother, TriMesh, smooth } from 'morse-smooth';
import * as api from 'morse-smooth/three';
import { snapshot } from 'morse-smooth/snapshot';
import { connect } from 'morse-smooth/worker';

/** Whether two types are the same. */
function same<A, B>(_: (<T>() => T extends A ? 1 : 2) extends <T>() => T extends B ? 1 : 2 ? true : false): void {}

const geometry = new BoxGeometry();
const object = new Mesh(geometry, new MeshBasicMaterial());

// The arrays of attributes are taken wherever there are arrays.
const attribute = new BufferAttribute(new Float32Array(9), 3);
const index = geometry.index!;
const bare = new TriMesh(attribute.array, index.array);
bare.criticalPoints(attribute.array);
bare.levelSets(attribute.array, attribute.array);
bare.simplify(attribute.array, { keep: index.array });
bare.constrainedVertices(attribute.array, index.array);
new Smoother(bare).tikhonov(attribute.array, { epsilon: 0.1 });
new Smoother(bare).interpolate(attribute.array, { constraints: index.array });
snapshot(attribute.array, index.array, attribute.array);
void (await connect()).createMesh(attribute.array, index.array, { transfer: true });

const arrays: api.GeometryArrays = api.arraysOf(geometry);
same<typeof arrays.positions, Float64Array<ArrayBuffer>>(true);
same<typeof arrays.triangles, Uint32Array<ArrayBuffer>>(true);
api.arraysOf(object);
// @ts-expect-error no geometry
api.arraysOf(attribute);
const { mesh, vertexMap } = api.meshOf(object, { weld: { tolerance: 1e-4 } });
api.meshOf(geometry, { weld: false });
// @ts-expect-error no such option
api.meshOf(geometry, { welded: true });
same<typeof mesh, TriMesh>(true);
const made: BufferGeometry = api.geometryOf(arrays);
api.geometryOf({ positions: attribute.array, triangles: null });

const values = smooth(mesh, attribute.array).values;
const field: BufferAttribute | InterleavedBufferAttribute = api.fieldAttribute(values, vertexMap);
made.setAttribute('field', api.fieldAttribute(values, null, { target: field }));
const { values: back, seams } = api.fieldValues(geometry.getAttribute('color'), vertexMap, {
  seams: 'mean',
  component: 1,
});
same<typeof back, Float64Array<ArrayBuffer>>(true);
same<typeof seams, Uint32Array<ArrayBuffer>>(true);
// @ts-expect-error one of two
api.fieldValues(attribute, vertexMap, { seams: 'first' });

made.setAttribute('color', api.colorAttribute(values, vertexMap, { colormap: 'magma', levels: { count: 5 } }));
made.setAttribute('uv', api.shadeAttribute(values, vertexMap, { range: [0, 1] }));
const map: DataTexture = api.colorTexture({ colormap: new Uint8Array(6), levels: [0.5], range: [0, 1], channel: 1 });
new MeshBasicMaterial({ map });
// @ts-expect-error no such map
api.colorTexture({ colormap: 'jet' });

const sets = mesh.levelSets(values, { count: 9 });
const wide: LineSegmentsGeometry = api.fillLines(new LineSegmentsGeometry(), sets, { colormap: 'viridis' });
new LineSegments2(wide, new LineMaterial({ linewidth: 2 }));
const thin: BufferGeometry = api.fillLines(new BufferGeometry(), mesh.morseComplex(values));
const lines: LineSegments = api.levelLines(sets, { color: 0xff0000 });
const positions: Float32Array = api.segmentsOf(sets).positions;
// @ts-expect-error no lines
api.levelLines({ points: positions });

const found = mesh.criticalPoints(values);
const balls: InstancedMesh = api.criticalMarkers(found, mesh.positions(), { radius: 0.1, geometry });
const points: Points = api.criticalPoints({ vertices: [1], kinds: [0] }, mesh.positions(), {
  colors: ['red', 0, '#00f'],
});
// @ts-expect-error three colors
api.criticalPoints(found, mesh.positions(), { colors: ['red'] });

const [hit] = new Raycaster().intersectObject(object);
if (hit) {
  const { vertex, weights, value }: api.Picked = api.pick(hit, vertexMap, values);
  void [vertex, weights, value];
}
void [thin, lines, balls, points];
