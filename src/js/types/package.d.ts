/// <reference lib="esnext.disposable" />

/**
 * Critical points, level sets and smoothing of scalar fields on triangle meshes. Arrays in, arrays out: files are read and written by
 * `morse-smooth/files`, pictures drawn by `morse-smooth/snapshot`, each a WebAssembly module of its own.
 *
 * A *field* has one number per vertex, in the order of the mesh's vertices. Vertices and triangles are numbered from 0. Lengths
 * are in the units of the positions, values in the units of the field; nothing is rescaled unless a comment says so. Every array
 * that comes out is a copy of the caller's own: changing it changes nothing here, and nothing done here later changes it.
 * Whatever fails throws a {@link MorseSmoothError}. An option that does not exist fails with `UnknownOption`, one out of its range
 * with `InvalidOption`, one that means nothing for what was asked with `InapplicableOption`.
 *
 * @module
 */

/** A typed array of integers. Those of `BigInt`s are none, and are refused (`InvalidArgument`). */
export type Integers = Int8Array | Uint8Array | Uint8ClampedArray | Int16Array | Uint16Array | Int32Array | Uint32Array;
/** Numbers as they are taken. The entries of an ordinary array must all be of type `number` (otherwise `InvalidArgument`). */
export type Numbers = Float64Array | Float32Array | Integers | readonly number[];
/**
 * Vertex numbers as they are taken: whole, from 0 to 2³² − 1 (otherwise `IndexOutOfBounds`). Arrays of floating-point numbers are refused
 * (`InvalidArgument`); they are among the types because TypeScript does not know of the `array` of an index of three.js that it is none.
 */
export type Ids = Numbers;

// Arrays as they come out. Their memory is the caller's own and shared with no other thread: since TypeScript 5.7 their types say so
// (`Float64Array<ArrayBuffer>`), and older ones know no such type.
export type OwnFloat64Array = ReturnType<typeof Float64Array.of>;
export type OwnFloat32Array = ReturnType<typeof Float32Array.of>;
export type OwnUint32Array = ReturnType<typeof Uint32Array.of>;
export type OwnUint8Array = ReturnType<typeof Uint8Array.of>;
export type OwnInt8Array = ReturnType<typeof Int8Array.of>;

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

/** How far a long call has come. */
export interface Progress {
  /** What is being done: `"field"` is reading a field, by any of the analyses; the others are the steps of a smoothing. */
  phase: 'analysis' | 'factorization' | 'solve' | 'report' | 'field';
  /** How much of the whole is done, from 0 to 1; it never goes back. */
  fraction: number;
}

/** What every long call takes. */
export interface ProgressOptions {
  /**
   * The function that is called every few milliseconds while work goes on. Where it returns `false` the work stops and the call fails
   * with `Cancelled`; what it throws stops the work, too, and comes out of the call as it is. All objects stay as they were before
   * the call, and usable.
   */
  onProgress?: (progress: Progress) => void | boolean;
}

/** What to make of values that are missing, which are `NaN`. An infinite value is always an error (`NonFiniteValue`). */
export interface MissingOptions {
  /**
   * `"error"` (default): a missing value fails with `NonFiniteValue` (`vertex`). `"omit"`: triangles with a missing vertex are left
   * out, as if the mesh had a hole there; what is asked about such a vertex fails with `MissingValue` (`vertex`).
   */
  missing?: 'error' | 'omit';
}

/** What every analysis of a field takes. */
export type AnalysisOptions = MissingOptions & ProgressOptions;

/**
 * Loads the WebAssembly module. In a browser, wait for it before any other call (otherwise `NotInitialized`); in Node the first call
 * of anything does it by itself. Calling it again is free and gives the same promise; after a failure it tries anew.
 *
 * Where a call failed inside the module with `InternalError`, that instance of the module is lost: all calls on its objects fail with
 * `InstanceLost`, and `free` does nothing. Call `init` again then, which makes another instance (of the code at hand, unless
 * `options.wasm` gives other code), and make the objects anew. In Node another instance is made by itself for the next new object.
 *
 * @throws `LoadFailed` where the module cannot be fetched or compiled; `detail` has the `url`, and the `status` if a server answered.
 */
export default function init(options?: InitOptions): Promise<void>;

