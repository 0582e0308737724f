// Values of options, out of the words of a command.
import { readFileSync } from 'node:fs';
import { about, misuse } from './failures.js';
import { camel } from './options.js';

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** Reads a value by the kind of its option, which is written `flag`. */
export const readers = {
  text: (word) => word,
  texts: (word) => word.split(','),
  // The API's names, and those in the style of the options.
  choice: (word) => camel(word),
  number: toNumber,
  numbers: (word, flag) => word.split(',').map((part) => toNumber(part, flag, 'numbers with commas between them')),
  vertices: toVertices,
  epsilon: (word, flag) => (/^[a-z]/i.test(word) ? camel(word) : toNumber(word, flag)),
  verticesOrRule: (word, flag) => (/^[a-z]/i.test(word) ? camel(word) : toVertices(word, flag)),
  size: (word, flag) => {
    const match = /^(\d+)[x×](\d+)$/i.exec(word);
    if (!match) throw misuse(`${flag} takes a size such as 1200x900, and not ‘${word}’`);
    return match.slice(1).map(Number);
  },
};

function toNumber(word, flag, expected = 'a number') {
  if (!NUMBER.test(word.trim())) throw misuse(`${flag} takes ${expected}, and not ‘${word}’`);
  return Number(word);
}

/** Vertex numbers with commas between them, or in a file (`@vertices.txt`), where anything but digits is between them. */
function toVertices(word, flag) {
  const isFile = word.startsWith('@');
  const list = isFile ? about(word.slice(1), () => readFileSync(word.slice(1), 'utf8')) : word;
  const parts = list.split(/[\s,;]+/).filter((part) => part !== '');
  const wrong = parts.find((part) => !/^\d+$/.test(part));
  if (wrong === undefined && parts.length > 0) return parts.map(Number);
  const instead = wrong === undefined ? 'nothing' : `‘${wrong}’`;
  throw misuse(
    `${flag} takes vertex numbers from 0 with commas between them, or a file of them as @FILE, and not ${instead}`,
  );
}
