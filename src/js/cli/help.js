// What `--help` prints, of all commands and of each.
import { written } from './options.js';

const WIDTH = 100;

export function overview(commands) {
  const rows = commands.map(({ name, summary }) => [`  ${name}`, summary]);
  return [
    'morse-smooth: critical points and smoothing of scalar fields on triangle meshes',
    '',
    'Usage: morse-smooth COMMAND MESH [options]',
    '',
    'Commands:',
    ...columns(rows),
    '',
    'MESH is a file, or - for the standard input. `morse-smooth COMMAND --help` lists the options of a command,',
    '`morse-smooth --version` prints the version.',
    '',
    'Examples:',
    ...commands.map(({ examples }) => `  ${examples[0]}`),
    '',
    'Exit codes: 0 done; 1 the data or the computation is at fault; 2 the command is.',
  ].join('\n');
}

/** The help of one command; `lists` are formats by what can be done with them. */
export function helpOf({ name, summary, about, options, examples }, lists) {
  const rows = Object.entries(options).map(([option, spec]) => {
    const short = spec.short ? `-${spec.short}, ` : '    ';
    return [`  ${short}${written(option, spec)}${spec.value ? ` ${spec.value}` : ''}`, spec.help];
  });
  return [
    `morse-smooth ${name}: ${summary}`,
    '',
    `Usage: morse-smooth ${name} MESH [options]`,
    ...(about ? ['', ...wrapped(about, WIDTH)] : []),
    '',
    'Options:',
    ...columns(rows),
    '',
    ...wrapped(
      `Formats that are read: ${lists.read.join(', ')}. Meshes are written as ${lists.written.join(', ')}, values alone as ${lists.tables.join(', ')}.`,
      WIDTH,
    ),
    '',
    'Examples:',
    ...examples.map((example) => `  ${example}`),
  ].join('\n');
}

const VERTICES = 'IDS are vertex numbers from 0 with commas between them, or @FILE for a file of them.';
const takesVertices = (options) => Object.values(options).some(({ kind }) => /^vertices/.test(kind));

/** Two columns, the second one broken into lines. */
function columns(rows) {
  const indent = Math.max(...rows.map(([left]) => left.length)) + 2;
  return rows.flatMap(([left, right]) => {
    const [first, ...others] = wrapped(right, WIDTH - indent);
    return [left.padEnd(indent) + first, ...others.map((line) => ' '.repeat(indent) + line)];
  });
}

function wrapped(text, width) {
  const lines = [''];
  for (const word of text.split(' ')) {
    const last = lines.at(-1);
    if (last !== '' && last.length + 1 + word.length > width) lines.push(word);
    else lines[lines.length - 1] = last === '' ? word : `${last} ${word}`;
  }
  return lines;
}
