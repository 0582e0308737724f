// The golden pictures, drawn in WebAssembly: the same files that tests/integration/golden compares with what is drawn natively.
import initFiles, { readMesh } from 'morse-smooth/files';
import init, { sheet, snapshot } from 'morse-smooth/snapshot';
import { beforeAll, expect, it } from 'vitest';
import cases from '../golden/cases.json';

const goldens = import.meta.glob('../golden/*.png', { query: '?inline', eager: true, import: 'default' });
const meshes = import.meta.glob('../golden/*.ply', { query: '?raw', eager: true, import: 'default' });

beforeAll(() => Promise.all([init(), initFiles()]));

/** The bytes of a data URL. */
const bytesOf = (url) => Uint8Array.from(atob(url.slice(url.indexOf(',') + 1)), (letter) => letter.charCodeAt(0));

it.each(cases)('$name: $shows', ({ name, mesh: meshName, fields: names, options }) => {
  const { positions, triangles, fields } = readMesh(new TextEncoder().encode(meshes[`../golden/${meshName}.ply`]));
  const draw = names.length === 2 ? sheet : snapshot;
  const png = draw(positions, triangles, ...names.map((field) => fields[field]), options);
  const golden = goldens[`../golden/${name}.png`];
  expect(golden, `tests/golden/${name}.png`).toMatch(/^data:image\/png;base64,/);
  // What differs, `cargo test --features render golden` shows, if it differs natively, too.
  const expected = bytesOf(golden);
  const first = png.findIndex((byte, k) => byte !== expected[k]);
  expect({ bytes: png.length, first }).toEqual({ bytes: expected.length, first: -1 });
});
