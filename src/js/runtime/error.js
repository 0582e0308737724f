// The package's errors: their class, which is in a file of its own so that all entries share it, and what makes them.
import { MorseSmoothError } from './error-class.js';

export { MorseSmoothError };

/** An argument of the wrong type; `more` adds to the detail. */
export function invalidArgument(argument, expected, more = {}) {
  const at = more.index === undefined ? '' : ` (see entry ${more.index})`;
  return new MorseSmoothError('InvalidArgument', `\`${argument}\` must be ${expected}${at}`, {
    argument,
    expected,
    ...more,
  });
}

/** An option with a value that it does not take. */
export function invalidOption(option, expected) {
  return new MorseSmoothError('InvalidOption', `option \`${option}\` takes ${expected}`, { option, expected });
}

/**
 * The error for what the WebAssembly module threw as a plain `{ code, message, detail }`; nothing for whatever else was thrown. `hint`
 * says more of an option that is unknown.
 */
export function reported(thrown, hint) {
  const isReport = typeof thrown?.code === 'string' && typeof thrown.message === 'string' && !(thrown instanceof Error);
  if (!isReport) return null;
  const { code, message, detail = {} } = thrown;
  const more = code === 'UnknownOption' && hint ? hint(detail.option) : null;
  return new MorseSmoothError(code, message + (more?.text ?? ''), { ...detail, ...more?.detail });
}

/** The error for what must not happen. */
export function internalError(thrown) {
  const reason = thrown instanceof Error ? thrown.message : String(thrown);
  return new MorseSmoothError(
    'InternalError',
    `morse-smooth failed inside its WebAssembly module (${reason}); this is a bug, please report it`,
    {},
    { cause: thrown },
  );
}
