// Options of the API that are objects, out of several options of a command.
import { misuse } from '../failures.js';
import { api, take, written } from '../options.js';
import { pick } from './critical.js';

/** ε, or the rule that chooses it. */
export function epsilonOf({ epsilon = 'auto', noise, count }) {
  const more = { ...(noise !== undefined && { noise }), ...(count !== undefined && { count }) };
  const [name] = Object.keys(more);
  const isAlone = typeof epsilon === 'number' || epsilon === 'auto';
  if (!isAlone) return { rule: epsilon, ...more };
  if (name === undefined) return epsilon;
  throw misuse(`--${name} goes with --epsilon ${name === 'noise' ? 'discrepancy' : 'at-most-critical-points'}`);
}

/** What a rule for constraints takes; `except` are names that mean something else in the command. */
export function constraintsOf(given, except = []) {
  const names = take(api.core.constraints);
  const settings = Object.fromEntries(Object.entries(pick(given, names)).filter(([name]) => !except.includes(name)));
  const { constraints } = given;
  if (constraints === undefined) {
    const [name] = Object.keys(settings);
    if (name === undefined) return undefined;
    throw misuse(
      `${written(name, names[name])} goes with --constraints`,
      'critical-points, persistence or k-means, say',
    );
  }
  if (typeof constraints === 'string') return { from: constraints, ...settings };
  return Object.keys(settings).length > 0 ? { from: 'vertices', vertices: constraints, ...settings } : constraints;
}

/** Which extrema a field shall have; nothing leaves it to the API. */
export function extremaOf({ extrema, minima, maxima, threshold, thresholdIs, of }) {
  const rule = Object.fromEntries(
    Object.entries({ threshold, thresholdIs, of }).filter(([, value]) => value !== undefined),
  );
  const hasRule = Object.keys(rule).length > 0;
  if (Array.isArray(extrema) || extrema === 'named') {
    if (hasRule) throw misuse(`${written(Object.keys(rule)[0], {})} goes with --extrema persistence`);
    if (extrema === 'named') return { minima: minima ?? [], maxima: maxima ?? [] };
    if (minima || maxima) throw misuse('--minima and --maxima go with --extrema persistence or named');
    return extrema;
  }
  if (extrema !== undefined && extrema !== 'persistence') {
    throw misuse(`--extrema takes persistence, named or vertex numbers, and not ‘${extrema}’`);
  }
  if (extrema === undefined && !hasRule && !minima && !maxima) return undefined;
  return {
    from: 'persistence',
    ...rule,
    ...(minima && { minima: countOf(minima, '--minima') }),
    ...(maxima && { maxima: countOf(maxima, '--maxima') }),
  };
}

function countOf(list, flag) {
  if (list.length === 1) return list[0];
  throw misuse(`${flag} takes a number here`, 'for vertices say --extrema named');
}
