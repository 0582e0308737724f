import { encode } from './encode.js';
import { cancelled, closed, notSent, superseded } from './failures.js';
import { Job } from './job.js';
import { RemoteObject, proxyOf, stateOf } from './objects.js';
import { separate } from './options.js';
import { fromReport, toReport } from './reports.js';
import { callOf } from './table.js';
import { Thread } from './thread.js';

/**
 * How many milliseconds a call may go on that was to stop, before its worker is ended. Calls that can be asked answer within 50, on large
 * meshes and busy machines later, but sooner than another worker is there; of the others, most are over soon.
 */
const PATIENCE = { asked: 300, silent: 40 };

/**
 * How many milliseconds a superseded call may still take that cannot be asked to stop. Most are over sooner and give their answer, so that
 * a slider which moves faster than that does not stand still.
 */
const GRACE = 100;

/** Codes after which nothing that lives in the worker can be used. */
const DISORDER = ['InternalError', 'InstanceLost'];

/** The calls that wait, and the workers that make them. */
export class Connection {
  #host;
  #codes;
  #size;
  #threads = new Set();
  #queue = [];
  /** Why there is no connection any more. */
  #end = null;

  /** `codes` gives the code of the modules, `size` is how many workers there may be. */
  constructor(host, codes, size) {
    this.#host = host;
    this.#codes = codes;
    this.#size = size;
  }

