/** The names of file formats for meshes. */
export type MeshFormat = 'obj' | 'off' | 'ply' | 'vtk';

/** Something in the input that was put right or left out. */
export interface Diagnostic {
  /** Stable name. */
  code: string;
  /** One sentence for people. */
  message: string;
  /** How many there are. */
  count: number;
  /** Numbers of the first few. */
  examples: number[];
}

/** What {@link readMesh} found. `using file = readMesh(…)` frees its mesh at the end. */
export interface MeshFile extends Disposable {
  mesh: TriMesh;
  /** Per-vertex numbers of the file, by their name there. */
  fields: Record<string, Float64Array>;
  format: MeshFormat;
  warnings: Diagnostic[];
}

/** What {@link readMesh} takes. */
export interface ReadMeshOptions {
  /** Taken at its word. Default: recognised from the content, or else from the ending of `fileName`. */
  format?: MeshFormat;
  /** Only its ending matters. */
  fileName?: string;
  /**
   * Whether vertices that lie together become one, as in the constructor of {@link TriMesh}; their values become the mean, with a
   * warning (`WeldedValues`) where these differ by more than rounding. Default `false`.
   */
  weld?: Weld;
}

/**
 * Reads a mesh and the fields that come with it: OBJ, OFF, PLY (text, binary of both byte orders), legacy VTK PolyData (text,
 * binary). Polygons are cut into triangles.
 *
 * @throws the codes for files and for meshes of {@link MorseSmoothError.code}
 */
export function readMesh(bytes: Uint8Array, options?: ReadMeshOptions): MeshFile;

/** What {@link readField} takes. */
export interface ReadFieldOptions {
  /** The format. Default: told from the content. */
  format?: 'txt' | 'csv';
  /** The column of a table: its name in the first line, or its number from 0. Default: the first column of numbers. */
  column?: string | number;
}

/**
 * Reads a field from text: numbers with blanks or line ends between them, or a column of a table with commas, semicolons or tabs.
 * `nan` is a missing value, NaN in the field.
 *
 * @throws `InvalidNumber` with the `line`; `NonFiniteValue` with the `vertex` for what is infinite; `UnknownColumn`; `EmptyFile`
 */
export function readField(bytes: Uint8Array, options?: ReadFieldOptions): Float64Array;

/** What {@link writeMesh} takes. */
export interface WriteMeshOptions {
  format: MeshFormat;
  /** Fields to write along, by name; PLY and VTK have room for them (otherwise `FieldsNotSupported`). */
  fields?: Record<string, Numbers>;
  /** Whether the file is binary, as PLY and VTK can be (otherwise `BinaryNotSupported`). Default `false`. */
  binary?: boolean;
  /** What NaN in a field means: `"omit"` writes it as it is, for there is no value. Default `"error"` (`NonFiniteValue`). */
  missing?: 'error' | 'omit';
}

/**
 * Writes a mesh, and fields where the format has room for them, in double precision. In PLY names, blanks become `_`; an empty
 * name becomes `field`, and a name that is there already (in PLY also `x`, `y`, `z`) gets a number.
 */
export function writeMesh(mesh: TriMesh, options: WriteMeshOptions): Uint8Array;
