// node examples/prescribe.mjs output.png: the smoothest field that has exactly the chosen extrema, beside the one that it comes from.
import { readFileSync, writeFileSync } from 'node:fs';
import { Smoother, TriMesh } from 'morse-smooth';
import { readMesh } from 'morse-smooth/files';
import { sheet } from 'morse-smooth/snapshot';

const [output = 'exact.png'] = process.argv.slice(2);
const { positions, triangles, fields } = readMesh(readFileSync('www/public/examples/egm96_geoid_2deg.ply'));
const mesh = new TriMesh(positions, triangles);
const smoother = new Smoother(mesh);
const field = fields.geoid_m;

// The most persistent extrema of the smoothed field: four basins, three highs, and nothing else.
const extrema = { from: 'persistence', minima: 4, maxima: 3 };
const { values, report, energy, unconstrainedEnergy } = smoother.prescribe(field, { epsilon: 0.01, extrema });
const { before, after } = report;
console.log(
  `minima ${before.minima} → ${after.minima}, maxima ${before.maxima} → ${after.maxima}, saddles ${after.saddles}`,
);
console.log(
  `energy: ${(100 * (energy / unconstrainedEnergy - 1)).toFixed(2)} % above the field without prescribed extrema`,
);

const camera = { direction: [0.6, 0.5, 0.6] };
const titles = ['before', 'exact', 'difference'];
const png = sheet(positions, triangles, field, values, { camera, titles, width: 500, height: 440 });
writeFileSync(output, png);
console.log(`wrote ${output}: ${Math.round(png.length / 1000)} kB`);
for (const object of [smoother, mesh]) object.free();
