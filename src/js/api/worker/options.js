// What calls of a connection take beside the arguments of the API.
import { isRecord } from '../../runtime/convert.js';
import { MorseSmoothError, invalidArgument, invalidOption } from '../../runtime/error.js';

const isGiven = (value) => value !== undefined && value !== null;
const isFlag = (value) => !isGiven(value) || typeof value === 'boolean';
const isFunction = (value) => !isGiven(value) || typeof value === 'function';
export const isSignal = (value) =>
  !isGiven(value) || (typeof value.aborted === 'boolean' && typeof value.addEventListener === 'function');

/** The arguments of a call that go to the worker (`args`), and what is for this end. */
export function separate(given, { before, hasOptions }) {
  const args = Array.from({ length: before }, (_, k) => given[k]);
  const options = given[before];
  if (!isRecord(options)) {
    if (hasOptions && options !== undefined) args.push(options);
    else if (options !== undefined) throw invalidArgument('options', 'a plain object');
    return { args, latest: false, transfer: false };
  }
  const { signal, onProgress, latest, transfer, ...rest } = options;
  if (!isSignal(signal)) throw invalidOption('signal', 'an AbortSignal');
  if (!isFunction(onProgress)) throw invalidOption('onProgress', 'a function');
  if (!isFlag(latest)) throw invalidOption('latest', 'true or false');
  if (!isFlag(transfer)) throw invalidOption('transfer', 'true or false');
  const [unknown] = Object.keys(rest);
  if (!hasOptions && unknown !== undefined) throw unknownOption(unknown);
  if (unknown !== undefined) args.push(rest);
  return { args, signal: signal ?? undefined, onProgress: onProgress ?? undefined, latest, transfer };
}

export function unknownOption(option) {
  return new MorseSmoothError('UnknownOption', `there is no option \`${option}\``, { option });
}
