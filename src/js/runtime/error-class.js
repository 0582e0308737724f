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
