// Pixels that a graphics card makes of fields with three.js. (Node has none.)
import init, { TriMesh } from 'morse-smooth';
import initPictures, { Scene } from 'morse-smooth/snapshot';
import {
  colorTexture,
  criticalMarkers,
  criticalPoints,
  fillLines,
  geometryOf,
  levelLines,
  shadeAttribute,
} from 'morse-smooth/three';
import * as three from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { square } from './meshes.js';

const inNode = typeof process === 'object' && process.versions?.node !== undefined;
const SIZE = 300;

/** A square of 3 × 3 cells that fills the picture, 100 pixels a cell; its field is x. */
const { positions, triangles } = square(3);
const x = Float64Array.from({ length: 16 }, (_, k) => k % 4);

describe.skipIf(inNode)('on a graphics card', () => {
  let renderer, mesh, scene;
  const camera = new three.OrthographicCamera(0, 3, 3, 0, -1, 1);
  beforeAll(async () => {
    await Promise.all([init(), initPictures()]);
    renderer = new three.WebGLRenderer({ preserveDrawingBuffer: true });
    renderer.setSize(SIZE, SIZE, false);
    mesh = new TriMesh(positions, triangles);
    scene = new Scene(positions, triangles);
  });
  afterAll(() => renderer.dispose());

  /** A function that gives red, green and blue at a place of the square. */
  function drawn(...objects) {
    const all = new three.Scene().add(...objects);
    all.background = new three.Color('white');
    renderer.render(all, camera);
    const pixels = new Uint8Array(4 * SIZE * SIZE);
    const gl = renderer.getContext();
    gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return (right, up) => {
      const at = 4 * (Math.floor(100 * right) + SIZE * Math.floor(100 * up));
      return [...pixels.subarray(at, at + 3)];
    };
  }

  function surface(values, map, options) {
    const geometry = geometryOf({ positions, triangles });
    geometry.setAttribute(map.channel ? `uv${map.channel}` : 'uv', shadeAttribute(values, null, options));
    return new three.Mesh(geometry, new three.MeshBasicMaterial({ map }));
  }

  const near = (found, wanted, distance) => expect(Math.max(...found.map((c, k) => Math.abs(c - wanted[k])))).toBeLessThanOrEqual(distance); // prettier-ignore

  it.each([0, 1])('every pixel has the color of its value: channel %i', (channel) => {
    const range = [0.5, 2.5];
    const at = drawn(surface(x, colorTexture({ colormap: 'inferno', channel }), { range }));
    const { colors } = scene.drawList(x, { colormap: 'inferno', range });
    for (let place = 0.005; place < 3; place += 0.05) {
      const shade = Math.min(1, Math.max(0, (place - 0.5) / 2));
      const from = 3 * Math.round(511 * shade);
      near(at(place, (7 * place) % 3), [...colors.subarray(from, from + 3)], 4);
    }
  });

  it('bands end where their levels are', () => {
    const [range, levels] = [
      [0, 3],
      [0.4, 1.7],
    ];
    const at = drawn(surface(x, colorTexture({ levels, range }), { range }));
    const { colors } = scene.drawList(x, { levels, range, bands: true });
    for (const [place, shade] of [
      [0.01, 0],
      [0.38, 0.1],
      [0.42, 0.15],
      [1.68, 0.5],
      [1.72, 0.6],
      [2.99, 1],
    ]) {
      // prettier-ignore
      const from = 3 * Math.round((colors.length / 3 - 1) * shade);
      near(at(place, 1.3), [...colors.subarray(from, from + 3)], 1);
    }
  });

  it('triangles with a missing value are grey, and no others', () => {
    const values = x.map((value, k) => (k === 5 ? NaN : value));
    const at = drawn(surface(values, colorTexture({ colormap: [0, 0, 255, 0, 0, 255] })));
    // Around vertex 5, at (1, 1), there are all triangles of two cells and one of each of two others.
    for (const [right, up] of [[0.9, 0.5], [0.5, 0.9], [0.2, 0.1], [0.1, 0.2], [1.9, 1.5], [1.5, 1.9], [0.9, 1.2], [1.2, 0.9]]) near(at(right, up), [170, 170, 170], 1); // prettier-ignore
    for (const [right, up] of [[2.5, 0.5], [0.2, 1.9], [1.8, 0.2], [2.5, 2.5], [1.5, 2.2]]) near(at(right, up), [0, 0, 255], 1); // prettier-ignore
  });

  it('lines are drawn where the field has their levels', () => {
    const sets = mesh.levelSets(x, [0.755, 2.255]);
    const wide = new LineSegments2(
      fillLines(new LineSegmentsGeometry(), sets),
      new LineMaterial({ color: 'blue', linewidth: 6 }),
    );
    for (const lines of [levelLines(sets, { color: 'blue' }), wide]) {
      const at = drawn(lines);
      for (const place of [0.755, 2.255]) near(at(place, 1.234), [0, 0, 255], 0);
      for (const place of [0.3, 1.5, 2.9]) near(at(place, 1.234), [255, 255, 255], 0);
      expect(at(0.775, 1.234)).toEqual(lines === wide ? [0, 0, 255] : [255, 255, 255]);
    }
    const none = fillLines(new LineSegmentsGeometry(), mesh.levelSets(x, []));
    near(drawn(new LineSegments2(none, new LineMaterial({ color: 'blue', linewidth: 6 })))(1, 1), [255, 255, 255], 0);
  });

  it('signs have the colors of their kinds', () => {
    const found = { vertices: [5, 6, 10], kinds: [-1, 0, 1] };
    const colors = ['red', 'lime', 'blue'];
    for (const signs of [
      criticalMarkers(found, positions, { radius: 0.1, colors }),
      criticalPoints(found, positions, { size: 20, colors }),
    ]) {
      const at = drawn(signs);
      expect([at(1, 1), at(2, 1), at(2, 2)]).toEqual([[255, 0, 0], [0, 255, 0], [0, 0, 255]]); // prettier-ignore
      expect([at(1.07, 1), at(1.2, 1), at(1, 2)]).toEqual([[255, 0, 0], [255, 255, 255], [255, 255, 255]]); // prettier-ignore
    }
  });
});
