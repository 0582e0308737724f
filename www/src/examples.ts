/** The meshes that come with the page. Where they are from and under which licence: public/examples/README.md. */
export interface Example {
  id: string;
  label: string;
  file: string;
  /** Key of the field to start with. */
  field: string;
  epsilon: number;
  levels: number;
  /** Where the camera stands, in the scene, whose y points up. */
  view: readonly [number, number, number];
  /** Which of the file's axes points up, where its shape does not tell. */
  up?: 'z';
}

export const EXAMPLES: readonly Example[] = [
  {
    id: 'genus22',
    label: 'Genus 22, noisy',
    file: 'genus22.ply',
    field: 'file:noisy',
    epsilon: 0.1,
    levels: 12,
    view: [0.75, 0.8, 0.3],
  },
  {
    id: 'torus',
    label: 'Irregular torus, noisy',
    file: 'torus_irregular.ply',
    field: 'file:noisy',
    epsilon: 0.1,
    levels: 14,
    view: [0.15, 0.8, 0.8],
  },
  {
    id: 'earth',
    label: 'Earth: geoid height',
    file: 'egm96_geoid_2deg.ply',
    field: 'file:geoid_m',
    epsilon: 0.1,
    levels: 14,
    view: [0.3, 0.25, 0.95],
    up: 'z',
  },
  {
    id: 'terrain',
    label: 'Terrain: Jacksboro',
    file: 'jacksboro_dem.ply',
    field: 'file:elevation',
    epsilon: 0.1,
    levels: 12,
    view: [0, 0.95, 0.5],
  },
  {
    id: 'lysozyme',
    label: 'Protein: lysozyme',
    file: 'lysozyme_potential.ply',
    field: 'file:potential',
    epsilon: 0.01,
    levels: 12,
    view: [0.3, 0.3, 1],
  },
];

/** For meshes that we know nothing about. */
export const DEFAULT_VIEW: Example['view'] = [0.55, 0.5, 0.9];

export async function fetchExample(example: Example): Promise<File> {
  const response = await fetch(new URL(`examples/${example.file}`, document.baseURI));
  if (!response.ok) throw new Error(`${example.file}: the server answered ${response.status}`);
  return new File([await response.blob()], example.file);
}
