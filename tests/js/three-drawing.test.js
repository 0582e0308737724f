// What is drawn of fields with three.js. Colors are compared with those that the module of the pictures gives, places with planes.
import init from 'morse-smooth';
import initPictures, { Scene } from 'morse-smooth/snapshot';
import * as api from 'morse-smooth/three';
import * as three from 'three';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { beforeAll, describe, expect, it } from 'vitest';
import { expectError } from './errors.js';
import { square } from './meshes.js';

const { BoxGeometry, BufferGeometry, Color, Mesh, Raycaster, SphereGeometry, SRGBColorSpace, Vector3 } = three;
const { colorAttribute, colorTexture, shadeAttribute } = api;

beforeAll(() => Promise.all([init(), initPictures()]));

/** Red, green and blue, 0 to 255, as they are seen. */
const seen = (attribute, k) => {
  const { r, g, b } = new Color().fromBufferAttribute(attribute, k).getRGB({}, SRGBColorSpace);
  return [r, g, b].map((x) => 255 * x);
};
const near = (one, other, distance) => one.every((x, k) => Math.abs(x - other[k]) <= distance);

describe('colors', () => {
  const { positions, triangles } = square(9);
  const values = Float64Array.from({ length: 100 }, (_, k) => Math.sin(k));
  const maps = ['viridis', 'cividis', 'magma', 'inferno', 'plasma', 'coolWarm', 'blueRed', 'purpleGreen'];
  const range = [-0.7, 1.2];
  let scene;
  beforeAll(() => (scene = new Scene(positions, triangles)));

  it.each(maps)('are those of the pictures: %s', (colormap) => {
    const { colors, shades } = scene.drawList(values, { colormap, range });
    const found = colorAttribute(values, null, { colormap, range });
    scene.surface().vertices.forEach((vertex, corner) => {
      const place = 3 * Math.round(511 * Math.min(1, Math.max(0, shades[corner])));
      // A step of the picture's table, and what is lost by keeping every seventh color.
      expect(near(seen(found, vertex), [...colors.subarray(place, place + 3)], 3)).toBe(true);
    });
    const { image } = colorTexture({ colormap });
    for (const [texel, place] of [0, 40, 73].map((k) => [k, 7 * k]))
      expect([...image.data.subarray(4 * texel, 4 * texel + 4)]).toEqual([...colors.subarray(3 * place, 3 * place + 3), 255]); // prettier-ignore
  });

  it.each([[[-0.5, 0.1, 0.15, 0.9, 7]], [{ count: 6 }]])('have the steps of the pictures: %j', (levels) => {
    const list = scene.drawList(values, { range, levels, bands: true });
    const found = colorAttribute(values, null, { range, levels });
    const { image } = colorTexture({ range, levels });
    const steps = list.levels.map((level) => (level - range[0]) / (range[1] - range[0]));
    scene.surface().vertices.forEach((vertex, corner) => {
      const shade = Math.min(1, Math.max(0, list.shades[corner]));
      // Not where the nearest of the table's colors is that of the next band.
      if (steps.some((step) => Math.abs(step - shade) < 1 / 500)) return;
      const place = 3 * Math.round((list.colors.length / 3 - 1) * shade);
      const color = [...list.colors.subarray(place, place + 3)];
      expect(near(seen(found, vertex), color, 1.5)).toBe(true);
      const texel = 4 * Math.min(image.width - 1, Math.floor(image.width * shade));
      expect(near([...image.data.subarray(texel, texel + 3)], color, 1.5)).toBe(true);
    });
    const different = new Set(Array.from(values, (_, k) => String(seen(found, k).map(Math.round))));
    expect(different.size).toBe(Array.isArray(levels) ? 5 : 7);
  });

  it('are grey where there is no value, and those of the range elsewhere', () => {
    const field = [0, NaN, 10, Infinity, -Infinity, 5];
    const found = colorAttribute(field, null);
    expect(near(seen(found, 1), [0xaa, 0xaa, 0xaa], 0.01)).toBe(true);
    expect(seen(found, 3)).toEqual(seen(found, 2));
    expect(seen(found, 4)).toEqual(seen(found, 0));
    const shades = shadeAttribute(field, null);
    expect([0, 2, 5].map((k) => shades.getX(k))).toEqual([0, 1, 0.5]);
    expect(shades.getY(1)).toBeGreaterThan(1e5);
    const { image } = colorTexture();
    expect([...image.data.subarray(4 * image.width, 4 * image.width + 4)]).toEqual([0xaa, 0xaa, 0xaa, 255]);
    // A constant field has the middle color, one without values none.
    expect(shadeAttribute([3, 3], null).getX(0)).toBe(0.5);
    expect(near(seen(colorAttribute([NaN], null), 0), [0xaa, 0xaa, 0xaa], 0.01)).toBe(true);
  });

  it('are looked up in the middle of the first and the last texel', () => {
    const texture = colorTexture({ channel: 1 });
    const { width } = texture.image;
    const at = (shade) => width * (shade * texture.repeat.x + texture.offset.x);
    expect([at(0), at(1)]).toEqual([0.5, width - 0.5].map((x) => expect.closeTo(x, 9)));
    expect([texture.channel, texture.colorSpace]).toEqual([1, SRGBColorSpace]);
  });

  it("can be of a map of one's own", () => {
    const found = colorAttribute([0, 1, 2], null, { colormap: [255, 0, 0, 0, 0, 255] });
    expect(near(seen(found, 0), [255, 0, 0], 0.01)).toBe(true);
    expect(near(seen(found, 1), [128, 0, 128], 0.01)).toBe(true);
    const { colors } = scene.drawList(values, { colormap: 'magma' });
    expect(colorTexture({ colormap: colors }).image.width).toBe(512);
  });

  it.each([
    [{ colormap: 'jet' }, 'colormap'],
    [{ colormap: 'toString' }, 'colormap'],
    [{ colormap: [1, 2, 3] }, 'colormap'],
    [{ colormap: [0, 0, 0, 0, 0, 256] }, 'colormap'],
    [{ range: [1, 0] }, 'range'],
    [{ range: [0, NaN] }, 'range'],
    [{ range: [1] }, 'range'],
    [{ levels: { count: 0.5 } }, 'levels'],
    [{ levels: { count: 3, saddles: true } }, 'levels'],
    [{ levels: [NaN], range: [0, 1] }, 'levels'],
  ])('refuse %j', (options, option) => {
    expectError(() => colorAttribute([0, 1], null, options), 'InvalidOption', { option });
    expectError(() => colorTexture(options), 'InvalidOption', { option });
  });

  it('of a texture need to know where levels are', () => {
    expectError(() => colorTexture({ levels: [0.5] }), 'InvalidOption', { option: 'range' });
    expectError(() => colorTexture({ channel: 7 }), 'InvalidOption', { option: 'channel' });
    expectError(() => colorTexture({ targets: 1 }), 'UnknownOption', { meant: 'target' });
  });
});

