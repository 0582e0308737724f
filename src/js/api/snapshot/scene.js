import { toNumbers, toTriangles } from '../../runtime/convert.js';
import { makeDisposable } from '../../runtime/handles.js';
import { pictures } from './module.js';
import { toPictureOptions } from './settings.js';

export class Scene {
  #handle;
  #vertexCount;

  constructor(positions, triangles) {
    const { instance } = pictures;
    const numbers = toNumbers(positions, 'positions');
    this.#vertexCount = Math.floor(numbers.length / 3);
    const ids = toTriangles(triangles, this.#vertexCount);
    this.#handle = instance.create('Scene', ({ RawScene }) => new RawScene(numbers, ids));
  }

  snapshot(values, options) {
    const numbers = toNumbers(values, 'values');
    const settings = toPictureOptions(options, this.#vertexCount);
    return this.#handle.use((raw) => raw.snapshot(numbers, settings));
  }

  sheet(before, after, options) {
    const fields = [toNumbers(before, 'before'), toNumbers(after, 'after')];
    const settings = toPictureOptions(options, this.#vertexCount);
    return this.#handle.use((raw) => raw.sheet(...fields, settings));
  }

  surface() {
    return this.#handle.use((raw) => raw.surface());
  }

  drawList(values, options) {
    const numbers = toNumbers(values, 'values');
    const settings = toPictureOptions(options, this.#vertexCount);
    return this.#handle.use((raw) => raw.drawList(numbers, settings));
  }

  free() {
    this.#handle.free();
  }
}
makeDisposable(Scene);

export function snapshot(positions, triangles, values, options) {
  return once(positions, triangles, (scene) => scene.snapshot(values, options));
}

export function sheet(positions, triangles, before, after, options) {
  return once(positions, triangles, (scene) => scene.sheet(before, after, options));
}

function once(positions, triangles, draw) {
  const scene = new Scene(positions, triangles);
  let png;
  try {
    png = draw(scene);
  } catch (error) {
    try {
      scene.free();
    } catch {
      // What went wrong first is what the caller has to know.
    }
    throw error;
  }
  scene.free();
  return png;
}
