/// <reference lib="esnext.disposable" />

/**
 * Critical points, level sets and smoothing of scalar fields on triangle meshes.
 *
 * A *field* has one number per vertex, in the order of the mesh's vertices. Vertices and triangles are numbered from 0. Lengths
 * are in the units of the positions, values in the units of the field; nothing is rescaled unless a comment says so. Every array
 * that comes out is a copy of the caller's own: changing it changes nothing here, and nothing done here later changes it.
 * Whatever fails throws a {@link MorseSmoothError}. An option that does not exist fails with `UnknownOption`, one out of its range
 * with `InvalidOption`, one that means nothing for what was asked with `InapplicableOption`.
 *
 * @module
 */

/** Numbers as they are taken. Values of a plain array must all be of type `number` (otherwise `InvalidArgument`). */
export type Numbers = Float64Array | Float32Array | readonly number[];
/** Vertex numbers as they are taken: whole, from 0 to 2³² − 1. */
export type Ids = Uint32Array | Uint16Array | readonly number[];

/**
 * Loads the WebAssembly module. In a browser, wait for it before any other call (otherwise `NotInitialized`); in Node the import
 * has already done it. Calling it again is free and gives the same promise; after a failure it tries anew.
 *
 * @throws `LoadFailed` where the module cannot be fetched or compiled; `detail` has `url` and `status` if a server answered.
 */
export default function init(options?: InitOptions): Promise<void>;

/** What {@link init} takes. */
export interface InitOptions {
  /**
   * Where the module's file is, or its content: `morse_smooth_bg.wasm`, or `morse_smooth_snapshot_bg.wasm` for
   * `morse-smooth/snapshot`. Without it the file beside the script is fetched, and with `morse-smooth/inline` nothing is.
   */
  wasm?: URL | string | Request | Response | BufferSource | WebAssembly.Module;
}

/** Of this package, such as `"0.1.0"`. */
export const version: string;

/** Any failure of this package. */
export class MorseSmoothError extends Error {
  /** For code that carries errors across threads; this package makes its own. */
  constructor(code: string, message: string, detail?: Record<string, unknown>, options?: { cause?: unknown });
  /**
   * Names the failure for programs; stays the same while messages improve.
   *
   * - files: `EmptyFile`, `UnknownFormat`, `UnsupportedFormat`, `UnsupportedFeature`, `Truncated`, `UnexpectedEnd`,
   *   `InvalidNumber`, `InvalidSyntax`, `MissingElement`, `FaceIndexOutOfBounds`, `UnknownColumn`, `TooLarge`,
   *   `FieldsNotSupported`, `BinaryNotSupported`
   * - meshes: `EmptyMesh`, `PositionsNotTriples`, `TrianglesNotTriples`, `TooManyElements`, `NonFinitePosition`,
   *   `PositionOverflow`, `IndexOutOfBounds`, `ZeroArea`, `ZeroWeightSum`
   * - fields: `LengthMismatch`, `NonFiniteValue`, `RangeOverflow`, `NonFiniteLevel`
   * - smoothing: `Unconstrained`, `InvalidWeight`, `Diverged`
   * - systems: `NotPositiveDefinite` (`column`: the vertex at which a factorisation or an iteration failed),
   *   `IndefinitePreconditioner` (`iterations` done), `NotConverged` (`iterations` done, `residual` reached), `OutOfMemory`
   *   (`bytes` needed)
   * - calls: `UnknownOption`, `InvalidOption`, `InapplicableOption`, `UnsupportedOption`, `InvalidArgument`
   * - life of objects: `NotInitialized`, `LoadFailed`, `UseAfterFree`, `Busy`
   * - `InternalError`: a bug of ours, always worth a report
   */
  readonly code: string;
  /** The numbers and names in the message: `vertex`, `triangle`, `index`, `line`, `option`, `expected`, `bytes`, … */
  readonly detail: Record<string, unknown>;
}
