// Compiled, never run: the API of the pictures as a user writes it, and what must not compile.
import { MorseSmoothError as CoreError, TriMesh } from 'morse-smooth';
import init, { MorseSmoothError, Scene, sheet, snapshot } from 'morse-smooth/snapshot';
import type * as api from 'morse-smooth/snapshot';

/** Compiles only where the two types are the same. */
function same<A, B>(_: [A] extends [B] ? ([B] extends [A] ? true : never) : never): void {}

const ready: Promise<void> = init({ wasm: new URL('https://example.org/morse_smooth_snapshot_bg.wasm') });
same<typeof MorseSmoothError, typeof CoreError>(true);
const isOurs = (error: unknown): error is CoreError => error instanceof MorseSmoothError;
// @ts-expect-error there is no such option
await init({ url: '/x.wasm' });

// ----------------------------------------------------------------------------------------------------------- pictures
const mesh = new TriMesh(new Float32Array(9), [0, 1, 2]);
const [positions, triangles, heat] = [mesh.positions(), mesh.triangles(), new Float64Array(3)];
const png: Uint8Array = snapshot(positions, triangles, heat);
// Of memory that is shared with no other thread, which a Blob wants.
export const blob = new Blob([snapshot(positions, triangles, heat), sheet(positions, triangles, heat, heat)]);
snapshot([0, 0, 0, 1, 0, 0, 0, 1, 0], new Uint16Array(3), [1, 2, 3] as const, {});
const camera: api.Camera = { direction: [1, 2, 3], up: [0, 0, 1] as const };
const options: api.SnapshotOptions = {
  width: 300,
  height: 200,
  colormap: 'coolWarm',
  range: [0, 1] as const,
  levels: { count: 7 },
  bands: true,
  criticalPoints: true,
  morseComplex: { persistence: 0.1 },
  colorBar: false,
  title: 'heat',
  camera,
};
snapshot(positions, triangles, heat, options);
snapshot(positions, triangles, heat, { levels: [0, 0.5], criticalPoints: false, morseComplex: true, camera: {} });
snapshot(positions, triangles, heat, {
  levels: mesh.levelSets(heat, { count: 3 }),
  criticalPoints: mesh.criticalPoints(heat, { delta: 0.1 }),
  morseComplex: mesh.morseComplex(heat, { persistence: 0.1, paths: 'merged' }),
});
snapshot(positions, triangles, heat, { criticalPoints: { vertices: new Uint32Array(1), kinds: Int8Array.of(-1) } });
const names: api.Colormap[] = [
  'viridis',
  'cividis',
  'magma',
  'inferno',
  'plasma',
  'coolWarm',
  'blueRed',
  'purpleGreen',
];
// @ts-expect-error values have no default
snapshot(positions, triangles);
// @ts-expect-error one of eight
snapshot(positions, triangles, heat, { colormap: 'jet' });
// @ts-expect-error there is no such option
snapshot(positions, triangles, heat, { colourmap: 'viridis' });
// @ts-expect-error two numbers
snapshot(positions, triangles, heat, { range: [0, 1, 2] });
// @ts-expect-error the levels of saddles are found by `levelSets`
snapshot(positions, triangles, heat, { levels: { saddles: true } });
// @ts-expect-error relative to the range
snapshot(positions, triangles, heat, { morseComplex: { persistence: 1, persistenceIs: 'absolute' } });
// @ts-expect-error a mesh has no kinds
snapshot(positions, triangles, heat, { criticalPoints: { vertices: new Uint32Array(1) } });
// @ts-expect-error three numbers
snapshot(positions, triangles, heat, { camera: { direction: [1, 2] } });
// @ts-expect-error a snapshot is one picture
snapshot(positions, triangles, heat, { titles: ['a', 'b', 'c'] });

const all: api.SheetOptions = {
  ...{ width: 300, height: 200, title: 'one step', camera, levels: { count: 5 } },
  titles: ['noisy', 'smooth', 'noise'] as const,
  differenceColormap: 'purpleGreen',
  largestDifference: 0.5,
};
const wide: Uint8Array = sheet(positions, triangles, heat, [1, 2, 3], all);
// @ts-expect-error three pictures
sheet(positions, triangles, heat, heat, { titles: ['a', 'b'] });
// @ts-expect-error lines of one field
sheet(positions, triangles, heat, heat, { levels: mesh.levelSets(heat, { count: 3 }) });
// @ts-expect-error points of one field
sheet(positions, triangles, heat, heat, { criticalPoints: mesh.criticalPoints(heat) });

// -------------------------------------------------------------------------------------------------------------- scenes
const scene = new Scene(positions, triangles);
same<ReturnType<typeof scene.snapshot>, Uint8Array<ArrayBuffer>>(true);
scene.snapshot(heat, options);
scene.sheet(heat, heat, all);
// @ts-expect-error positions and triangles, as the two modules share no memory
new Scene(mesh);

const surface: api.Surface = scene.surface();
const { normals, vertices, up, center, scale } = surface;
same<[typeof normals, typeof vertices, typeof up], [Float32Array<ArrayBuffer>, Uint32Array<ArrayBuffer>, 'y' | 'z']>(
  true,
);
same<[typeof center, typeof scale], [[number, number, number], number]>(true);

const drawing: api.DrawOptions = { levels: [1, 2], bands: true, colormap: names[0], range: [0, 1] };
const list: api.DrawList = scene.drawList(heat, drawing);
const { shades, colors, gap, range, levels, lines, solids, size, light } = list;
same<typeof levels, Float64Array<ArrayBuffer>>(true);
same<typeof gap, number | null>(true);
same<
  [typeof shades, typeof colors, typeof range],
  [Float32Array<ArrayBuffer>, Uint8Array<ArrayBuffer>, [number, number]]
>(true);
same<[typeof lines, typeof solids], [api.Lines[], api.Solids[]]>(true);
same<[typeof size, typeof light], [api.SolidSize, api.Light]>(true);
same<api.Lines['kind'], 'levels' | 'descending' | 'ascending'>(true);
same<api.Solids['kind'], 'minima' | 'saddles' | 'maxima'>(true);
const stroke: api.Stroke = lines[0]!.stroke;
const casing: number | undefined = stroke.casing?.width;
const { shape, rim, glow, places, axes, radius, lift } = solids[0]!;
same<
  [typeof shape.triangles, typeof places, typeof axes],
  [Uint32Array<ArrayBuffer>, Float32Array<ArrayBuffer>, Float32Array<ArrayBuffer>]
>(true);
// @ts-expect-error a list is the same from everywhere
scene.drawList(heat, { camera });
// @ts-expect-error and of no size
scene.drawList(heat, { width: 300 });

{
  using scoped = new Scene(positions, triangles);
  void scoped;
}
scene.free();

export const used = [ready, isOurs, png, wide, casing, rim.color, glow, radius, lift, size.cover, light.direction];
