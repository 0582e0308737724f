// node tests/golden/make-meshes.mjs: writes the meshes that the golden pictures show. Four decimals are the same on every platform.
import { writeFileSync } from 'node:fs';

const { PI, cos, exp, sin } = Math;

/** A grid of columns × rows corners over [0, 1]², placed by a function; where it closes, the first of them come after the last. */
function grid(columns, rows, place, closed = { columns: false, rows: false }) {
  const points = [];
  const triangles = [];
  const at = (i, j) => (i % columns) * rows + (j % rows);
  const across = closed.columns ? columns : columns - 1;
  const along = closed.rows ? rows : rows - 1;
  for (let i = 0; i < columns; i++) {
    for (let j = 0; j < rows; j++) points.push(place(i / across, j / along));
  }
  for (let i = 0; i < across; i++) {
    for (let j = 0; j < along; j++) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      triangles.push([a, b, c], [a, c, d]);
    }
  }
  return { points, triangles };
}

/** PLY, with the fields as further properties of the vertices. */
function write(name, { points, triangles }, fields) {
  const text = (x) => (Number.isNaN(x) ? 'nan' : String(Number(x.toFixed(4)) || 0));
  const names = ['x', 'y', 'z', ...Object.keys(fields)];
  const columns = [0, 1, 2].map((axis) => points.map((p) => p[axis]));
  columns.push(...Object.values(fields).map((field) => points.map(field)));
  const lines = [
    'ply',
    'format ascii 1.0',
    `element vertex ${points.length}`,
    ...names.map((property) => `property double ${property}`),
    `element face ${triangles.length}`,
    'property list uchar int vertex_indices',
    'end_header',
    ...points.map((_, v) => columns.map((column) => text(column[v])).join(' ')),
    ...triangles.map((corners) => `3 ${corners.join(' ')}`),
  ];
  writeFileSync(new URL(`${name}.ply`, import.meta.url), `${lines.join('\n')}\n`);
}

/** A sphere without its top: the inside is seen. */
const bowl = grid(
  28,
  10,
  (u, v) => {
    const [azimuth, polar] = [2 * PI * u, PI * (1 - 0.68 * v)];
    return [sin(polar) * sin(azimuth), cos(polar), sin(polar) * cos(azimuth)];
  },
  { columns: true, rows: false },
);
write('bowl', bowl, { height: ([, y]) => y });

const ring = grid(
  36,
  18,
  (u, v) => {
    const [around, across] = [2 * PI * u, 2 * PI * v];
    const r = 1 + 0.42 * cos(across);
    return [r * sin(around), 0.42 * sin(across), r * cos(around)];
  },
  { columns: true, rows: true },
);
write('ring', ring, { slope: ([x, y, z]) => x + 0.3 * y + 0.2 * z });

/** Hills and hollows, the middle one of each kind apart from the border. */
const waves = grid(25, 19, (u, v) => {
  const [x, y] = [4 * u - 2, 3 * v - 1.5];
  return [x, y, 0.22 * sin(2.4 * x) * cos(2.2 * y)];
});
const smooth = ([x, y]) => sin(2.4 * x) * cos(2.2 * y) + 0.15 * x;
const rough = (p) => smooth(p) + 0.4 * sin(5 * p[0] + 1) * sin(4.3 * p[1]);
/** Without values in a disc inside, and beyond a line that cuts a corner off. */
const gaps = ([x, y]) => ((x - 0.3) ** 2 + (y + 0.35) ** 2 < 0.2 || y - x > 2.2 ? NaN : smooth([x, y]));
write('waves', waves, { before: rough, after: smooth, gaps });

/** Four pages that meet in one line: its edges belong to four triangles each. */
const pages = { points: [], triangles: [] };
const spine = Array.from({ length: 7 }, (_, k) => [0, k / 3 - 1, 0]);
pages.points.push(...spine);
for (const angle of [0.2, 1.1, 2.3, 3.6]) {
  const page = grid(6, 7, (u, v) => {
    const [r, turn] = [(1 + 5 * u) / 5, angle + 0.25 * u * u];
    return [r * cos(turn), 2 * v - 1, r * sin(turn)];
  });
  const first = pages.points.length;
  pages.points.push(...page.points);
  pages.triangles.push(...page.triangles.map((corners) => corners.map((v) => v + first)));
  for (let k = 0; k < 6; k++) pages.triangles.push([k, first + k, first + k + 1], [k, first + k + 1, k + 1]);
}
write('pages', pages, { bump: ([x, y, z]) => exp(-(x * x + z * z)) * (1 + y) });
