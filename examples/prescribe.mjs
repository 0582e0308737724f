// node examples/prescribe.mjs output.png: the smoothest field that has exactly the chosen extrema, beside the one that it comes from.
import { readFileSync, writeFileSync } from 'node:fs';
import { Smoother, TriMesh } from 'morse-smooth';
import { readMesh } from 'morse-smooth/files';
import { sheet } from 'morse-smooth/snapshot';

const [output = 'exact.png'] = process.argv.slice(2);
const { positions, triangles, fields } = readMesh(readFileSync('www/public/examples/jacksboro_dem.ply'));
const field = fields.elevation;
const mesh = new TriMesh(positions, triangles);
const smoother = new Smoother(mesh);

// Of the smoothed terrain's 31 basins and 22 peaks those of more persistence than 5 % of the range, and no others.
const extrema = { from: 'persistence', threshold: 0.05 };
const { values, report, energy, unconstrainedEnergy } = smoother.prescribe(field, { epsilon: 0.02, extrema });
const { before, after } = report;
console.log(`minima ${before.minima} → ${after.minima}, maxima ${before.maxima} → ${after.maxima}, saddles ${before.saddles} → ${after.saddles}`); // prettier-ignore
console.log(`energy ${(100 * (energy / unconstrainedEnergy - 1)).toFixed(2)} % above that of the smoothed field`);

const camera = { direction: [0, -0.5, 1] };
const titles = ['before', 'exact', 'difference'];
const png = sheet(positions, triangles, field, values, { camera, titles, width: 500, height: 440 });
writeFileSync(output, png);
console.log(`wrote ${output}: ${Math.round(png.length / 1000)} kB`);
for (const object of [smoother, mesh]) object.free();
