// Errors on their way from a worker: structured clones lose all that makes a MorseSmoothError.
import { MorseSmoothError, internalError } from '../../runtime/error.js';

/** An error of the package as a plain object; whatever else was thrown is a defect of ours. */
export function toReport(thrown) {
  const error = thrown?.name === 'MorseSmoothError' ? thrown : internalError(thrown);
  const { code, message, detail, cause } = error;
  return { code, message, detail, cause: cause === undefined ? null : textOf(cause) };
}

export function fromReport({ code, message, detail, cause }) {
  return new MorseSmoothError(code, message, detail, cause === null ? undefined : { cause });
}

/** A cause may be anything, also what cannot be sent. */
const textOf = (cause) => (cause instanceof Error ? `${cause.name}: ${cause.message}` : String(cause));
