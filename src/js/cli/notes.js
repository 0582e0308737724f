// What is said beside the result, on the standard error output: warnings, and progress where that is a terminal.

const BAR = 20;

export class Notes {
  #isQuiet;
  #isTerminal;
  #shown = '';

  constructor(isQuiet, stream = process.stderr) {
    this.stream = stream;
    this.#isQuiet = isQuiet;
    this.#isTerminal = Boolean(stream.isTTY);
  }

  /** A sentence. */
  say(sentence) {
    if (this.#isQuiet) return;
    this.clear();
    this.stream.write(`${sentence}\n`);
  }

  /** What was left out or put right in a file. */
  warn(place, warnings) {
    for (const { message } of warnings) this.say(`${place === '-' ? 'standard input' : place}: warning: ${message}`);
  }

  /** What long calls take; nothing where nobody would see it. */
  get progress() {
    if (this.#isQuiet || !this.#isTerminal) return {};
    return { onProgress: ({ phase, fraction }) => this.#show(phase, fraction) };
  }

  #show(phase, fraction) {
    const done = Math.round(fraction * BAR);
    const line = `${'█'.repeat(done)}${'░'.repeat(BAR - done)} ${String(Math.floor(fraction * 100)).padStart(3)} %  ${phase}`;
    if (line === this.#shown) return;
    this.#shown = line;
    this.stream.write(`\r\x1b[K${line}`);
  }

  /** Takes the progress away. */
  clear() {
    if (this.#shown !== '') this.stream.write('\r\x1b[K');
    this.#shown = '';
  }
}
