// What examples/deck.mjs does with the real deck.gl, in a page: the pixels of a surface and of its level sets.
import { Deck, OrthographicView } from '@deck.gl/core';
import init, { TriMesh } from 'morse-smooth';
import initPictures, { Scene } from 'morse-smooth/snapshot';
import { levelLayer, surfaceLayer } from './deck.mjs';

const SIZE = 300;

async function run() {
  await Promise.all([init(), initPictures()]);
  // A square whose field is x, with a level set in its middle.
  const positions = [0, 0, 0, 300, 0, 0, 300, 300, 0, 0, 300, 0];
  const triangles = [0, 1, 2, 0, 2, 3];
  const values = [0, 300, 300, 0];
  const layers = [
    surfaceLayer(new Scene(positions, triangles), values, { colormap: 'coolWarm' }).clone({
      material: { unlit: true },
    }),
    levelLayer(new TriMesh(positions, triangles).levelSets(values, [150])),
  ];
  const canvas = document.body.appendChild(document.createElement('canvas'));
  await new Promise((resolve, reject) => {
    const deck = new Deck({
      canvas,
      width: SIZE,
      height: SIZE,
      useDevicePixels: 1,
      views: new OrthographicView(),
      initialViewState: { target: [150, 150, 0], zoom: 0 },
      layers,
      onError: reject,
      onAfterRender: () => deck.layerManager?.getLayers().every(({ isLoaded }) => isLoaded) && resolve(),
    });
  });
  const copy = document.createElement('canvas').getContext('2d');
  copy.drawImage(canvas, 0, 0);
  const at = (x) => [...copy.getImageData(x, 120, 1, 1).data];
  const [left, middle, right] = [at(3), at(150), at(296)];
  // The ends of the color map, and the dark line.
  const near = (found, wanted) => found.every((part, k) => Math.abs(part - wanted[k]) < 8);
  return { ends: near(left, [59, 76, 192, 255]) && near(right, [180, 4, 38, 255]), line: near(middle, [13, 19, 32, 255]), left, middle, right }; // prettier-ignore
}

run().then(
  (found) => (globalThis.result = { deck: found.ends && found.line ? true : found }),
  (error) => (globalThis.result = String(error)),
);
