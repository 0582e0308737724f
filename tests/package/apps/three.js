// The app of users of three.js: loads the module, unless it is not to wait, and uses it.
import init, * as main from 'morse-smooth';
import * as api from 'morse-smooth/three';
import * as THREE from 'three';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { surface } from './surface.js';

export async function run(waits = true) {
  if (waits) await init();
  const wide = api.fillLines(new LineSegmentsGeometry(), { points: [0, 0, 0, 1, 1, 1], offsets: [0, 2] });
  return { ...surface(THREE, api, main), wide: wide.instanceCount };
}
