// The commands of docs/command-line.md print what stands below them.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { commands } from '../../src/js/cli/commands/index.js';
import { workplace } from './cli.js';

const root = fileURLToPath(new URL('../..', import.meta.url));
const page = readFileSync(join(root, 'docs', 'command-line.md'), 'utf8').replaceAll('\r\n', '\n');

/** Every command with what it prints and its exit code, which stands there in brackets where it is not 0. */
const shown = [...page.matchAll(/^```console\n([^]*?)^```/gm)].flatMap(([, block]) =>
  block
    .split(/^\$ /m)
    .slice(1)
    .map((part) => {
      const [, line, text, code = '0'] = /^(.*)\n([^]*?)(?:\[(\d)\]\n)?$/.exec(part) ?? [];
      return { line, text, code: Number(code) };
    }),
);

// Its shell is that of Unix.
describe.skipIf(process.platform === 'win32')('docs/command-line.md', () => {
  let place;
  beforeAll(() => {
    place = workplace();
  });
  afterAll(() => place.remove());

  it.each(shown)('$line', ({ line, text, code }) => {
    const { status, stdout, stderr } = place.shell(line);
    expect(stdout + stderr.replace(/^nothing was written.*\n/m, '')).toBe(text);
    expect(status).toBe(code);
  });

  it('has every command in its table', () => {
    expect(shown.length).toBeGreaterThan(8);
    const rows = [...page.matchAll(/^\| `(\w+)` \|/gm)].map(([, name]) => name);
    expect(rows).toEqual(commands.map(({ name }) => name));
  });
});
