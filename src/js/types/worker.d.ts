/**
 * The same API in a worker, off the main thread. Every method gives a promise and takes `signal`, `onProgress`, `latest` and `transfer`
 * among its options. Objects live in the worker; what stands for them here has the methods and properties of the classes.
 *
 * @module
 */

import type { EpsilonRule, Ids, InitOptions, MeshTopology, Numbers, Progress, Smoothed, Smoother } from './index.js';
import type {
  SmoothByInterpolationOptions,
  SmoothByLeastSquaresOptions,
  SmoothByPrescriptionOptions,
} from './index.js';
import type { SmoothByConstrainedPrescriptionOptions, SmoothByWavelengthOptions, SmoothOptions } from './index.js';
import type {
  ChannelOptions,
  ChosenEpsilon,
  PrescribeByLeastSquaresOptions,
  PrescribeByWavelengthOptions,
} from './index.js';
import type { Prescribed, PrescribeOptions, ProgressOptions, SmootherOptions, SmoothingFamily } from './index.js';
import type {
  SmoothByWavelengthPrescriptionOptions,
  TikhonovOptions,
  TriMesh,
  WavelengthOptions,
  Weld,
} from './index.js';
import type * as files from './files.js';
import type * as pictures from './snapshot.js';

export { MorseSmoothError } from './index.js';

/** What is needed of an `AbortSignal`. */
export interface Signal {
  readonly aborted: boolean;
  readonly reason: any;
  addEventListener(type: 'abort', listener: () => void): void;
  removeEventListener(type: 'abort', listener: () => void): void;
}

/** What is needed of a `Worker`, that of a browser or of `node:worker_threads`. */
export interface WorkerLike {
  postMessage(message: any, transfer: any): void;
  terminate(): unknown;
}

/** What {@link connect} takes. */
export interface ConnectOptions {
  /**
   * A worker whose script imports `morse-smooth/worker-script`, or a function that makes such workers. One that is handed over stays the
   * caller's: it is never ended, so that a call which cannot be asked to stop goes on in it, unheard; and the connection is lost with
   * it. Default: a function that makes them from the package's own script.
   */
  worker?: WorkerLike | (() => WorkerLike);
  /**
   * The most workers at a time, 1 to 64. More are started when calls wait; meshes, smoothers and scenes are then made in each worker that
   * needs them. Default 1.
   */
  workers?: number;
  /** Where the files of the WebAssembly modules are, or their content, each as for `init`. Default: beside the script. */
  wasm?: { core?: InitOptions['wasm']; files?: InitOptions['wasm']; snapshot?: InitOptions['wasm'] };
  /** Ends the connection, also while it is made. */
  signal?: Signal;
}

/**
 * Starts a worker.
 *
 * @throws `LoadFailed` where the worker or the WebAssembly module of `morse-smooth` cannot be had
 */
export function connect(options?: ConnectOptions): Promise<RemoteMorseSmooth>;

/** What every call takes besides its own options. */
export interface CallOptions {
  /**
   * Stops the call. It fails at once with the signal's reason, by default an `AbortError`; the worker is free for the next call within
   * 100 ms, or another one takes its place, in which objects are made again when they are needed.
   */
  signal?: Signal;
  /** As without a worker, for calls that tell their progress. To return `false` stops the call (`Cancelled`). */
  onProgress?: (progress: Progress) => void | boolean;
  /**
   * Whether this call takes the place of an earlier one of the same method on the same object that had `latest`, too, whether that
   * waits or runs: that one fails with an `AbortError`. (One of a method without `onProgress` may give its answer if it takes no more than
   * 100 ms from then on.) For sliders. Default false.
   */
  latest?: boolean;
  /**
   * Whether arrays among the arguments are taken over instead of being copied, so that the caller's are empty afterwards. Those that
   * are parts of a larger buffer are copied all the same. Default false.
   */
  transfer?: boolean;
}

/** Functions without options, which take those of a call. */
type Bare =
  | 'topology'
  | 'positions'
  | 'triangles'
  | 'vertexMap'
  | 'withoutMissing'
  | 'values'
  | 'errorAt'
  | 'surface'
  | 'formats'
  | 'free';

/** The parameters of a function, whose last one are options, with those of a call. */
type WithCallOptions<Given extends any[]> = Given extends [...infer Before, infer Last]
  ? [...given: Before, options: Last & CallOptions]
  : Required<Given> extends [...infer Before, infer Last]
    ? [...given: Before, options?: Last & CallOptions]
    : never;

/** Objects as they are here. */
type Remote<Result> = Result extends SmoothingFamily
  ? RemoteSmoothingFamily
  : Result extends { mesh: TriMesh; vertices: infer Vertices }
    ? { mesh: RemoteTriMesh; vertices: Vertices }
    : Result;

/** A function that gives a promise and takes the options of a call. */
type RemoteFunction<Name, Local extends (...given: any[]) => any> = Name extends Bare
  ? (...given: [...given: Parameters<Local>, options?: CallOptions]) => Promise<Remote<ReturnType<Local>>>
  : (...given: WithCallOptions<Parameters<Local>>) => Promise<Remote<ReturnType<Local>>>;

