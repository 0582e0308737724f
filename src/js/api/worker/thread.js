import { lost, notStarted } from './failures.js';
import { fromReport } from './reports.js';
import { Stopper } from './stopping.js';
import { GREETING } from './table.js';

/** A worker with its end of the connection: which objects live in it, and which call runs in it. */
export class Thread {
  /** The objects that live there, each with the milliseconds that it took to make. */
  objects = new Map();
  /** The call that runs there. */
  job = null;
  /** Whether a call stops when it is told to, instead of with the worker only. */
  canAsk = false;
  isReady = false;
  isOver = false;
  #host;
  #worker = null;
  #port = null;
  #stopper = new Stopper();
  /** Ends the watch over the worker. */
  #unwatch = () => {};
  /** The names of the modules whose code is there. */
  #codes = new Set();
  /** The objects that the call makes, by their numbers. */
  #making = new Map();
  #startTime = 0;
  #receive;
  #lose;

  /** `receive(thread, message)` gets what comes from the worker, `lose(thread, error)` is told of its end. */
  constructor(host, receive, lose) {
    this.#host = host;
    this.#receive = receive;
    this.#lose = lose;
  }

  /** Whether another worker can take the place of this one. */
  get canEnd() {
    return this.#host.isOwner;
  }

  /** How many milliseconds it takes to have all that is there in another worker. */
  get cost() {
    return [...this.objects.values()].reduce((sum, time) => sum + time, this.#startTime);
  }

  /** Starts a worker in one of the ways that the host knows, the first one that works. */
  async start(code) {
    const start = performance.now();
    let reason = 'there is none';
    for (const make of this.#host.makers) {
      try {
        const worker = await make();
        if (this.isOver) return this.#host.end(worker);
        await this.#greet(worker, code);
      } catch (error) {
        if (error?.name === 'MorseSmoothError') throw error;
        reason = String(error?.message ?? error);
        this.#letGo();
        continue;
      }
      this.#startTime = performance.now() - start;
      this.isReady = true;
      this.#hold(false);
      return;
    }
    throw notStarted(reason);
  }

  /** Makes the call there, and before that the objects that it needs. */
  run(job, codes) {
    const makes = this.#missing(job.needs);
    this.job = job;
    this.#making = new Map([...makes, ...(job.makes ? [job.makes] : [])].map((object) => [object.number, object]));
    this.#hold(true);
    const message = {
      id: job.number,
      codes: this.#withoutKnown(codes),
      makes: makes.map((object) => object.recipe.message(object)),
      call: job.message(),
      isHeard: job.onProgress !== undefined,
      address: this.canAsk ? this.#stopper.begin() : null,
    };
    // What is kept to make an object again is copied; all else moves.
    this.#port.postMessage(message, job.makes ? [] : job.buffers());
  }

  /** Notes which objects the call has made, and that it is over. */
  finish(made) {
    for (const { object, time } of made) this.objects.set(this.#making.get(object), time);
    this.#making.clear();
    this.#stopper.end();
    this.job = null;
    if (!this.isOver) this.#hold(false);
  }

  /** Gives back the memory of objects that nobody needs any more. */
  sweep() {
    const gone = [...this.objects.keys()].filter((object) => object.isFreed && object.uses === 0);
    for (const object of gone) this.objects.delete(object);
    if (gone.length > 0) this.#port.postMessage({ frees: gone.map(({ number }) => number) });
  }

  /** Tells the call that runs there to stop. */
  ask() {
    if (this.canAsk) this.#stopper.ask(this.job.number);
  }

  /** Ends the worker, or lets go of it if it is somebody else's. */
  end() {
    this.isOver = true;
    this.isReady = false;
    this.objects.clear();
    if (this.job) this.ask();
    if (!this.canEnd) this.#port?.postMessage({ isClosed: true });
    this.#letGo();
  }

  #letGo() {
    this.#unwatch();
    this.#stopper.end();
    // A port that is closed at once does not deliver what was posted last.
    if (this.canEnd) this.#port?.close();
    else this.#port?.unref?.();
    if (this.#port) this.#port.onmessage = null;
    if (this.#worker) {
      this.#hold(false);
      if (this.canEnd) this.#host.end(this.#worker);
    }
    this.#worker = this.#port = null;
  }

  #greet(worker, code) {
    // First of all, so that it is ended should anything fail.
    this.#worker = worker;
    const { port1, port2 } = this.#host.channel();
    this.#port = port1;
    return new Promise((resolve, reject) => {
      this.#unwatch = this.#host.watch(worker, (reason, isEnd) => {
        if (!this.isReady) reject(new Error(reason));
        // In a browser a worker goes on after an error of its own; what is not our script may have such.
        else if (isEnd || this.#host.isOurs) this.#lose(this, lost(reason));
      });
      port1.onmessage = ({ data }) => {
        if (data.id !== 0) this.#receive(this, data);
        else if (data.error) reject(fromReport(data.error));
        else {
          this.canAsk = data.value.canHear;
          resolve();
        }
      };
      port1.unref?.();
      this.#hold(true);
      worker.postMessage({ [GREETING]: { core: code }, port: port2, ...this.#stopper.greeting() }, [port2]);
      this.#codes.add('core');
    });
  }

  /** The objects that must be made there first, in an order in which they can be. */
  #missing(needs) {
    const found = new Set();
    const visit = (object) => {
      if (this.objects.has(object) || found.has(object)) return;
      object.recipe.needs.forEach(visit);
      found.add(object);
    };
    needs.forEach(visit);
    return [...found];
  }

  #withoutKnown(codes) {
    const unknown = Object.entries(codes).filter(([name]) => !this.#codes.has(name));
    for (const [name] of unknown) this.#codes.add(name);
    return Object.fromEntries(unknown);
  }

  /** Whether the program goes on for the sake of this worker. */
  #hold(isHeld) {
    this.#host.hold(this.#worker, isHeld);
  }
}
