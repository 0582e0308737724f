/**
 * What the page and its worker say to each other.
 *
 * The page sends one request at a time and the worker answers each with any number of parts, then `done` or `failed`.
 * Only what changed is sent, so that a δ slider does not resend the mesh.
 */
import type {
  ChosenEpsilon,
  CriticalCounts,
  Diagnostic,
  EpsilonRule,
  Link,
  MeshTopology,
  Prescribed,
  SmoothReport,
} from 'morse-smooth';
import type { MeshFormat } from 'morse-smooth/files';
import type { Camera, Colormap, DrawList, Lines, Solids, Surface } from 'morse-smooth/snapshot';
import type { Method, Smoothing } from './smoothing/settings';

/** What the numbers of critical points are compared with. */
export type Shape = Pick<MeshTopology, 'eulerCharacteristic' | 'closed'>;

export type Side = 'before' | 'after';
/** What colors the surface: the values, the basins of one kind of extremum or, on the right, what has changed. */
export type Coloring = 'value' | 'minima' | 'maxima' | 'difference';
/** Where the level sets are: evenly over the range, or on either side of saddles. */
export type LevelPlaces = 'even' | 'saddles';

/** Pairs that are kept or dropped whatever the threshold says, by their extremum. */
export interface Overrides {
  kept: number[];
  dropped: number[];
}

/** Everything that the numbers on the page depend on. `field` is a key of `MeshSummary.fields`. */
export interface Settings extends Smoothing {
  field: string;
  /** Relative to the largest difference over an edge. */
  delta: number;
  link: Link;
  /** Number of level sets; with `levelPlaces` at saddles, the number of saddles. */
  levels: number;
  levelPlaces: LevelPlaces;
  /** Pairs of persistence above it are kept; relative to the range. */
  persistence: number;
  overrides: Overrides;
  coloring: Coloring;
  /** Of the colors by value. */
  colormap: Colormap;
  /** One color between two levels. */
  bands: boolean;
  /** Whether the Morse complex is shown, and so has to be computed. */
  complex: boolean;
  /** Whether a pair was ever pointed at, so that the ways between pairs are wanted. */
  paths: boolean;
}

/** What became of the field; null where the method has no such thing. Norms and differences are of the field scaled to [0, 1]. */
export interface AfterReport {
  method: Method;
  /** What the numbers are about. */
  settings: Pick<Smoothing, 'metric' | 'energy'> & { isDiffusion: boolean };
  before: CriticalCounts;
  after: CriticalCounts;
  lInfinity: number;
  sobolevBefore: number;
  sobolevAfter: number;
  /** Constrained vertices without their stars. */
  features: number | null;
  /** Null where a field is simplified. */
  smoothing: SmoothReport | null;
  pairsRemoved: number | null;
  /** Extrema that were to go, and without which there is no field on the mesh. */
  unavoidable: number | null;
  /** Of the method with exactly the chosen extrema. */
  exact: ExactReport | null;
  milliseconds: number;
}

/** What the package says of a field with exactly the chosen extrema. */
export type ExactReport = Omit<Prescribed, 'values' | 'report' | 'reports'>;

/** The constrained vertices, ascending: those that a rule found, with their values, and all with those next to them. */
export interface Found {
  features: Uint32Array<ArrayBuffer>;
  values: Float64Array<ArrayBuffer>;
  all: Uint32Array<ArrayBuffer>;
}

/** Why there is no field on the right though nothing went wrong. */
export type Unsmoothed = Failure;

/** Steps over the relative δ: row k holds from `delta[k]` up to, not including, `delta[k + 1]`. */
export interface Steps {
  delta: Float64Array<ArrayBuffer>;
  minima: Uint32Array<ArrayBuffer>;
  maxima: Uint32Array<ArrayBuffer>;
  saddles: Uint32Array<ArrayBuffer>;
}

/** Critical points at every δ. */
export interface Hierarchy extends Steps {
  vertices: Uint32Array<ArrayBuffer>;
  kinds: Int8Array<ArrayBuffer>;
  vanishesAt: Float64Array<ArrayBuffer>;
  /** The field's value at each vertex. */
  values: Float64Array<ArrayBuffer>;
}

/** Pairs of critical points, the most persistent one first, and what has no partner. */
export interface Pairs {
  extrema: Uint32Array<ArrayBuffer>;
  saddles: Uint32Array<ArrayBuffer>;
  /** −1 minimum and saddle, 1 saddle and maximum. */
  kinds: Int8Array<ArrayBuffer>;
  birth: Float64Array<ArrayBuffer>;
  death: Float64Array<ArrayBuffer>;
  persistence: Float64Array<ArrayBuffer>;
  essential: Uint32Array<ArrayBuffer>;
  /** −1 minimum, 0 saddle, 1 maximum. */
  essentialKinds: Int8Array<ArrayBuffer>;
  essentialValues: Float64Array<ArrayBuffer>;
}

/** The lines of the Morse complex, whole, each with its two ends. */
export interface Arcs {
  /** Line k has the vertices `offsets[k]` up to, not including, `offsets[k + 1]`. */
  vertices: Uint32Array<ArrayBuffer>;
  offsets: Uint32Array<ArrayBuffer>;
  saddles: Uint32Array<ArrayBuffer>;
  extrema: Uint32Array<ArrayBuffer>;
  /** −1 to a minimum, 1 to a maximum. */
  kinds: Int8Array<ArrayBuffer>;
  /** The value at the saddle of each line. */
  heights: Float64Array<ArrayBuffer>;
}

