// What only happens to calls that go to a worker.
import { MorseSmoothError } from '../../runtime/error.js';

export const closed = () =>
  new MorseSmoothError('ConnectionClosed', 'the connection to the worker was closed; `connect()` makes another one');

export const lost = (reason) =>
  new MorseSmoothError('WorkerLost', `the worker ended while it was needed (${reason})`, { reason });

export const notStarted = (reason) =>
  new MorseSmoothError('LoadFailed', `the worker could not be started: ${reason}`, { reason });

export const freed = (object) => new MorseSmoothError('UseAfterFree', `this ${object} was freed`, { object });

/** What a call fails with that is stopped by what it calls back, as without a worker. */
export const cancelled = () =>
  new MorseSmoothError('Cancelled', 'stopped, as asked; everything is as it was before the call');

export const superseded = () => new DOMException('a later call with `latest` took its place', 'AbortError');
