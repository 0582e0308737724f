// The command line: finds the command, has it run, and says what went wrong in one sentence.
import { hintsOf } from '../runtime/hints.js';
import { commands } from './commands/index.js';
import { misuse, told } from './failures.js';
import { helpOf, overview } from './help.js';
import { Notes } from './notes.js';
import { endWithReader, tables, write } from './output.js';
import { parse } from './parse.js';

/** Runs a command by its words; the exit code of the process says how that went. */
export async function main(words) {
  endWithReader();
  let command;
  let notes;
  try {
    const [first, ...others] = words;
    if (first === undefined) {
      process.stderr.write(`${overview(commands)}\n`);
      process.exitCode = 2;
      return;
    }
    if (['--version', '-V'].includes(first)) return await write('-', `${__VERSION__}\n`);
    const isHelp = ['--help', '-h', 'help'].includes(first);
    if (isHelp && others.length === 0) return await write('-', `${overview(commands)}\n`);
    command = find(isHelp ? others[0] : first);
    const { given, input } = isHelp ? { given: { help: true } } : parse(command, others, commands);
    if (given.help) return await write('-', `${helpOf(command, await formatLists())}\n`);
    notes = new Notes(given.quiet);
    await command.run({ input, given, notes });
    notes.clear();
  } catch (error) {
    notes?.clear();
    const { exit, sentence } = told(error, command);
    process.stderr.write(`${sentence}\n`);
    process.exitCode = exit;
  }
}

function find(word) {
  const found = commands.find(({ name }) => name === word);
  if (found) return found;
  const names = commands.map(({ name }) => name);
  const meant = hintsOf({ commands: names.join(' ') })(word)?.detail.meant;
  throw misuse(`there is no command ‘${word}’`, meant ? `did you mean ‘${meant}’?` : `there are ${names.join(', ')}`);
}

async function formatLists() {
  const { formats } = await import('morse-smooth/files');
  const all = formats();
  const namesOf = (verb) => all.flatMap((format) => (format[verb] ? [format.name] : []));
  return { read: namesOf('reads'), written: namesOf('writes'), tables };
}