/** What becomes of the field along ε; NaN where it is not known yet. Norms are of the field scaled to [0, 1]. */
export interface EpsilonCurve {
  epsilons: Float64Array;
  /** ‖x − f‖. */
  distances: Float64Array;
  /** ‖Lx‖. */
  roughness: Float64Array;
  minima: Float64Array;
  maxima: Float64Array;
  saddles: Float64Array;
}

export interface FieldEntry {
  key: string;
  label: string;
  origin: 'file' | 'added' | 'coordinate';
}

export interface MeshSummary {
  name: string;
  format: MeshFormat;
  vertexCount: number;
  edgeCount: number;
  triangleCount: number;
  topology: MeshTopology;
  /** The mean length of the triangles' sides, in the units of the mesh. */
  meanEdge: number;
  warnings: Diagnostic[];
}

/** How the mesh and the signs on it are drawn. */
export interface Look extends Pick<DrawList, 'size' | 'light'> {
  surface: Surface;
  /** One of each kind. */
  solids: Solids[];
}

/** How the page looks at the mesh, where a picture is to be the same. */
export interface PictureView {
  /** Null where the page has no view. */
  camera: Required<Camera> | null;
  glyphs: boolean;
  levels: boolean;
}

export interface Failure {
  code: string;
  message: string;
}

export type Request =
  /** `added`: fields from other files. `smooth` false: classify only, until the next update. */
  | { kind: 'open'; file: File; added: File[]; settings: Settings; smooth: boolean }
  | { kind: 'addField'; file: File; settings: Settings }
  | { kind: 'update'; settings: Settings }
  /** For another ε or, with exact extrema, another choice alone, while that moves. `whole`: all that the side after shows, not only what can be had in a frame's time. */
  | { kind: 'preview'; settings: Settings; whole: boolean }
  | { kind: 'choose'; rule: EpsilonRule }
  | { kind: 'save' }
  | { kind: 'picture'; view: PictureView };

export type Part =
  | { kind: 'mesh'; summary: MeshSummary; look: Look }
  | { kind: 'fields'; fields: FieldEntry[]; chosen: string }
  /**
   * A new field: whatever was shown as its smoothed version is out of date. `range`: of the colors; `shades` and `gap`, the color of
   * gaps: see `DrawList`. `gaps`: how many vertices have no value.
   */
  | {
      kind: 'values';
      side: Side;
      label: string;
      range: [number, number];
      shades: Float32Array;
      gap: number | null;
      gaps: number;
    }
  /** Of the field before, for both sides: see `DrawList`. */
  | { kind: 'colors'; colors: Uint8Array; bands: boolean }
  /** `counts` and `solids`: at δ = 0. `shape`: of the part of the mesh that has values. */
  | { kind: 'hierarchy'; side: Side; counts: CriticalCounts; hierarchy: Hierarchy; solids: Solids[]; shape: Shape }
  | { kind: 'pairs'; range: [number, number]; pairs: Pairs }
  /** Of the field after. */
  | { kind: 'pairsAfter'; pairs: Pairs }
  /** `levels`: ascending. */
  | { kind: 'lines'; side: Side; lines: Lines | null; levels: number[] }
  | { kind: 'complex'; side: Side; lines: Lines[] }
  /** Of the field before. */
  | { kind: 'arcs'; arcs: Arcs }
  /** `colors`: for each vertex the number of a color; 255 where it belongs to no basin. */
  | { kind: 'basins'; side: Side; colors: Uint8Array<ArrayBuffer>; count: number }
  /** Of the methods with constraints. */
  | { kind: 'constraints'; found: Found }
  /**
   * After − before: `largest` without its sign, in units of the field; the middle of the colors is where nothing has changed. What
   * has no value on either side has gaps.
   */
  | { kind: 'difference'; largest: number; shades: Float32Array; colors: Uint8Array; gap: number | null }
  | { kind: 'report'; report: AfterReport }
  | { kind: 'unsmoothed'; reason: Unsmoothed }
  /** Whether there are the smoothed fields of all ε. `why` not. `error`: the largest one, estimated, relative to the field. */
  | { kind: 'family'; state: 'none' | 'coming' | 'growing' | 'complete'; why: string; error: number }
  | { kind: 'epsilonCurve'; curve: EpsilonCurve }
  /** What rules come to. */
  | { kind: 'choices'; choices: ChosenEpsilon[] }
  /** The answer to `choose`. */
  | { kind: 'chosen'; choice: ChosenEpsilon }
  /** Comes before what is shown on the way; `error` as above, null for a field with exactly the chosen extrema. */
  | { kind: 'previewed'; error: number | null }
  /** Critical points at δ; everything else of the side after is out of date. */
  | { kind: 'preview'; shades: Float32Array; vertices: Uint32Array; kinds: Int8Array; counts: CriticalCounts }
  | { kind: 'saved'; name: string; bytes: Uint8Array<ArrayBuffer> };

export type Reply =
  /** The WebAssembly module is loaded; nothing is answered before. */
  | { kind: 'started'; version: string }
  | { kind: 'part'; part: Part }
  /** How far a long computation has come, 0 to 1. */
  | { kind: 'progress'; fraction: number }
  /** `settings` is what the worker holds now, so that the controls can go back to it after a failure; null before the first mesh. */
  | { kind: 'done'; settings: Settings | null }
  | { kind: 'failed'; failure: Failure; settings: Settings | null };