/** The members of a class: methods give promises, properties are as they were when the object was made or changed. */
type RemoteMembers<Local, Others extends keyof Local> = {
  [Name in Exclude<keyof Local, Others | 'free' | typeof Symbol.dispose>]: Local[Name] extends (...given: any[]) => any
    ? RemoteFunction<Name, Local[Name]>
    : Local[Name];
};

/** What every object has. */
interface RemoteObject {
  /** Gives the memory back; calls that were made before end as they would. */
  free(): void;
  [Symbol.dispose](): void;
}

/** A `TriMesh` that lives in a worker. */
export interface RemoteTriMesh extends RemoteMembers<TriMesh, 'topology'>, RemoteObject {
  /** What takes time to find is asked for. */
  topology(options?: CallOptions): Promise<MeshTopology>;
}

/** A `Smoother` that lives in a worker. */
export interface RemoteSmoother extends RemoteMembers<Smoother, 'tikhonov' | 'prescribe'>, RemoteObject {
  /** As `Smoother.tikhonov`. */
  tikhonov(values: Numbers, options: TikhonovOptions & ChannelOptions & CallOptions): Promise<Smoothed>;
  tikhonov(values: Numbers, options: WavelengthOptions & ChannelOptions & CallOptions): Promise<Smoothed>;
  /** As `Smoother.prescribe`. */
  prescribe(values: Numbers, options: PrescribeOptions & CallOptions): Promise<Prescribed>;
  prescribe(values: Numbers, options: PrescribeByWavelengthOptions & CallOptions): Promise<Prescribed>;
  prescribe(values: Numbers, options: PrescribeByLeastSquaresOptions & CallOptions): Promise<Prescribed>;
}

/** A `SmoothingFamily` that lives in a worker. There is one of it, also where there are several workers. */
export interface RemoteSmoothingFamily extends RemoteMembers<SmoothingFamily, 'choose'>, RemoteObject {
  /** As `SmoothingFamily.choose`. */
  choose(rule?: EpsilonRule, options?: ProgressOptions & CallOptions): Promise<ChosenEpsilon>;
}

/** A `Scene` of `morse-smooth/snapshot` that lives in a worker. */
export interface RemoteScene extends RemoteMembers<pictures.Scene, never>, RemoteObject {}

/** The functions of `morse-smooth/files` and of `morse-smooth/snapshot`, whose modules are loaded when one of them is called first. */
type RemoteFunctions = {
  [Name in 'formats' | 'readMesh' | 'readField' | 'readTable' | 'writeMesh']: RemoteFunction<
    Name,
    (typeof files)[Name]
  >;
} & { [Name in 'snapshot' | 'sheet']: RemoteFunction<Name, (typeof pictures)[Name]> };

/**
 * A connection to a worker, or to several. Calls wait for one that is free, in their order.
 *
 * Further codes: `ConnectionClosed` for calls after {@link RemoteMorseSmooth.close} and those that it ends, `WorkerLost` for a call
 * whose worker ended; the next call has another worker.
 */
export interface RemoteMorseSmooth extends RemoteFunctions {
  /** `new TriMesh(…)`. A copy of the arrays is kept here, to make the mesh again in another worker. */
  createMesh(
    positions: Numbers,
    triangles: Ids | null,
    options?: { weld?: Weld } & CallOptions,
  ): Promise<RemoteTriMesh>;
  /** `new Smoother(…)`. The mesh may be freed afterwards. */
  createSmoother(mesh: RemoteTriMesh, options?: SmootherOptions & CallOptions): Promise<RemoteSmoother>;
  /** `new Scene(…)`. */
  createScene(positions: Numbers, triangles: Ids, options?: CallOptions): Promise<RemoteScene>;
  /** As `smooth`. */
  smooth(mesh: RemoteTriMesh, values: Numbers, options?: SmoothOptions & CallOptions): Promise<Smoothed>;
  smooth(mesh: RemoteTriMesh, values: Numbers, options: SmoothByWavelengthOptions & CallOptions): Promise<Smoothed>;
  smooth(mesh: RemoteTriMesh, values: Numbers, options: SmoothByLeastSquaresOptions & CallOptions): Promise<Smoothed>;
  smooth(mesh: RemoteTriMesh, values: Numbers, options: SmoothByInterpolationOptions & CallOptions): Promise<Smoothed>;
  smooth(mesh: RemoteTriMesh, values: Numbers, options: SmoothByPrescriptionOptions & CallOptions): Promise<Prescribed>;
  smooth(
    mesh: RemoteTriMesh,
    values: Numbers,
    options: SmoothByWavelengthPrescriptionOptions & CallOptions,
  ): Promise<Prescribed>;
  smooth(
    mesh: RemoteTriMesh,
    values: Numbers,
    options: SmoothByConstrainedPrescriptionOptions & CallOptions,
  ): Promise<Prescribed>;
  /** Ends the workers; with them goes all that lives there. A worker that was handed over stays, without the objects. */
  close(): void;
  [Symbol.dispose](): void;
}