describe('lines', () => {
  const sphere = new SphereGeometry(1, 32, 16);
  const levels = [-0.55, 0.1, 0.7];
  let sets;
  beforeAll(() => {
    const { mesh } = api.meshOf(sphere);
    sets = mesh.levelSets(
      mesh.positions().filter((_, k) => k % 3 === 2),
      levels,
    );
  });

  it('are cut into segments in the planes of their levels', () => {
    const { positions, lines } = api.segmentsOf(sets);
    // Three closed lines: as many segments as points.
    expect([...sets.closed]).toEqual([1, 1, 1]);
    expect(positions).toHaveLength(2 * sets.points.length);
    lines.forEach((line, k) => {
      for (const z of [positions[6 * k + 2], positions[6 * k + 5]]) expect(z).toBeCloseTo(sets.levels[line], 6);
    });
    // Each segment begins where the one before ends, and the last one leads back.
    const ends = (k) => [...positions.subarray(6 * k, 6 * k + 6)];
    for (let k = 0; k < lines.length; k++) {
      const next = lines[k + 1] === lines[k] ? k + 1 : lines.indexOf(lines[k]);
      expect(ends(k).slice(3)).toEqual(ends(next).slice(0, 3));
    }
  });

  it('that are open stay open', () => {
    const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 5, 5, 5];
    const { positions, lines } = api.segmentsOf({ points, offsets: [0, 3, 3, 4] });
    expect([...positions]).toEqual([0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0]);
    expect([...lines]).toEqual([0, 0]);
    expect(api.segmentsOf({ points, offsets: [0, 4], closed: [1] }).lines).toHaveLength(4);
    expect(api.segmentsOf({ points: [], offsets: [0] }).positions).toHaveLength(0);
  });

  it('fill both kinds of geometries', () => {
    const { positions, lines } = api.segmentsOf(sets);
    const wide = api.fillLines(new LineSegmentsGeometry(), sets, { colormap: 'magma', range: [-1, 1] });
    const thin = api.fillLines(new BufferGeometry(), sets, { colormap: 'magma', range: [-1, 1] });
    expect(wide).toBeInstanceOf(LineSegmentsGeometry);
    expect(new LineSegments2(wide).geometry.instanceCount).toBe(lines.length);
    expect(thin.attributes.position.array).toEqual(positions);
    expect(wide.attributes.instanceStart.data.array).toEqual(positions);
    expect(wide.attributes.instanceColorStart.data.array).toEqual(thin.attributes.color.array);
    expect([wide.userData.lines, thin.userData.lines]).toEqual([lines, lines]);
    const colors = colorAttribute(sets.levels, null, { colormap: 'magma', range: [-1, 1] });
    lines.forEach((line, k) => expect(seen(thin.attributes.color, 2 * k + 1)).toEqual(seen(colors, line)));
    expect(api.fillLines(new LineSegmentsGeometry(), { points: [], offsets: [0] }).instanceCount).toBe(0);
  });

  it('are objects that a ray hits', () => {
    const object = api.levelLines(sets);
    expect(object.material.color.getHex()).toBe(0x0d1320);
    const ray = new Raycaster(new Vector3(2, 0, 0.1), new Vector3(-1, 0, 0));
    ray.params.Line.threshold = 0.01;
    const [hit] = ray.intersectObject(object);
    // The index is that of the segment's first end.
    expect(sets.levels[object.geometry.userData.lines[hit.index / 2]]).toBe(0.1);
    expect(api.levelLines(sets, { color: 'red' }).material.color.getHex()).toBe(0xff0000);
    expect(api.levelLines(sets, { colormap: 'magma' }).material.vertexColors).toBe(true);
    const material = new three.LineDashedMaterial();
    expect(api.levelLines(sets, { material }).material).toBe(material);
  });

  it('must be lines', () => {
    for (const call of [api.segmentsOf, api.levelLines, (lines) => api.fillLines(new BufferGeometry(), lines)]) {
      expectError(() => call(), 'InvalidArgument', { argument: 'lines' });
      expectError(() => call({ points: [0, 0, 0] }), 'InvalidArgument', { argument: 'lines.offsets' });
      for (const offsets of [[], [0, 2], [1], [0, 2, 1], [0, -1]])
        expectError(() => call({ points: [0, 0, 0], offsets }), 'InvalidArgument', { argument: 'lines.offsets' });
      expectError(() => call({ points: [0, 0, 0], offsets: [0, 1], closed: [] }), 'InvalidArgument');
    }
    const { points, offsets } = sets;
    expectError(() => api.fillLines({}, sets), 'InvalidArgument', { argument: 'geometry' });
    expectError(() => api.levelLines(sets, { color: 1, colormap: 'magma' }), 'InapplicableOption', { option: 'color' });
    expectError(() => api.levelLines(sets, { range: [0, 1] }), 'InapplicableOption', { option: 'range' });
    expectError(() => api.levelLines({ points, offsets }, { colormap: 'magma' }), 'InvalidOption', { option: 'colormap' }); // prettier-ignore
    expectError(() => api.levelLines(sets, { linewidth: 2 }), 'UnknownOption', { option: 'linewidth' });
  });
});

