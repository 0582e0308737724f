// What only happens to calls that go to a worker.
import { MorseSmoothError } from '../../runtime/error.js';

export const closed = () =>
  new MorseSmoothError('ConnectionClosed', 'the connection to the worker was closed; `connect()` makes another one');

export const lost = (reason) =>
  new MorseSmoothError('WorkerLost', `the worker ended while it was needed (${reason})`, { reason });

export const notStarted = (reason) =>
  new MorseSmoothError('LoadFailed', `the worker could not be started: ${reason}`, { reason });

/** What is thrown where arguments are copied that are too large for that. */
export function notSent(error, buffers) {
  const bytes = buffers.reduce((sum, buffer) => sum + buffer.byteLength, 0);
  const message = `the arguments could not be sent to the worker: ${error.message}`;
  return new MorseSmoothError('OutOfMemory', message, { bytes }, { cause: error });
}

export const freed = (object) => new MorseSmoothError('UseAfterFree', `this ${object} was freed`, { object });

/** What a call fails with that is stopped by what it calls back, as without a worker. */
export const cancelled = () =>
  new MorseSmoothError('Cancelled', 'stopped, as asked; everything is as it was before the call');

export const superseded = () => new DOMException('a later call with `latest` took its place', 'AbortError');
