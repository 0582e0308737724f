// Makes the meshes of www/public/examples from the full data sets, each at most 1 MB.
//
//   node scripts/make-examples.mjs FOLDER
//
// FOLDER holds genus22.ply, torus_irregular.ply, lysozyme_potential.ply, egm96_geoid_1deg.ply and jacksboro_dem.ply. The
// results are committed: this is only needed again when a mesh is added or changed.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import init, { TriMesh } from 'morse-smooth';
import initFiles, { readMesh } from 'morse-smooth/files';

const LIMIT = 1e6;
const source = process.argv[2];
if (!source) {
  console.error('usage: node scripts/make-examples.mjs FOLDER');
  process.exit(1);
}
const target = fileURLToPath(new URL('../www/public/examples/', import.meta.url));
await Promise.all([init(), initFiles()]);

// Small enough as they are; their counts are known exactly, so not a bit is changed.
for (const name of ['genus22.ply', 'torus_irregular.ply']) save(name, readFileSync(join(source, name)));

// Text to binary, positions and potential in single precision.
{
  const { positions, triangles, fields } = read('lysozyme_potential.ply');
  save('lysozyme_potential.ply', encode(positions, triangles, { potential: fields.potential }));
}

// A sphere of 179 parallels with 360 nodes each, from 89° south to 89° north, then the two poles: every second of both.
{
  const { positions, fields } = read('egm96_geoid_1deg.ply');
  const [rows, columns] = [89, 180];
  const kept = [];
  for (let r = 0; r < rows; r++) for (let c = 0; c < columns; c++) kept.push((2 * r + 1) * 360 + 2 * c);
  const [south, north] = [kept.push(179 * 360) - 1, kept.push(179 * 360 + 1) - 1];
  const at = (r, c) => r * columns + (c % columns);
  const triangles = [];
  for (let c = 0; c < columns; c++) {
    triangles.push(south, at(0, c + 1), at(0, c));
    for (let r = 0; r + 1 < rows; r++)
      triangles.push(at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r, c), at(r + 1, c + 1), at(r + 1, c));
    triangles.push(north, at(rows - 1, c), at(rows - 1, c + 1));
  }
  save('egm96_geoid_2deg.ply', encode(pick(positions, kept, 3), triangles, { geoid_m: pick(fields.geoid_m, kept, 1) }));
}

// A grid of 172 columns with 202 nodes each: every second of both.
{
  const { positions, fields } = read('jacksboro_dem.ply');
  const [columns, rows] = [86, 101];
  const kept = [];
  for (let c = 0; c < columns; c++) for (let r = 0; r < rows; r++) kept.push(2 * c * 202 + 2 * r);
  const triangles = [];
  for (let c = 0; c + 1 < columns; c++) {
    for (let r = 0; r + 1 < rows; r++) {
      const a = c * rows + r;
      triangles.push(a, a + rows, a + rows + 1, a, a + rows + 1, a + 1);
    }
  }
  save(
    'jacksboro_dem.ply',
    encode(pick(positions, kept, 3), triangles, { elevation: pick(fields.elevation, kept, 1) }),
  );
}

function read(name) {
  return readMesh(readFileSync(join(source, name)), { fileName: name });
}

function pick(values, kept, width) {
  const out = new Float64Array(width * kept.length);
  kept.forEach((i, k) => out.set(values.subarray(width * i, width * (i + 1)), width * k));
  return out;
}

/** Binary PLY with 32-bit floats and 16-bit ids: the package's own writer keeps double precision instead. */
function encode(positions, triangles, fields) {
  const vertices = positions.length / 3;
  const faces = triangles.length / 3;
  if (vertices > 65536) throw new Error(`${vertices} vertices do not fit 16-bit ids`);
  const names = Object.keys(fields);
  const header = [
    'ply',
    'format binary_little_endian 1.0',
    `element vertex ${vertices}`,
    ...['x', 'y', 'z', ...names].map((property) => `property float ${property}`),
    `element face ${faces}`,
    'property list uchar ushort vertex_indices',
    'end_header',
    '',
  ].join('\n');
  const bytes = Buffer.alloc(header.length + vertices * 4 * (3 + names.length) + faces * 7);
  let offset = bytes.write(header, 'latin1');
  for (let i = 0; i < vertices; i++) {
    for (let k = 0; k < 3; k++) offset = bytes.writeFloatLE(positions[3 * i + k], offset);
    for (const name of names) offset = bytes.writeFloatLE(fields[name][i], offset);
  }
  for (let t = 0; t < faces; t++) {
    offset = bytes.writeUInt8(3, offset);
    for (let k = 0; k < 3; k++) offset = bytes.writeUInt16LE(triangles[3 * t + k], offset);
  }
  return bytes;
}

/** Writes the file and reads it again as a user would; what it prints is what the README beside it says. */
function save(name, bytes) {
  if (bytes.length > LIMIT) throw new Error(`${name} has ${bytes.length} bytes, more than ${LIMIT}`);
  writeFileSync(join(target, name), bytes);
  const { positions, triangles, fields } = readMesh(bytes, { fileName: name });
  const mesh = new TriMesh(positions, triangles);
  const { eulerCharacteristic, boundaryLoops, orientable } = mesh.topology;
  console.log(
    `${name}: ${bytes.length} bytes, ${mesh.vertexCount} vertices, ${mesh.triangleCount} triangles, χ ${eulerCharacteristic}, ${boundaryLoops} boundary loops, ${orientable ? '' : 'not '}orientable`,
  );
  for (const [field, values] of Object.entries(fields)) {
    const { minima, maxima, saddles, indexSum } = mesh.criticalPoints(values).counts;
    console.log(`  ${field}: ${minima} minima, ${maxima} maxima, ${saddles} saddles, index sum ${indexSum}`);
  }
  mesh.free();
}
