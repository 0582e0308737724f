/**
 * The page's end of the worker: one request under way at a time, and the latest settings win.
 *
 * While a slider moves, at most one `update` or `preview` waits; a newer one takes its place, so that stale work is dropped and
 * never queued up. Opening a mesh drops everything that waits, since it was meant for the mesh before.
 */
import type { Failure, Part, Reply, Request, Settings } from './protocol';

export interface ClientEvents {
  part(part: Part): void;
  progress(fraction: number): void;
  /** Something is under way. */
  working(request: Request): void;
  done(request: Request, settings: Settings | null): void;
  failed(request: Request | null, failure: Failure, settings: Settings | null): void;
  /** Nothing is under way and nothing waits. */
  idle(): void;
}

export class Client {
  private worker: Worker | null = null;
  private ready = false;
  private current: Request | null = null;
  private waiting: Request[] = [];

  constructor(private readonly events: ClientEvents) {
    this.start();
  }

  get busy(): boolean {
    return this.current !== null || this.waiting.length > 0;
  }

  /** The worker could not be started or broke down, and with it the mesh that it held. The next request starts another. */
  get lost(): boolean {
    return this.worker === null;
  }

  run(request: Request): void {
    if (this.lost) this.start();
    if (request.kind === 'open') this.waiting = [];
    if (request.kind === 'update' || request.kind === 'preview') this.drop('preview');
    if (request.kind === 'update') this.drop('update');
    this.waiting.push(request);
    this.next();
  }

  /** Ends whatever is under way by ending the worker; the one that replaces it holds no mesh. */
  restart(): void {
    this.worker?.terminate();
    this.waiting = [];
    this.current = null;
    this.start();
  }

  private drop(stale: Request['kind']): void {
    this.waiting = this.waiting.filter(({ kind }) => kind !== stale);
  }

  private start(): void {
    this.ready = false;
    const broken = (message: string): void => this.lose({ code: 'WorkerFailed', message });
    try {
      this.worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'morse-smooth' });
    } catch (error) {
      // Later, so that whoever makes this client holds it when it hears about the failure.
      queueMicrotask(() =>
        broken(`The background worker could not be started. ${error instanceof Error ? error.message : ''}`),
      );
      return;
    }
    this.worker.onmessage = ({ data }: MessageEvent<Reply>) => this.receive(data);
    this.worker.onmessageerror = () =>
      broken('The background worker sent something unreadable. Try again, or reload the page.');
    // A worker script that cannot be loaded gives an event without a message.
    this.worker.onerror = (event) => {
      event.preventDefault();
      broken(
        event.message
          ? `The background worker stopped: ${event.message}`
          : 'The background worker could not be loaded. Try again, or reload the page.',
      );
    };
  }

  private receive(reply: Reply): void {
    switch (reply.kind) {
      case 'started':
        this.ready = true;
        return this.next();
      case 'part':
        return this.events.part(reply.part);
      case 'progress':
        return this.events.progress(reply.fraction);
      case 'failed':
        // Without its WebAssembly module a worker is of no use.
        if (!this.ready) return this.lose(reply.failure);
        return this.finish(reply);
      case 'done':
        return this.finish(reply);
    }
  }

  private lose(failure: Failure): void {
    this.worker?.terminate();
    this.worker = null;
    this.waiting = [];
    this.finish({ kind: 'failed', failure, settings: null });
  }

  private finish(reply: Extract<Reply, { kind: 'done' | 'failed' }>): void {
    const request = this.current;
    this.current = null;
    if (reply.kind === 'failed') this.events.failed(request, reply.failure, reply.settings);
    else if (request) this.events.done(request, reply.settings);
    this.next();
    if (!this.current) this.events.idle();
  }

  private next(): void {
    if (!this.worker || !this.ready || this.current) return;
    const request = this.waiting.shift();
    if (!request) return;
    this.current = request;
    this.events.working(request);
    this.worker.postMessage(request);
  }
}
