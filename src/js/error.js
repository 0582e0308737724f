/** What every failure of this package is thrown as. */
export class MorseSmoothError extends Error {
  /**
   * @param {string} code stable name of the failure
   * @param {string} message one sentence for people
   * @param {Record<string, unknown>} [detail] what a program can use
   * @param {ErrorOptions} [options]
   */
  constructor(code, message, detail = {}, options) {
    super(message, options);
    this.code = code;
    this.detail = detail;
  }
}
// On the prototype, as with the built-in errors: a name, not a field of every instance.
Object.defineProperty(MorseSmoothError.prototype, 'name', {
  value: 'MorseSmoothError',
  configurable: true,
  writable: true,
});

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
 * Runs a call into the wasm module and turns whatever it throws into a `MorseSmoothError`.
 *
 * The module reports failures as plain `{ code, message, detail }`. Anything else is a bug of ours: a trap, or the glue's own
 * complaint.
 */
export function attempt(call) {
  try {
    return call();
  } catch (thrown) {
    if (thrown instanceof MorseSmoothError) throw thrown;
    if (typeof thrown?.code === 'string' && typeof thrown.message === 'string' && !(thrown instanceof Error)) {
      throw new MorseSmoothError(thrown.code, thrown.message, thrown.detail ?? {});
    }
    const reason = thrown instanceof Error ? thrown.message : String(thrown);
    throw new MorseSmoothError(
      'InternalError',
      `morse-smooth failed inside its WebAssembly module (${reason}); this is a bug, please report it`,
      {},
      { cause: thrown },
    );
  }
}