  /** Starts the first worker. */
  async open() {
    const thread = this.#add();
    await this.#start(thread);
    if (this.#end) throw this.#end;
  }

  /** Ends all that runs and waits. */
  close(reason = closed()) {
    if (this.#end) return;
    this.#end = reason;
    const jobs = [...this.#queue, ...[...this.#threads].flatMap(({ job }) => job ?? [])];
    this.#queue = [];
    for (const job of jobs) if (!job.isSettled) job.reject(reason);
    for (const thread of this.#threads) thread.end();
    this.#threads.clear();
  }

  /** Makes a call, of a method of an object or of a function. */
  async call(kind, object, name, given) {
    if (this.#end) throw this.#end;
    const call = callOf(kind, name);
    const { args, signal, onProgress, latest, transfer } = separate(given, call);
    if (signal?.aborted) throw signal.reason;
    const needs = new Set(object ? [object] : []);
    const numberOf = (value) => {
      const state = stateOf(value, this);
      if (state) needs.add(state);
      return state?.number;
    };
    const encoded = encode(args, transfer === true, numberOf);
    const job = new Job({
      kind,
      object,
      name,
      call,
      args: encoded,
      needs: [...needs],
      makes: call.makes ? new RemoteObject(this, call.makes.kind) : null,
      // Without its own, a method calls back what its smoother was made with.
      onProgress: onProgress ?? object?.onProgress,
      isLatest: latest === true,
    });
    if (job.makes) {
      job.makes.recipe = job.recipe();
      job.makes.onProgress = kind !== null ? object.onProgress : call.isWatched ? onProgress : undefined;
    }
    if (job.isLatest) this.#supersede(job);
    job.abortWith(signal, (reason) => this.#drop(job, reason));
    this.#queue.push(job);
    this.#prepare(job);
    return job.promise;
  }

  /** Frees, in all workers, what nobody needs any more. */
  sweep() {
    for (const thread of this.#threads) if (thread.isReady) thread.sweep();
  }

  async #prepare(job) {
    try {
      await this.#codes.load(job.call.module);
    } catch (error) {
      return this.#drop(job, error);
    }
    job.isReady = true;
    this.#pump();
  }

  /** Gives jobs that wait to workers that do not; starts further workers where there may be more. */
  #pump() {
    if (this.#end) return;
    let waiting = 0;
    for (const job of this.#queue.filter(({ isReady }) => isReady)) {
      const home = this.#homeOf(job);
      const thread = home ?? this.#idleFor(job);
      if (thread?.isReady && thread.job === null) this.#run(job, thread);
      else if (!home) waiting++;
    }
    let starting = [...this.#threads].filter(({ isReady }) => !isReady).length;
    for (; starting < waiting && this.#threads.size < this.#size; starting++) this.#startAside();
  }

  /** The only worker that may make a call: one with an object that there is once. */
  #homeOf({ needs }) {
    const single = needs.find(({ isSingle }) => isSingle);
    return single && [...this.#threads].find(({ objects }) => objects.has(single));
  }

  /** The idle worker that has most of what a call needs. */
  #idleFor({ needs }) {
    const idle = [...this.#threads].filter(({ isReady, job }) => isReady && job === null);
    const known = (thread) => needs.filter((object) => thread.objects.has(object)).length;
    return idle.sort((a, b) => known(b) - known(a))[0];
  }

  #run(job, thread) {
    this.#queue = this.#queue.filter((other) => other !== job);
    job.thread = thread;
    try {
      thread.run(job, this.#codes.loaded([job.call.module]));
    } catch (error) {
      // There is no memory for a copy of the arguments.
      this.#finish(thread, job, { made: [], error: toReport(notSent(error, job.buffers())) });
    }
  }

  #add() {
    const thread = new Thread(
      this.#host,
      (thread, message) => this.#receive(thread, message),
      (thread, error) => this.#lose(thread, error),
    );
    this.#threads.add(thread);
    return thread;
  }

  async #start(thread) {
    try {
      await thread.start(await this.#codes.load('core'));
    } catch (error) {
      this.#threads.delete(thread);
      thread.end();
      // Calls that wait have nobody to wait for; the next one tries again.
      if (this.#threads.size === 0) for (const job of [...this.#queue]) this.#drop(job, error);
      this.#end ??= this.#host.isOwner ? null : error;
      throw error;
    }
    this.#pump();
  }

  /** Starts a worker of which nobody waits for the start as such. */
  #startAside() {
    this.#start(this.#add()).catch(() => {});
  }

  #receive(thread, message) {
    const { job } = thread;
    if (message.progress) this.#tell(job, message.progress);
    else this.#finish(thread, job, message);
  }

  #tell(job, progress) {
    if (job.isSettled) return;
    let isStopped;
    try {
      isStopped = job.onProgress(progress) === false;
    } catch (error) {
      return this.#drop(job, error);
    }
    if (isStopped) this.#drop(job, cancelled());
  }

  #finish(thread, job, { value, facts, made, error }) {
    thread.finish(made);
    job.release();
    if (!error) this.#note(job, facts);
    if (error && DISORDER.includes(error.code)) this.#renew(thread);
    if (!job.isSettled) {
      if (error) job.reject(fromReport(error));
      else job.resolve(resultOf(job, value));
    } else if (job.makes) job.makes.isFreed = true;
    this.sweep();
    this.#pump();
  }

  /** What is known of an object after a call that has made or changed it. */
  #note({ call, name, object, makes }, facts) {
    if (makes) makes.facts = facts;
    if (!call.changes) return;
    object.facts = facts;
    object.changes.push(name);
  }

  /** Lets go of a worker in disorder, or, if it is somebody else's, of all that lives there. */
  #renew(thread) {
    if (thread.canEnd) this.#replace(thread);
    else thread.objects.clear();
  }

  #replace(thread) {
    this.#threads.delete(thread);
    thread.job?.release();
    thread.end();
    if (this.#threads.size === 0) this.#startAside();
  }

  /** A worker has ended by itself. */
  #lose(thread, error) {
    const { job } = thread;
    this.#threads.delete(thread);
    thread.end();
    job?.release();
    if (job && !job.isSettled) job.reject(error);
    if (this.#host.isOwner) return this.#pump();
    this.close(error);
  }

  /** Lets a call take the place of its like. One that runs and cannot be asked to stop may give its answer, if it does so soon. */
  #supersede(job) {
    const running = [...this.#threads].flatMap(({ job }) => job ?? []);
    for (const other of [...this.#queue, ...running]) {
      if (!other.isLatest || other.isSettled || !other.isLike(job)) continue;
      // To end the worker is no gain where that takes longer than what is left of the call.
      const drop = () => this.#drop(other, superseded(), other.thread?.cost);
      if (other.thread === null || other.call.isWatched) drop();
      else setTimeout(drop, GRACE);
    }
  }

  /** Settles a job that nobody waits for any more, and stops it; within so many milliseconds at least by ending its worker. */
  #drop(job, error, patience = 0) {
    if (job.isSettled) return;
    job.reject(error);
    const { thread } = job;
    if (thread === null) {
      this.#queue = this.#queue.filter((other) => other !== job);
      job.release();
      this.sweep();
      return;
    }
    thread.ask();
    if (!thread.canEnd) return;
    const least = thread.canAsk && job.call.isWatched ? PATIENCE.asked : PATIENCE.silent;
    setTimeout(() => thread.job === job && !thread.isOver && this.#replaceAndGoOn(thread), Math.max(least, patience));
  }

  #replaceAndGoOn(thread) {
    this.#replace(thread);
    this.#pump();
  }
}

function resultOf({ call, makes }, value) {
  if (!makes) return value;
  const proxy = proxyOf(makes);
  return call.makes.at === null ? proxy : { ...value, [call.makes.at]: proxy };
}
