// What users of three.js do: a geometry with seams becomes a mesh, its field colors, lines and signs, and a ray hits it. Returns what came out.
export function surface(THREE, api, { TriMesh, MorseSmoothError }) {
  const geometry = new THREE.SphereGeometry(1, 24, 12);
  const { mesh, vertexMap } = api.meshOf(geometry);
  const positions = mesh.positions();
  const heights = positions.filter((_, k) => k % 3 === 1);
  const lines = api.levelLines(mesh.levelSets(heights, [0.4]));
  const signs = api.criticalMarkers(mesh.criticalPoints(heights), positions);
  const object = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ map: api.colorTexture() }));
  geometry.setAttribute('uv', api.shadeAttribute(heights, vertexMap));
  const ray = new THREE.Raycaster(new THREE.Vector3(0.1, 0.2, 9), new THREE.Vector3(0, 0, -1));
  const [hit] = ray.intersectObject(object);
  let code = null;
  try {
    api.arraysOf(new THREE.Points(geometry));
  } catch (error) {
    code = error instanceof MorseSmoothError ? error.code : String(error);
  }
  return {
    vertices: mesh.vertexCount,
    isOurs: mesh instanceof TriMesh && lines instanceof THREE.LineSegments && signs instanceof THREE.InstancedMesh,
    euler: mesh.topology.eulerCharacteristic,
    segments: lines.geometry.attributes.position.count / 2,
    signs: signs.count,
    isNear: Math.abs(api.pick(hit, vertexMap, heights).value - hit.point.y) < 1e-6,
    code,
  };
}

/** What that is: 24 × 11 vertices and the two poles; heights along the axis, y, have one minimum and one maximum. */
export const truth = {
  vertices: 266,
  isOurs: true,
  euler: 2,
  segments: 48,
  signs: 2,
  isNear: true,
  code: 'UnsupportedGeometry',
};
