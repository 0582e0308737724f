// node examples/sheet.mjs output.png: draws a field before and after smoothing, and the difference, side by side.
import { readFileSync, writeFileSync } from 'node:fs';
import { TriMesh, smooth } from 'morse-smooth';
import { readMesh } from 'morse-smooth/files';
import { sheet } from 'morse-smooth/snapshot';

const [output = 'sheet.png'] = process.argv.slice(2);
const { positions, triangles, fields } = readMesh(readFileSync('www/public/examples/genus22.ply'));
const mesh = new TriMesh(positions, triangles);
const { values } = smooth(mesh, fields.noisy, { epsilon: 0.1 });

const camera = { direction: [0.15, 0.8, 0.8] };
const png = sheet(positions, triangles, fields.noisy, values, { camera, width: 500, height: 440 });
writeFileSync(output, png);
console.log(`wrote ${output}: ${Math.round(png.length / 1000)} kB`);
mesh.free();
