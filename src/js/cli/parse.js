// From the words of a command to its options, by their names in the API.
import { parseArgs } from 'node:util';
import { hintsOf } from '../runtime/hints.js';
import { misuse } from './failures.js';
import { kebab, written } from './options.js';
import { readers } from './values.js';

/** What a word that begins with a dash is: a negative number belongs to the option before it. */
const NEGATIVE = /^-[\d.]/;

/**
 * The file and the options of a command. `commands` are all that there are, for hints: an option may be another one's.
 *
 * Node's parser is told the options and splits the words; what is wrong with them is said here, for it knows no hints.
 */
export function parse(command, words, commands) {
  const flags = flagsOf(command);
  const options = {};
  for (const [flag, { spec, short }] of flags) {
    options[flag] = { type: isFlag(spec) ? 'boolean' : 'string', ...(short && { short }) };
  }
  const { tokens } = parseArgs({ args: joined(words), options, strict: false, allowPositionals: true, tokens: true });
  const given = {};
  const positionals = [];
  for (const token of tokens) {
    if (token.kind === 'positional') positionals.push(token.value);
    else if (token.kind === 'option') read(token, flags, given, () => unknown(token, command, commands));
  }
  if (given.help) return { given, input: undefined };
  const [input, surplus] = positionals;
  const more = `see ‘morse-smooth ${command.name} --help’`;
  if (input === undefined) throw misuse('a mesh file is needed, or - for the standard input', more);
  if (surplus !== undefined) throw misuse(`there is one word too many: ‘${surplus}’`, more);
  return { given, input };
}

/** The options of a command as they are written, without the dashes. */
function flagsOf(command) {
  const entries = Object.entries(command.options).map(([name, spec]) => {
    return [written(name, spec).slice(2), { name, spec, short: spec.short }];
  });
  return new Map(entries);
}

const isFlag = ({ kind }) => kind === 'flag' || kind === 'switch';

/** Puts the option of a token where it belongs. */
function read({ name: flag, rawName, value, inlineValue }, flags, given, refuse) {
  const known = flags.get(flag);
  if (known === undefined) throw refuse();
  const { name, spec } = known;
  if (name in given && !spec.several) throw misuse(`${rawName} is given twice`);
  if (isFlag(spec)) {
    if (inlineValue) throw misuse(`${rawName} takes no value`);
    given[name] = spec.kind === 'flag';
    return;
  }
  const isMissing = value === undefined || (!inlineValue && value.startsWith('-') && value !== '-');
  if (isMissing) throw misuse(`${rawName} needs a value: ${rawName} ${spec.value}`);
  const result = readers[spec.kind](value, rawName);
  given[name] = spec.several ? [...(given[name] ?? []), result] : result;
}

/** The error for an option that the command does not have. */
function unknown({ rawName, name }, command, commands) {
  const namesOf = ({ options }) => [...flagsOf({ options }).keys()].join(' ');
  const own = [...flagsOf(command).keys()];
  // A name as the API writes it, the beginning of one, or one that is off by a letter; then those of other commands.
  const begun = own.filter((flag) => flag.startsWith(name));
  const near = hintsOf({ [command.name]: own.join(' ') })(name)?.detail.meant;
  const meant = own.find((flag) => flag === kebab(name)) ?? (begun.length === 1 ? begun[0] : near);
  const there = hintsOf(Object.fromEntries(commands.map((other) => [other.name, namesOf(other)])))(name)?.detail;
  const where = there?.belongsTo?.map((other) => `‘${other}’`).join(', ');
  const advice = (meant && `did you mean --${meant}?`) ?? (where && `it is an option of ${where}`);
  return misuse(`there is no option ${rawName}`, advice || `see ‘morse-smooth ${command.name} --help’`);
}

/** The words with negative numbers joined to the options before them, which Node's parser takes for options. */
function joined(words) {
  const result = [];
  for (const word of words) {
    const before = result.at(-1);
    if (NEGATIVE.test(word) && /^--[^=]+$/.test(before ?? '')) result[result.length - 1] += `=${word}`;
    else result.push(word);
  }
  return result;
}
