// What a command says of its result: as text for people, a table (CSV) for spreadsheets or JSON for programs.
import { misuse } from './failures.js';
import { checkPlace, tableText, write } from './output.js';

const FORMATS = ['text', 'csv', 'json'];

/** Where a report goes and as what, said before the work. */
export function reportTarget({ output, to, json }) {
  const ending = /\.(csv|json)$/i.exec(output ?? '')?.[1].toLowerCase();
  if (json && to !== undefined && to !== 'json') throw misuse('--json and --to say different things');
  const format = json ? 'json' : (to ?? ending ?? 'text');
  if (!FORMATS.includes(format)) throw misuse(`--to takes ${FORMATS.join(', ')} here, and not ‘${format}’`);
  checkPlace(output);
  return { path: output ?? '-', format };
}

/**
 * Writes a report: `json` is all of it, `lines` are those of the text, `columns` with `rows` the table that follows them and that
 * CSV consists of.
 */
export function writeReport({ path, format }, { json, lines, columns, rows = [] }) {
  if (format === 'json') return write(path, jsonText(json));
  if (format === 'csv') {
    if (!columns) throw misuse('there is no table in this report', 'leave out --to csv');
    return write(path, tableText(columns, rows));
  }
  const table = columns && rows.length > 0 ? ['', ...aligned([columns, ...rows.map((row) => row.map(shown))])] : [];
  return write(path, [...lines, ...table].map((line) => `${line}\n`).join(''));
}

/** Typed arrays as arrays; what JSON has no numbers for as null. */
export const jsonText = (value) =>
  `${JSON.stringify(value, (_, entry) => (ArrayBuffer.isView(entry) ? Array.from(entry) : entry), 2).replace(/\[[-\d.,\se+null]*\]/g, (list) => list.replace(/\s+/g, ' '))}\n`;

/** Columns one below the other, numbers to the right. */
export function aligned(table) {
  const widths = table[0].map((_, k) => table.reduce((most, row) => Math.max(most, row[k].length), 0));
  const isNumber = table[0].map((_, k) => table.slice(1).every((row) => /^[-+\d.e∞–]*$/.test(row[k])));
  const padded = (row) => row.map((text, k) => (isNumber[k] ? text.padStart(widths[k]) : text.padEnd(widths[k])));
  return table.map((row) => padded(row).join('  ').trimEnd());
}

/** A number as people read it; CSV and JSON have all digits. */
export function shown(value) {
  if (typeof value !== 'number') return String(value);
  if (!Number.isFinite(value)) return '–';
  if (Number.isInteger(value)) return String(value);
  return String(Number(value.toPrecision(6)));
}

/** A number with its word. */
export const counted = (count, one, many = `${one}s`) => `${count} ${count === 1 ? one : many}`;

/** Names of kinds of critical points. */
export const KINDS = { '-1': 'minimum', 0: 'saddle', 1: 'maximum' };

/** Counts in a sentence. */
export const countsLine = ({ minima, saddles, maxima }) =>
  [counted(minima, 'minimum', 'minima'), counted(saddles, 'saddle'), counted(maxima, 'maximum', 'maxima')].join(', ');

/** The least and the greatest value, and how many are missing. */
export function rangeOf(values) {
  let [min, max, missing] = [Infinity, -Infinity, 0];
  for (const value of values) {
    if (Number.isNaN(value)) missing++;
    else [min, max] = [Math.min(min, value), Math.max(max, value)];
  }
  return { min, max, missing };
}
