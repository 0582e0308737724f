import { isRecord, toNumbers, toOptions } from '../../runtime/convert.js';
import { invalidArgument } from '../../runtime/error.js';
import { watched } from '../../runtime/progress.js';

/** For every family its handle, that of its smoother, what that one calls back, and what is known of the family. */
const states = new WeakMap();

function stateOf(family) {
  const state = states.get(family);
  if (state === undefined) throw invalidArgument('family', 'a SmoothingFamily');
  return state;
}

/** A family that a smoother made. */
export function familyOf(handle, smoother, onProgress) {
  const family = Object.create(SmoothingFamily.prototype);
  states.set(family, { handle, smoother, onProgress, about: null });
  return family;
}

/** ε or a rule for it, as a copy on which nothing of the caller's can run. */
export function toRule(value) {
  return isRecord(value) ? { ...value } : value;
}

export class SmoothingFamily {
  constructor() {
    throw invalidArgument('family', 'made by `smoother.family(values)`');
  }

  get epsilonRange() {
    return aboutOf(this).epsilonRange.slice();
  }

  get dimension() {
    return aboutOf(this).dimension;
  }

  get factorizations() {
    return aboutOf(this).factorizations;
  }

  get shifts() {
    return aboutOf(this).shifts.slice();
  }

  get errorEstimate() {
    return aboutOf(this).errorEstimate;
  }

  get complete() {
    return aboutOf(this).complete;
  }

  errorAt(epsilon) {
    const number = toEpsilon(epsilon);
    return stateOf(this).handle.use((raw) => raw.errorAt(number));
  }

  grow(options) {
    const state = stateOf(this);
    state.about = null;
    return watching(state, options, (settings) =>
      state.smoother.useAlone((smoother) => state.handle.useAlone((raw) => smoother.grow(raw, settings))),
    );
  }

  values(epsilon) {
    const number = toEpsilon(epsilon);
    return stateOf(this).handle.use((raw) => raw.values(number));
  }

  at(epsilon, options) {
    const number = toEpsilon(epsilon);
    return call(this, options, (raw, settings) => raw.at(number, settings));
  }

  sweep(options) {
    const { epsilons, ...rest } = toOptions(options) ?? {};
    const numbers = epsilons === undefined || epsilons === null ? undefined : toNumbers(epsilons, 'epsilons');
    return call(this, rest, (raw, settings) => raw.sweep(numbers, settings));
  }

  choose(rule, options) {
    const settled = toRule(rule ?? 'auto');
    return call(this, options, (raw, settings) => raw.choose(settled, settings));
  }

  lives(options) {
    return call(this, options, (raw, settings) => raw.lives(settings));
  }

  free() {
    stateOf(this).handle.free();
  }
}

/** Calls the raw family, which does not change by it. */
function call(family, options, action) {
  const state = stateOf(family);
  return watching(state, options, (settings) => state.handle.use((raw) => action(raw, settings)));
}

/** Calls back what the options name, or else what the smoother was made with. */
function watching({ onProgress }, options, action) {
  const given = toOptions(options);
  const isOwn = given?.onProgress !== undefined && given?.onProgress !== null;
  return watched(onProgress && !isOwn ? { ...given, onProgress } : given, action);
}

function aboutOf(family) {
  const state = stateOf(family);
  return state.handle.use((raw) => (state.about ??= raw.about()));
}

function toEpsilon(value) {
  if (typeof value !== 'number') throw invalidArgument('epsilon', 'a number');
  return value;
}