/** What {@link init} takes. */
export interface InitOptions {
  /**
   * Where the module's file is, or its content: `morse_smooth_bg.wasm`, for `morse-smooth/files` `morse_smooth_files_bg.wasm`, for
   * `morse-smooth/snapshot` `morse_smooth_snapshot_bg.wasm`. Without it the file beside the script is fetched, or where it cannot be had
   * a copy in a script is imported; with `morse-smooth/inline` nothing is fetched. Node, which has the copy, passes it by.
   */
  wasm?:
    string | Global<'URL'> | Global<'Request'> | Global<'Response'> | ArrayBuffer | ArrayBufferView | CompiledModule;
}

/** An object of a class of the platform, in projects that have the platform's types. */
type Global<Name extends string> = typeof globalThis extends Record<Name, { prototype: infer Type }> ? Type : never;
/** A `WebAssembly.Module`, likewise. */
type CompiledModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer Type } } } ? Type : never;

/** The version of this package, such as `"0.1.0"`. */
export const version: string;

/** Any failure of this package. */
export class MorseSmoothError extends Error {
  /** The constructor is for code that carries errors across threads; this package makes its own errors. */
  constructor(code: string, message: string, detail?: Record<string, unknown>, options?: { cause?: unknown });
  /**
   * Names the failure for programs; stays the same while messages improve.
   *
   * - files: `EmptyFile`, `UnknownFormat`, `UnsupportedFormat`, `UnsupportedFeature`, `Truncated`, `UnexpectedEnd`,
   *   `InvalidNumber`, `InvalidSyntax`, `DamagedData`, `MissingElement`, `FaceIndexOutOfBounds`, `UnknownColumn`, `AmbiguousColumn`
   *   (`columns` that there are), `WrongRowCount`, `TooLarge`, `FieldsNotSupported`, `BinaryNotSupported`
   * - meshes: `EmptyMesh`, `PositionsNotTriples`, `TrianglesNotTriples`, `TooManyElements`, `NonFinitePosition`,
   *   `PositionOverflow`, `IndexOutOfBounds`, `ZeroArea`, `ZeroWeightSum`
   * - fields: `LengthMismatch`, `NonFiniteValue`, `MissingValue`, `RangeOverflow`, `NonFiniteLevel`, `NotAnExtremum`
   * - smoothing: `Unconstrained`, `InvalidWeight`, `Diverged`
   * - prescribed extrema: `ConflictingExtremum`, `AdjacentExtrema`, `TooFewExtrema`, `Infeasible`, `ConstantField`
   * - systems: `NotPositiveDefinite` (`column`: the vertex at which a factorisation or an iteration failed),
   *   `IndefinitePreconditioner` (`iterations` done), `NotConverged` (`iterations` done, `residual` reached)
   * - calls: `UnknownOption`, `InvalidOption`, `InapplicableOption`, `UnsupportedOption`, `InvalidArgument`
   * - any long call: `Cancelled`, where `onProgress` stopped it; `OutOfMemory` (`bytes` needed), after which everything goes on
   * - `morse-smooth/worker`: `ConnectionClosed`, `WorkerLost` (`reason`)
   * - `morse-smooth/three`: `UnsupportedGeometry` (`reason`), `SeamDisagreement` (`vertex`, `corners`, `values`, `count`)
   * - life of objects: `NotInitialized`, `LoadFailed`, `UseAfterFree`, `Busy`, `InstanceLost` (see {@link init})
   * - `InternalError`: a bug of ours, always worth a report
   */
  readonly code: string;
  /**
   * The numbers and names in the message: `vertex`, `triangle`, `index`, `line`, `option`, `expected`, `bytes`, … Of an unknown option also
   * what was `meant`, or which functions and options it `belongsTo`; of an array whose buffer was transferred that it is `detached`.
   */
  readonly detail: Record<string, unknown>;
  /**
   * What is left of an error on its way to another thread or into a log. `postMessage(error)` and `structuredClone(error)` keep its message
   * alone, as of every class of errors: send this, and make an error of it again by {@link MorseSmoothError.from}.
   */
  toJSON(): { name: string; code: string; message: string; detail: Record<string, unknown> };
  /** The error that `toJSON` was called on. */
  static from(json: { code: string; message: string; detail?: Record<string, unknown> }): MorseSmoothError;
}
