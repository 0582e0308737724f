// What is wrong with a command, or with what it is given, is said in one sentence; the exit code says whose fault it is.
import { execFileSync } from 'node:child_process';
import { existsSync, lstatSync, mkdirSync, readFileSync, readdirSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { commands } from '../../src/js/cli/commands/index.js';
import { api, isKnown } from '../../src/js/cli/options.js';
import { commands as folder, workplace } from './cli.js';

const root = fileURLToPath(new URL('../..', import.meta.url));
const isWindows = process.platform === 'win32';
let place;
beforeAll(() => {
  place = workplace();
  mkdirSync(place.at('folder'));
  writeFileSync(place.at('empty.ply'), '');
  writeFileSync(place.at('broken.ply'), readFileSync(place.at('torus.ply')).subarray(0, 5000));
  writeFileSync(place.at('short.txt'), '1\n2\n3\n');
  writeFileSync(place.at('word.txt'), '1\ntwo\n3\n');
  writeFileSync(place.at('infinite.off'), 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e999 0\n3 0 1 2\n');
  writeFileSync(place.at('triangle.off'), 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n');
  writeFileSync(place.at('nan.txt'), '1\nnan\n3\n');
});
afterAll(() => place.remove());

/** Expects a sentence, and nothing of a stack, an internal error or half a result. */
function refused(line, exit, ...parts) {
  const { status, stdout, stderr } = place.run(line.split(' ').filter((word) => word !== ''));
  expect(stderr.trimEnd().split('\n'), stderr).toHaveLength(1);
  expect(stderr).toMatch(/^morse-smooth/);
  expect(stderr).not.toMatch(/InternalError|undefined|\n {4}at |\.mjs/);
  for (const part of parts) expect(stderr).toContain(part);
  expect([status, stdout]).toEqual([exit, '']);
}

describe('a wrong command', () => {
  it.each([
    ['smoth torus.ply', 'there is no command ‘smoth’', 'did you mean ‘smooth’?'],
    ['frobnicate torus.ply', 'there are info, critical'],
    ['smooth', 'a mesh file is needed'],
    ['info torus.ply terrain.ply', 'one word too many: ‘terrain.ply’'],
    ['smooth torus.ply --epsilo 1', 'no option --epsilo', 'did you mean --epsilon?'],
    ['critical torus.ply --deltaIs absolute', 'did you mean --delta-is?'],
    ['critical torus.ply --epsilon 1', 'it is an option of ‘smooth’, ‘prescribe’'],
    ['smooth torus.ply --eps 1', 'did you mean --epsilon?'],
    ['critical torus.ply --frobnicate', 'see ‘morse-smooth critical --help’'],
    ['critical torus.ply -x', 'no option -x'],
    ['critical torus.ply --delta', '--delta needs a value'],
    ['critical torus.ply --delta --json', '--delta needs a value'],
    ['critical torus.ply --delta 1 --delta 2', '--delta is given twice'],
    ['critical torus.ply --json=yes', '--json takes no value'],
    ['critical torus.ply --field noisy --delta abc', '--delta takes a number, and not ‘abc’'],
    ['critical torus.ply --field noisy --delta 0x10', '--delta takes a number'],
    ['critical torus.ply --field noisy --delta -1', '--delta takes a finite number that is not negative', 'InvalidOption'],
    ['critical torus.ply --field noisy --link both', '"consecutive", "skip"', 'InvalidOption'],
    ['critical torus.ply --to xml', 'text, csv, json'],
    ['critical torus.ply', 'has several fields: clean, noisy', 'name one by --field'],
    ['critical torus.ply --field nosy', 'has no field ‘nosy’', 'it has clean, noisy'],
    ['critical shape.obj', 'has no field', '--values'],
    ['critical shape.obj --values heat.csv', 'heat.csv', 'several columns: id, T', '--column'],
    ['critical shape.obj --values heat.csv --column t', 'UnknownColumn', 'there are id, T'],
    ['critical torus.ply --field clean --column T', '--column goes with --values'],
    ['critical torus.ply --field clean --values heat.csv', '--field and --values are two fields'],
    ['persistence torus.ply --field clean --threshold-is absolute', '--threshold-is goes with --threshold'],
    ['smooth torus.ply --field noisy --binary', '--binary goes with -o or --to'],
    ['smooth torus.ply --field noisy --to csv --binary', '--binary is not for csv'],
    ['smooth torus.ply --field noisy --method tikhonov --constraints 1', '--constraints', 'tikhonov'],
    ['critical - --values -', 'cannot both be the standard input'],
    ['persistence torus.ply --threshold -1', '--threshold takes'],
    ['smooth torus.ply --field noisy --metric fine', '"mass", "identity", "lumped"'],
    ['smooth torus.ply --field noisy --epsilon much', '--epsilon takes one of "gcv"', 'or a number, or auto'],
    ['smooth torus.ply --field noisy --epsilon 0', '--epsilon takes a positive finite number'],
    ['smooth torus.ply --field noisy --epsilon 1 --noise 2', '--noise goes with --epsilon discrepancy'],
    ['smooth torus.ply --field noisy --delta 1', '--delta goes with --constraints'],
    ['smooth torus.ply --field noisy --constraints all', '--constraints takes one of', 'vertex numbers'],
    ['smooth torus.ply --field noisy --constraints 1,x', 'not ‘x’'],
    ['smooth torus.ply --field noisy --method interpolate', 'needs --constraints'],
    ['smooth torus.ply --field noisy --method magic', 'tikhonov, leastSquares'],
    ['smooth torus.ply --field noisy --method prescribe', 'a command of its own'],
    ['smooth torus.ply --field noisy --iterations 3', '--iterations is not for --method tikhonov'],
    ['smooth torus.ply --field noisy --method low-pass', '--iterations takes an integer'],
    ['smooth torus.ply --field noisy --cutoff-wavelength 1', 'InapplicableOption'],
    ['smooth torus.ply --field noisy -o x.foo', 'the ending ‘foo’', 'obj, off, ply'],
    ['smooth torus.ply --field noisy -o x', 'no ending that tells the format'],
    ['smooth torus.ply --field noisy -o -', 'name it by --to'],
    ['smooth torus.ply --field noisy --to doc', '‘doc’ is no format that can be written'],
    ['simplify torus.ply --field noisy', '--threshold or --keep is needed'],
    ['prescribe torus.ply --field noisy --extrema most', 'persistence, named or vertex numbers'],
    ['prescribe torus.ply --field noisy --minima 1,2', '--extrema named'],
    ['levels torus.ply --field clean --count 3 --saddles', '--count and --saddles exclude each other'],
    ['levels torus.ply --field clean -o x.png', 'csv, json, obj'],
    ['draw torus.ply --field clean -o x.jpg', 'PNG'],
    ['draw torus.ply --field clean --size 3 -o x.png', '1200x900'],
    ['draw torus.ply --field clean --colormap rainbow -o x.png', '"viridis"'],
    ['draw torus.ply --field clean --titles a,b,c -o x.png', '--after'],
    ['convert torus.ply', 'what to write is not said'],
    ['convert torus.ply --to txt', 'clean, noisy', 'csv'],
    ['convert shape.obj --to csv', 'has no field'],
  ])('%s', (line, ...parts) => refused(line, 2, ...parts)); // prettier-ignore

  it('without words gets the help', () => {
    const { status, stdout, stderr } = place.run([]);
    expect([status, stdout]).toEqual([2, '']);
    expect(stderr).toBe(place.output(['--help']));
  });
});

describe('data that are at fault', () => {
  it.each([
    ['info missing.ply', 'missing.ply: there is no such file', 'ENOENT'],
    ['info folder', 'it is a folder'],
    ['info empty.ply', 'empty.ply', 'EmptyFile'],
    ['info broken.ply', 'broken.ply', '('],
    ['info noisy.txt', 'UnknownFormat', 'obj, off', '--values'],
    ['info infinite.off', 'infinite.off', '('],
    ['critical torus.ply --values short.txt', 'short.txt', 'LengthMismatch, expected 4301, actual 3'],
    ['critical triangle.off --values word.txt', 'word.txt', 'InvalidNumber, line 2'],
    ['critical triangle.off --values nan.txt', 'NonFiniteValue, vertex 1', '--missing says', '"omit" leaves a hole'],
    ['smooth torus.ply --field noisy --constraints 1,99999', 'IndexOutOfBounds, index 99999, vertices 4301'],
    ['simplify torus.ply --field noisy --keep 0,1', 'NotAnExtremum, vertex'],
    ['prescribe torus.ply --field noisy --epsilon 0.05 --minima 900 --maxima 1', 'TooFewExtrema', '--of input'],
    ['smooth torus.ply --field noisy -o missing/x.ply', 'missing/x.ply', 'ENOENT'],
    ['smooth torus.ply --field noisy -o folder --to ply', 'it is a folder'],
    ['smooth torus.ply --field noisy -o x.off', 'FieldsNotSupported', '--to'],
    ['convert torus.ply --field noisy -o x.off', 'FieldsNotSupported'],
    ['smooth torus.ply --field noisy -o x.obj --binary', 'BinaryNotSupported', '--binary'],
  ])('%s', (line, ...parts) => refused(line, 1, ...parts));

  it('leave nothing behind', () => {
    expect(readdirSync(place.at()).filter((name) => /^x\b|\.tmp$/.test(name))).toEqual([]);
  });
});

describe('files that are written', () => {
  it.skipIf(isWindows)('keep their links and permissions', () => {
    writeFileSync(place.at('real.off'), 'before', { mode: 0o600 });
    symlinkSync('real.off', place.at('link.off'));
    place.output(['convert', 'shape.obj', '-o', 'link.off']);
    expect(lstatSync(place.at('link.off')).isSymbolicLink()).toBe(true);
    expect(readFileSync(place.at('real.off'), 'utf8')).toMatch(/^OFF/);
    expect(lstatSync(place.at('real.off')).mode & 0o777).toBe(0o600);
  });

  it('may be the ones that were read', () => {
    writeFileSync(place.at('own.off'), readFileSync(place.at('triangle.off')));
    place.output(['convert', 'own.off', '-o', 'own.off']);
    expect(place.json(['info', 'own.off']).vertexCount).toBe(3);
  });

  it.skipIf(!existsSync('/dev/full'))('and cannot be', () => {
    refused('convert shape.obj --to off -o /dev/full', 1, '/dev/full: the disk is full');
    const { status, stderr } = place.shell('morse-smooth info shape.obj > /dev/full');
    expect([status, stderr]).toEqual([1, 'morse-smooth info: standard output: the disk is full (ENOSPC)\n']);
  });

  it.skipIf(isWindows)('are not begun when the work is stopped', async () => {
    const child = place.start(['smooth', 'terrain.ply', '--epsilon', 'auto', '-o', 'stopped.ply']);
    let said = '';
    for (const stream of [child.stdout, child.stderr]) stream.on('data', (part) => (said += part));
    await new Promise((done) => setTimeout(done, 500));
    child.kill('SIGINT');
    const signal = await new Promise((done) => child.on('close', (_, signal) => done(signal)));
    expect([signal, said]).toEqual(['SIGINT', '']);
    expect(readdirSync(place.at()).filter((name) => name.startsWith('stopped'))).toEqual([]);
  });

  it.skipIf(isWindows)('end without a word where the reader goes away', () => {
    for (const words of ['critical torus.ply --field noisy', 'convert torus.ply --to ply']) {
      const { stdout, stderr } = place.shell(`(morse-smooth ${words}; echo "exit $?" >&2) | head -n 1`);
      expect(stdout.split('\n')).toHaveLength(2);
      expect(stderr).toBe('exit 0\n');
    }
  });
});

describe('a terminal', () => {
  // `script` runs a command as on a terminal.
  const has = !isWindows && ['/usr/bin/script', '/bin/script'].some((path) => existsSync(path));
  const onTerminal = (words) => place.shell(`script -qec 'morse-smooth ${words}' /dev/null`);

  it.skipIf(!has)('shows progress and takes it away', () => {
    const { stdout } = onTerminal('smooth torus.ply --field noisy --epsilon 0.05 -o t.ply');
    const shown = [...stdout.matchAll(/(\d+) % {2}(\w+)/g)].map((match) => Number(match[1]));
    expect(shown.length).toBeGreaterThan(3);
    expect(shown).toEqual(shown.toSorted((one, other) => one - other));
    expect(stdout).toMatch(/\r\x1b\[Knoisy → noisy_smoothed/);
    const quiet = onTerminal('smooth torus.ply --field noisy --epsilon 0.05 -o t.ply --quiet');
    expect(quiet.stdout).not.toContain('%  ');
  });

  it.skipIf(!has)('is sent no bytes', () => {
    for (const words of ['draw torus.ply --field noisy', 'convert torus.ply --to ply --binary']) {
      expect(onTerminal(words).stdout).toContain('does not go to a terminal; name a file by -o');
    }
  });
});

describe('the help', () => {
  it('is there for all and for each command', () => {
    const all = place.output(['--help']);
    for (const { name, options } of commands) {
      expect(all).toContain(`\n  ${name} `);
      const help = place.output([name, '--help']);
      expect(help).toBe(place.output(['help', name]));
      expect(help.match(/^ {2}.{4}--/gm)).toHaveLength(Object.keys(options).length);
      expect(help.split('\n').filter((line) => line.length > 125)).toEqual([]);
    }
  });

  it.skipIf(isWindows)('has examples that run', () => {
    for (const { examples } of commands) {
      for (const example of examples) {
        const { status, stderr } = place.shell(example);
        expect(status, `${example}: ${stderr}`).toBe(0);
      }
    }
  });

  it('knows every option of the API', () => {
    const used = {
      core: [
        'new TriMesh',
        'criticalPoints',
        'levelSets',
        'persistence',
        'simplify',
        'new Smoother',
        'tikhonov',
        'interpolate',
        'leastSquares',
        'lowPass',
        'bilateral',
        'prescribe',
        'smooth',
        'weld',
        'constraints',
        'levels',
        'extrema',
        'epsilon',
      ],
      files: Object.keys(api.files),
      pictures: Object.keys(api.pictures),
    };
    const namesOf = (entry) => used[entry].flatMap((name) => api[entry][name].split(' '));
    const names = Object.keys(used).flatMap(namesOf);
    expect(names.length).toBeGreaterThan(100);
    expect(names.filter((name) => !isKnown(name))).toEqual([]);
  });

  it('says the version, as the installed command', () => {
    const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
    expect(place.output(['--version'])).toBe(`${version}\n`);
    const command = join(folder, isWindows ? 'morse-smooth.cmd' : 'morse-smooth');
    expect(execFileSync(command, ['--version'], { encoding: 'utf8', shell: isWindows })).toBe(`${version}\n`);
  });
});