describe('signs at critical points', () => {
  const sphere = new SphereGeometry(1, 32, 16);
  let mesh, found, positions;
  beforeAll(() => {
    ({ mesh } = api.meshOf(sphere));
    positions = mesh.positions();
    found = mesh.criticalPoints(positions.filter((_, k) => k % 3 === 2).map((z, k) => z + 1e-3 * Math.sin(k)));
  });

  it('are instances that a ray hits', () => {
    const markers = api.criticalMarkers(found, positions, { radius: 0.05 });
    expect(markers.count).toBe(found.vertices.length);
    expect(markers.userData).toEqual({ vertices: found.vertices, kinds: found.kinds });
    const matrix = new three.Matrix4();
    const color = new Color();
    found.vertices.forEach((vertex, k) => {
      markers.getMatrixAt(k, matrix);
      const place = new Vector3().setFromMatrixPosition(matrix).toArray();
      place.forEach((x, axis) => expect(x).toBeCloseTo(positions[3 * vertex + axis], 6));
      expect(new Vector3().setFromMatrixScale(matrix).x).toBeCloseTo(0.05, 6);
      markers.getColorAt(k, color);
      expect(color.getHex()).toBe([0x2f6bff, 0xffffff, 0xe5263c][found.kinds[k] + 1]);
    });
    const top = found.kinds.indexOf(1);
    const at = new Vector3().fromArray(positions, 3 * found.vertices[top]);
    const [hit] = new Raycaster(at.clone().multiplyScalar(3), at.clone().negate().normalize()).intersectObject(markers);
    expect(markers.userData.vertices[hit.instanceId]).toBe(found.vertices[top]);
  });

  it('are points that a ray hits', () => {
    const points = api.criticalPoints(found, positions, { size: 12, colors: ['lime', 'gray', 'red'] });
    expect([points.material.size, points.material.sizeAttenuation]).toEqual([12, false]);
    found.vertices.forEach((vertex, k) => {
      expect(points.geometry.attributes.position.getZ(k)).toBeCloseTo(positions[3 * vertex + 2], 6);
      const color = new Color().fromBufferAttribute(points.geometry.attributes.color, k);
      expect(color.getHex()).toBe([0x00ff00, 0x808080, 0xff0000][found.kinds[k] + 1]);
    });
    const at = new Vector3().fromArray(positions, 3 * found.vertices[0]);
    const ray = new Raycaster(at.clone().multiplyScalar(3), at.clone().negate().normalize());
    ray.params.Points.threshold = 0.01;
    const hit = ray.intersectObject(points).find(({ index }) => index === 0);
    expect(points.userData.vertices[hit.index]).toBe(found.vertices[0]);
  });

  it('take other solids, materials and sizes', () => {
    const [geometry, material] = [new BoxGeometry(), new three.MeshStandardMaterial()];
    const markers = api.criticalMarkers(found, positions, { geometry, material });
    expect([markers.geometry, markers.material]).toEqual([geometry, material]);
    const matrix = new three.Matrix4();
    markers.getMatrixAt(0, matrix);
    expect(new Vector3().setFromMatrixScale(matrix).x).toBeCloseTo(0.012 * Math.hypot(2, 2, 2), 3);
    const none = { vertices: [], kinds: [] };
    expect([api.criticalMarkers(none, []).count, api.criticalPoints(none, []).geometry.attributes.position.count]).toEqual([0, 0]); // prettier-ignore
  });

  it('must be on the mesh', () => {
    for (const call of [api.criticalMarkers, api.criticalPoints]) {
      expectError(() => call([1], positions), 'InvalidArgument', { argument: 'found' });
      expectError(() => call({ vertices: [0, 1], kinds: [0] }, positions), 'InvalidArgument', {
        argument: 'found.kinds',
      });
      expectError(() => call({ vertices: [0], kinds: [2] }, positions), 'InvalidArgument', { argument: 'found.kinds' });
      expectError(() => call({ vertices: [1], kinds: [0] }, [0, 0, 0]), 'InvalidArgument', { argument: 'positions' });
      expectError(() => call({ vertices: [-1], kinds: [0] }, positions), 'IndexOutOfBounds', { index: -1 });
      expectError(() => call(found, positions, { colors: ['red'] }), 'InvalidOption', { option: 'colors' });
    }
    expectError(() => api.criticalMarkers(found, positions, { radius: 0 }), 'InvalidOption', { option: 'radius' });
    expectError(() => api.criticalPoints(found, positions, { size: -1 }), 'InvalidOption', { option: 'size' });
    expectError(() => api.criticalPoints(found, positions, { radius: 1 }), 'UnknownOption', { belongsTo: ['criticalMarkers'] }); // prettier-ignore
  });
});

