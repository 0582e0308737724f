// What goes wrong, in one sentence for people who gave a command, and the exit code for programs.
import { isOption, kebab } from './options.js';

/** Exit codes: of a computation that failed or of bad data, and of a command that is wrong. */
export const FAILED = 1;
export const MISUSED = 2;

/** Something that the command line found out by itself. */
export class Failure extends Error {
  constructor(code, message, { exit = FAILED, advice } = {}) {
    super(message);
    this.code = code;
    this.exit = exit;
    this.advice = advice;
  }
}

/** A command that is wrong. */
export const misuse = (message, advice) => new Failure('WrongUsage', message, { exit: MISUSED, advice });

/** Codes of the API that say that the command is wrong, and not the data. */
const MISUSES = [
  'UnknownOption',
  'InvalidOption',
  'InapplicableOption',
  'InvalidArgument',
  'UnsupportedOption',
  'UnknownColumn',
  'AmbiguousColumn',
];

/** What can be done, where the message does not say it in the words of the command line; `options` are those of the command. */
const ADVICE = {
  LengthMismatch: (options) => 'values' in options && 'the values must be for this very mesh, one for each vertex',
  OutOfMemory: (options) => 'precision' in options && 'try --precision single, or --solver cg',
  NotPositiveDefinite: () => 'try a larger --epsilon, or --weights intrinsic-delaunay',
  IndefinitePreconditioner: () => 'try a larger --epsilon, or --weights intrinsic-delaunay',
  NotConverged: () => 'try a larger --epsilon, or --solver cholesky',
  Unconstrained: (options) =>
    ('complete' in options && 'try --complete') || ('unconstrained' in options && 'try --unconstrained keep'),
  FieldsNotSupported: () => 'choose another format by --to, or csv for the values alone',
  BinaryNotSupported: () => 'leave out --binary, or choose another format by --to',
  AmbiguousColumn: () => 'name one by --column',
  TooFewExtrema: () => 'try --of input',
  Diverged: () => 'try --weights intrinsic-delaunay or uniform',
};

/** What options take beside what the API says: of it they are made of several. */
const ALSO = {
  'epsilon.rule': 'or a number, or auto',
  'constraints.from': 'or vertex numbers with commas between them',
};

/** What the system says of a file. */
const SYSTEM = {
  ENOENT: 'there is no such file or folder',
  EACCES: 'it may not be read or written',
  EPERM: 'it may not be read or written',
  EISDIR: 'it is a folder',
  ENOTDIR: 'a part of its path is no folder',
  ENOSPC: 'the disk is full',
  EROFS: 'the disk is for reading only',
  EMFILE: 'too many files are open',
};

/** Says of what a function throws which file it is about. */
export function about(place, action) {
  try {
    return action();
  } catch (error) {
    error.place ??= place;
    throw error;
  }
}

/** The exit code and the sentence for what was thrown. */
export function told(error, command) {
  const options = command?.options ?? {};
  const place = error.place === undefined ? '' : `${error.place === '-' ? 'standard input' : error.place}: `;
  const code = typeof error.code === 'string' ? error.code : 'InternalError';
  const exit = error.exit ?? (MISUSES.includes(code) ? MISUSED : FAILED);
  const message = SYSTEM[code] ?? (error instanceof Failure ? error.message : inFlags(error.message ?? String(error)));
  const bug = typeof error.code === 'string' ? undefined : 'this is a bug, please report it';
  const advice = error.advice ?? bug ?? ALSO[error.detail?.option] ?? (ADVICE[code]?.(options) || undefined);
  const known = code === 'WrongUsage' ? '' : ` (${[code, ...idsOf(error.detail)].join(', ')})`;
  const title = ['morse-smooth', ...(command ? [command.name] : [])].join(' ');
  return { exit, sentence: `${title}: ${place}${message}${known}${advice ? `; ${advice}` : ''}` };
}

/** The numbers of an error's detail, for programs that read the sentence. */
const idsOf = (detail) =>
  Object.entries(detail ?? {}).flatMap(([name, value]) => (typeof value === 'number' ? [`${name} ${value}`] : []));

/** A message of the API with its options as they are written here; the object that an option is in does not matter. */
function inFlags(message) {
  const inWords = message
    .replace('(option `values`)', '(without --keep-values)')
    .replace(/`(?:\w+\.)*(\w+)`/g, (whole, name) => {
      if (name === 'rule' && whole.includes('epsilon')) return '--epsilon';
      if (name === 'from') return whole.includes('extrema') ? '--extrema' : '--constraints';
      return isOption(name) ? `--${kebab(name)}` : whole;
    });
  return inWords.replace(/\b(the )?option (?=--)/g, '');
}
