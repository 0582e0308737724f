/**
 * Files of meshes, fields and tables: bytes in, plain arrays out, and back. A WebAssembly module of its own, which needs nothing of the
 * main entry; `new TriMesh(file.positions, file.triangles)` there makes a mesh of what was read.
 *
 * @module
 */

import type {
  Diagnostic,
  Ids,
  InitOptions,
  Numbers,
  OwnFloat64Array,
  OwnUint32Array,
  OwnUint8Array,
  Weld,
} from './index.js';

export { MorseSmoothError } from './index.js';
export type { Diagnostic } from './index.js';

/**
 * Loads the WebAssembly module of the files, which is another one than that of the package's main entry. In a browser, wait for it
 * before any other call (otherwise `NotInitialized`); in Node the first call does it by itself.
 *
 * @throws `LoadFailed` where the module cannot be fetched or compiled.
 */
export default function init(options?: InitOptions): Promise<void>;

/** The bytes of a file, as `fetch` and file pickers give them, or as views (a `DataView`, or an array with one byte per entry, such as Node's `Buffer`). */
export type Bytes = ArrayBuffer | Uint8Array | Uint8ClampedArray | Int8Array | DataView;

/** What there is of a format. */
export interface FormatInfo {
  /** Its name, as the option `format` takes it. */
  name: string;
  /** The usual endings of its files, without a dot. */
  extensions: string[];
  reads: boolean;
  writes: boolean;
  /** One line for people. */
  description: string;
}

/** Everything that can be read or written: formats of meshes, then those of fields and tables. */
export function formats(): FormatInfo[];

/** The names of file formats for meshes. */
export type MeshFormat =
  'obj' | 'off' | 'ply' | 'stl' | 'vtk' | 'vtp' | 'vtu' | 'glb' | 'msh' | 'gii' | 'freesurfer' | 'asc';

/** Those of them that can be written. */
export type WritableMeshFormat = 'obj' | 'off' | 'ply' | 'stl' | 'vtk' | 'vtp' | 'glb';

/** The names of file formats for fields and tables. */
export type TableFormat = 'txt' | 'csv' | 'npy' | 'gii' | 'curv';

/** What {@link readMesh} found. Nothing has been checked as a mesh: `new TriMesh(…)` of the main entry does that. */
export interface MeshFile {
  /** x, y, z of every vertex, one after the other. */
  positions: OwnFloat64Array;
  /** Three vertices for every triangle, numbered from 0. */
  triangles: OwnUint32Array;
  /**
   * One value per vertex, by name. Missing values are NaN, with a warning. Components of an array `v` are `v_0`, `v_1`, …, and of a
   * vector also `v_magnitude`.
   */
  fields: Record<string, OwnFloat64Array>;
  /** One value per triangle, by name: where a face became several triangles, each has its value. */
  triangleFields: Record<string, OwnFloat64Array>;
  /**
   * For every vertex its number in the file, null where they are the same: vertices inside of volumes are left out, and those that are
   * nowhere; of welded ones it is the first. `Float64Array.from(vertexMap, (v) => values[v])` takes values from the file's vertices.
   */
  vertexMap: OwnUint32Array | null;
  format: MeshFormat;
  /** What was left out or put right. What is to be said of the mesh itself, `TriMesh.warnings` has. */
  warnings: Diagnostic[];
}

/** What {@link readMesh} takes. */
export interface ReadMeshOptions {
  /** Taken at its word. Default: recognised from the content, or else from the ending of `fileName`. */
  format?: MeshFormat;
  /** Only its ending matters. */
  fileName?: string;
  /**
   * Whether vertices that lie together become one, as in the constructor of `TriMesh`; their values become the mean, with a
   * warning (`WeldedValues`) where these differ by more than rounding. Default `false`.
   */
  weld?: Weld;
  /** `"average"` adds fields on triangles to `fields`: means weighted by area, with a warning. Default `"keep"`. */
  triangleFields?: 'keep' | 'average';
}

/**
 * Reads a mesh and the fields that come with it, of any of the {@link formats}, also within gzip. Polygons are cut into triangles; of
 * cells that fill a volume the outer surface is read.
 *
 * @throws the codes for files of {@link MorseSmoothError.code}; with `weld` those for meshes, too
 */
export function readMesh(bytes: Bytes, options?: ReadMeshOptions): MeshFile;

/** What {@link readTable} takes. */
export interface ReadTableOptions {
  /** The format. Default: told from the content, and `"csv"` where `fileName` ends so. */
  format?: TableFormat;
  /** Only its ending matters. */
  fileName?: string;
}

/** What {@link readField} takes. */
export interface ReadFieldOptions extends ReadTableOptions {
  /** The column of a table: its name, or its number from 0. Default: the only column of numbers. */
  column?: string | number;
  /** The vertices of the mesh that the field is for; another number of values is an error, which says what may have happened. */
  vertices?: number;
  /** The triangles of that mesh, by which values for triangles are recognised. */
  triangles?: number;
}

/**
 * Reads a field: numbers in lines, or a column of a table as {@link readTable} reads it. `nan` and empty cells are missing values, NaN in
 * the field.
 *
 * @throws `AmbiguousColumn` with the `columns` where there are several of numbers and none is named; `InvalidNumber` with the `line`;
 * `WrongRowCount`; `NonFiniteValue` with the `vertex` for what is infinite; `UnknownColumn`; `EmptyFile`
 */
export function readField(bytes: Bytes, options?: ReadFieldOptions): OwnFloat64Array;

/** What {@link readTable} found. */
export interface TableFile {
  /**
   * Every column of numbers by its name in the first line, or by its number from 0 where that line holds numbers. Missing values are
   * NaN.
   */
  columns: Record<string, OwnFloat64Array>;
  warnings: Diagnostic[];
}

/**
 * Reads all columns of a table: between commas, semicolons, tabs, bars or blanks, with decimal points or commas, with or without a
 * header, in UTF-8 or UTF-16, as told from the whole of it; or an array of NumPy, or values of GIFTI or FreeSurfer. Empty cells, `nan` and
 * `NA` are missing values. Columns of text are left out, with a warning.
 *
 * @throws `InvalidSyntax` with the `line` for a row with another number of cells than the first; `MissingElement` where there are no
 * numbers; `EmptyFile`
 */
export function readTable(bytes: Bytes, options?: ReadTableOptions): TableFile;

/** A mesh to be written: what {@link readMesh} gives, or the arrays of a `TriMesh`. */
export interface MeshArrays {
  positions: Numbers;
  triangles: Ids;
}

/** What {@link writeMesh} takes. */
export interface WriteMeshOptions {
  format: WritableMeshFormat;
  /** Fields to write along, by name; PLY, VTK, VTP and GLB have room for them (otherwise `FieldsNotSupported`). */
  fields?: Record<string, Numbers>;
  /** Whether the file is binary, as PLY, STL, VTK and VTP can be (otherwise `BinaryNotSupported`) and GLB always is. Default `false`. */
  binary?: boolean;
  /** What NaN in a field means: `"omit"` writes it as it is, for there is no value. Default `"error"` (`NonFiniteValue`). */
  missing?: 'error' | 'omit';
}

/**
 * Writes a mesh, and fields where the format has room for them, in double precision (binary STL and GLB: single). PLY has plain
 * names, and the true ones in comments; an empty name becomes `field`, and a name that is there already gets a number.
 *
 * @throws the codes for meshes of {@link MorseSmoothError.code}, but for those of areas; `LengthMismatch`, `NonFiniteValue`
 */
export function writeMesh(mesh: MeshArrays, options: WriteMeshOptions): OwnUint8Array;