describe('picking', () => {
  const box = new BoxGeometry(2, 2, 2, 5, 5, 5);
  let vertexMap, places, values;
  beforeAll(() => {
    const made = api.meshOf(box);
    vertexMap = made.vertexMap;
    places = made.mesh.positions();
    // Linear in space, so that it is known everywhere on the faces.
    values = Float64Array.from({ length: made.mesh.vertexCount }, (_, k) => linear(places.subarray(3 * k)));
  });
  const linear = ([x, y, z]) => 3 * x - 2 * y + 0.5 * z + 7;
  const ray = (from, to) => new Raycaster(from, to.clone().sub(from).normalize());

  it('finds the nearest corner and the value, wherever the object stands', () => {
    const object = new Mesh(box);
    object.position.set(4, -3, 2);
    object.rotation.set(0.5, 1, -2);
    object.scale.set(2, 0.5, 3);
    object.updateMatrixWorld();
    for (let time = 0; time < 20; time++) {
      const target = new Vector3(Math.sin(time), Math.cos(3 * time), Math.sin(5 * time)).multiplyScalar(0.5);
      const from = new Vector3(Math.cos(7 * time), Math.sin(11 * time), Math.cos(time)).multiplyScalar(9);
      const [hit] = ray(object.localToWorld(from), object.localToWorld(target)).intersectObject(object);
      const at = object.worldToLocal(hit.point.clone());
      for (const barycoord of [hit.barycoord, undefined]) {
        const found = api.pick({ ...hit, barycoord }, vertexMap, values);
        expect(found.value).toBeCloseTo(linear(at.toArray()), 5);
        expect(found.weights.reduce((sum, w) => sum + w)).toBeCloseTo(1, 9);
        expect(found.vertices).toContain(found.vertex);
        const distances = found.vertices.map((v) => at.distanceTo(new Vector3().fromArray(places, 3 * v)));
        expect(distances[found.vertices.indexOf(found.vertex)]).toBe(Math.min(...distances));
        expect(api.pick(hit, vertexMap)).toEqual({ ...found, weights: expect.any(Array), value: null });
      }
    }
  });

  it('knows instances, also of a three.js that does not say where in the triangle', () => {
    const object = new three.InstancedMesh(box, undefined, 2);
    const matrix = new three.Matrix4().makeRotationY(0.7).setPosition(10, 0, 0);
    object.setMatrixAt(1, matrix.clone());
    object.setMatrixAt(0, new three.Matrix4());
    const [hit] = ray(new Vector3(10, 0.3, 9), new Vector3(10.2, 0.2, 0)).intersectObject(object);
    expect(hit.instanceId).toBe(1);
    const at = hit.point.clone().applyMatrix4(matrix.invert());
    for (const barycoord of [hit.barycoord, undefined])
      expect(api.pick({ ...hit, barycoord }, vertexMap, values).value).toBeCloseTo(linear(at.toArray()), 5);
  });

  it('says that there is no value beside a missing one, but at the corners', () => {
    const [hit] = ray(new Vector3(0.1, 0.2, 9), new Vector3(0.1, 0.2, 0)).intersectObject(new Mesh(box));
    const { vertices } = api.pick(hit, vertexMap);
    const holed = values.map((value, k) => (k === vertices[0] ? NaN : value));
    expect(api.pick(hit, vertexMap, holed).value).toBe(NaN);
    const corner = { ...hit, barycoord: new Vector3(0, 1, 0) };
    expect(api.pick(corner, vertexMap, holed)).toMatchObject({ vertex: vertices[1], value: values[vertices[1]] });
  });

  it('refuses what is no hit on that mesh', () => {
    const [hit] = ray(new Vector3(0, 0, 9), new Vector3(0, 0, 0)).intersectObject(
      new Mesh(new SphereGeometry(1, 64, 64)),
    );
    expectError(() => api.pick(hit, vertexMap), 'LengthMismatch', { actual: vertexMap.length });
    expectError(() => api.pick(hit, null, [1, 2, 3]), 'LengthMismatch', { actual: 3 });
    for (const other of [undefined, null, [], {}, { ...hit, face: null }, { ...hit, object: new three.Points() }])
      expectError(() => api.pick(other, vertexMap), 'InvalidArgument', { argument: 'intersection' });
  });
});
