/**
 * The worker's side of pictures: what to draw, as `morse-smooth/snapshot` says it, for the page's viewer; and the pictures that it
 * makes itself. Colors, shapes, widths and sizes are its business, and neither the worker's nor the viewer's.
 */
import type { DrawList, Lines, Scene, SnapshotOptions } from 'morse-smooth/snapshot';
import { omitting } from './gaps';
import type { Look, Part, PictureView, Settings } from './protocol';

/** Of what has changed: grey where nothing has, and so seen on white. */
const DIFFERENCE = 'coolWarm';

/** A list with one solid of each kind, for the signs that the page puts up itself. */
export function lookOf(scene: Scene, vertexCount: number, triangles: Uint32Array): Look {
  const [vertex] = triangles;
  const { solids, size, light } = scene.drawList(new Float64Array(vertexCount), {
    levels: [],
    criticalPoints: vertex !== undefined && {
      vertices: new Uint32Array(3).fill(vertex),
      kinds: Int8Array.of(-1, 0, 1),
    },
  });
  return { surface: scene.surface(), solids, size, light };
}

export const levelLines = ({ lines }: DrawList): Lines | null => lines.find(({ kind }) => kind === 'levels') ?? null;

export const complexLines = ({ lines }: DrawList): Lines[] => lines.filter(({ kind }) => kind !== 'levels');

/** A field without a range colors everything alike. */
export const rangeOption = ([low, high]: readonly [number, number]): { range?: [number, number] } =>
  low < high ? { range: [low, high] } : {};

/** After − before, with the middle of the colors where nothing has changed. */
export function differencePart(scene: Scene, before: Float64Array, after: Float64Array): Part {
  const difference = after.map((value, i) => value - before[i]!);
  const largest = difference.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
  const { shades, colors, gap } = scene.drawList(difference, {
    ...rangeOption([-largest, largest]),
    colormap: DIFFERENCE,
    levels: [],
    criticalPoints: false,
    ...omitting(difference),
  });
  return { kind: 'difference', largest, shades, colors, gap };
}

/** Everything that a picture is of. */
export interface Subject {
  before: Float64Array;
  after: Float64Array | null;
  /** Of the colors: that of the field before. */
  range: [number, number];
  levels: ArrayLike<number>;
  title: string;
}

/** As a PNG file: both fields and what has changed, side by side, or the one field that there is. */
export function pictureOf(scene: Scene, subject: Subject, settings: Settings, view: PictureView): Uint8Array {
  const { before, after, range, levels, title } = subject;
  const { colormap, bands, complex, persistence } = settings;
  const options: SnapshotOptions & { levels: Float64Array; criticalPoints: boolean } = {
    ...rangeOption(range),
    colormap,
    bands,
    // Bands are between levels, with or without their lines.
    levels: Float64Array.from(view.levels || bands ? levels : []),
    criticalPoints: view.glyphs,
    title,
    ...omitting(before),
    ...(view.camera && { camera: view.camera }),
  };
  if (!after) return scene.snapshot(before, { ...options, morseComplex: complex && { persistence } });
  return scene.sheet(before, after, {
    ...options,
    morseComplex: complex && { persistence },
    differenceColormap: DIFFERENCE,
  });
}
