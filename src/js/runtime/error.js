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

  /** An error again of what `toJSON` made. */
  static from({ code, message, detail }) {
    return new MorseSmoothError(code, message, detail);
  }

  /** What is left of an error on its way to another thread, which loses all but the message of an error as it is. */
  toJSON() {
    const { name, code, message, detail } = this;
    return { name, code, message, detail };
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
