import { readInput } from '../input.js';
import { api, own, take } from '../options.js';
import { counted, rangeOf, reportTarget, shown, writeReport } from '../report.js';

export const info = {
  name: 'info',
  summary: 'what kind of surface a mesh is, and which fields it has',
  options: {
    ...take(api.files.readMesh, api.files.weld),
    values: own.field.values,
    ...take('column'),
    ...own.report,
    ...own.json,
    ...own.common,
  },
  examples: ['morse-smooth info torus.ply', 'morse-smooth info torus.ply --json'],
  async run({ input, given, notes }) {
    const target = reportTarget(given);
    const file = await readInput(input, given, notes);
    const mesh = file.make();
    notes.warn(input, mesh.warnings);
    const { vertexCount, edgeCount, triangleCount, area, topology } = mesh;
    const fields = Object.entries(file.fields).map(([name, values]) => ({ name, on: 'vertices', ...rangeOf(values) }));
    const others = Object.entries(file.triangleFields ?? {}).map(([name, values]) => {
      return { name, on: 'triangles', ...rangeOf(values) };
    });
    const all = [...fields, ...others];
    const warnings = [...file.warnings, ...mesh.warnings];
    return writeReport(target, {
      json: {
        file: input,
        format: file.format,
        vertexCount,
        edgeCount,
        triangleCount,
        area,
        topology,
        fields: all,
        warnings,
      },
      lines: [
        `${input === '-' ? 'standard input' : input}: ${file.format}`,
        `${counted(vertexCount, 'vertex', 'vertices')}, ${counted(edgeCount, 'edge')}, ${counted(triangleCount, 'triangle')}, area ${shown(area)}`,
        surface(topology),
        ...irregular(topology),
        all.length > 0 ? counted(all.length, 'field') : 'no fields',
      ],
      columns: ['field', 'on', 'least', 'greatest', 'missing'],
      rows: all.map(({ name, on, min, max, missing }) => [name, on, min, max, missing]),
    });
  },
};

/** The kind of surface in a line. */
function surface({ closed, orientable, components, boundaryLoops, genus, eulerCharacteristic }) {
  return [
    closed ? 'closed' : `with ${counted(boundaryLoops, 'boundary loop')}`,
    orientable ? 'orientable' : 'not orientable',
    counted(components, 'component'),
    ...(genus === null ? [] : [`genus ${genus}`]),
    `Euler characteristic ${eulerCharacteristic}`,
  ].join(', ');
}

/** What is out of order, if anything is. */
function irregular({ nonManifoldEdges, nonManifoldVertices, isolatedVertices, degenerateTriangles }) {
  const parts = [
    [nonManifoldEdges, 'non-manifold edge', 'non-manifold edges'],
    [nonManifoldVertices, 'non-manifold vertex', 'non-manifold vertices'],
    [isolatedVertices, 'vertex of no triangle', 'vertices of no triangle'],
    [degenerateTriangles, 'degenerate triangle', 'degenerate triangles'],
  ];
  const found = parts.filter(([count]) => count > 0).map((part) => counted(...part));
  return found.length > 0 ? [found.join(', ')] : [];
}
