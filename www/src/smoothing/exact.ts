/** The worker's side of exact extrema: what is asked of the package, and its refusals in words for people. No state. */
import { MorseSmoothError } from 'morse-smooth';
import type { Extrema, Metric, PersistencePairs, Prescribed, PrescribeOptions, Smoother } from 'morse-smooth';
import { Refusal } from '../failure';
import { thresholdOf } from '../findings';
import type { Field } from '../gaps';
import { omitting } from '../gaps';
import type { Settings } from '../protocol';
import { hasOverrides, keptPairs } from '../reading/pairs';
import { byElements } from './settings';

export interface Around {
  /** Of the field that comes in. */
  pairs: PersistencePairs;
  meanEdge: number;
  /** What is at hand at once: exact, but flat or steep where others were. */
  preview: boolean;
}

export function prescribed(
  smoother: Smoother,
  field: Field,
  settings: Settings,
  { pairs, meanEdge, preview }: Around,
): Prescribed {
  const { values } = field;
  const { epsilon, metric, wavelength, exact } = settings;
  const options = {
    extrema: extremaOf(settings, field.known, pairs),
    ...omitting(values),
    // A preview can do without what shapes the field further.
    ...(!preview && exact.keepValues ? { values: 'keep' as const } : {}),
    ...(!preview && exact.prominence > 0 ? { prominence: exact.prominence } : {}),
    ...(preview ? { preview, onProgress: () => undefined } : {}),
  };
  try {
    return byElements(settings)
      ? smoother.prescribe(values, { ...options, cutoffWavelength: wavelength * meanEdge })
      : smoother.prescribe(values, { ...options, epsilon, metric: metric as Metric } satisfies PrescribeOptions);
  } catch (error) {
    throw explained(error);
  }
}

/** The kept pairs of the diagram, and what has no partner. */
function extremaOf(settings: Settings, values: Float64Array, pairs: PersistencePairs): Extrema {
  const { persistence: threshold, overrides, exact } = settings;
  if (exact.of === 'smoothed' || !hasOverrides(overrides)) return { from: 'persistence', threshold, of: exact.of };
  const kept = keptPairs(pairs, thresholdOf(values, settings), overrides);
  const of = (kind: number): number[] => kept.flatMap((k) => (pairs.kinds[k] === kind ? [pairs.extrema[k]!] : []));
  return { minima: [...pairs.essentialMinima, ...of(-1)], maxima: [...pairs.essentialMaxima, ...of(1)] };
}

/** What can be done about it on the page. */
const WAYS: Record<string, string> = {
  AdjacentExtrema: 'Drop one of them in the persistence diagram.',
  ConflictingExtremum: 'Drop it as one of the two in the persistence diagram.',
  Unconstrained: 'Keep a minimum and a maximum there.',
  ConstantField: 'Choose a field that is not the same everywhere.',
  NotConverged: 'Another ε or fewer extrema may do.',
};

/** Between which vertices there is no room. */
interface Ends {
  from?: number;
  to?: number;
}

/** In place of the package's message, which names its options. */
function noRoom({ from, to }: Ends): string {
  const where = from === undefined || to === undefined ? '' : ` from vertex ${from} up to vertex ${to}`;
  return (
    `The chosen extrema leave no room for a field that rises${where}: values that are kept and the height that is asked for ` +
    'contradict each other. Untick “Keep their values”, ask for less height, or choose other extrema.'
  );
}

function explained(error: unknown): unknown {
  if (!(error instanceof MorseSmoothError)) return error;
  if (error.code === 'Infeasible') return new Refusal(error.code, noRoom(error.detail as Ends));
  const way = WAYS[error.code];
  return way ? new Refusal(error.code, `${error.message.replace(/\.$/, '')}. ${way}`) : error;
}
