/**
 * What the page and its worker say to each other.
 *
 * The page sends one request at a time and the worker answers each with any number of parts, then `done` or `failed`.
 * Only what changed is sent, so that a δ slider does not resend the mesh.
 */
import type { CriticalCounts, Diagnostic, Link, MeshFormat, MeshTopology, Metric, SmoothReport } from 'morse-smooth';

export type Side = 'before' | 'after';

/** Everything that the numbers on the page depend on. `field` is a key of `MeshSummary.fields`. */
export interface Settings {
  field: string;
  metric: Metric;
  epsilon: number;
  /** Relative to the largest difference over an edge. */
  delta: number;
  link: Link;
  /** Number of level sets. */
  levels: number;
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
  warnings: Diagnostic[];
}

/** The mesh as the graphics card wants it: centred, scaled into the unit ball, single precision. */
export interface DisplayMesh {
  positions: Float32Array<ArrayBuffer>;
  triangles: Uint32Array<ArrayBuffer>;
  /** Area of the scaled mesh: glyphs are sized by the room that there is. */
  area: number;
  /** Which coordinate points up: z for things that lie flat, such as terrain. */
  up: 'y' | 'z';
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
  | { kind: 'save' };

export type Part =
  | { kind: 'mesh'; summary: MeshSummary; mesh: DisplayMesh }
  | { kind: 'fields'; fields: FieldEntry[]; chosen: string }
  /** A new field: whatever was shown as its smoothed version is out of date. */
  | { kind: 'values'; side: Side; label: string; range: [number, number]; shades: Float32Array<ArrayBuffer> }
  | {
      kind: 'critical';
      side: Side;
      vertices: Uint32Array<ArrayBuffer>;
      kinds: Int8Array<ArrayBuffer>;
      counts: CriticalCounts;
      delta: number;
    }
  | { kind: 'lines'; side: Side; segments: Float32Array<ArrayBuffer>; levels: number[] }
  | { kind: 'report'; report: SmoothReport; milliseconds: number }
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
