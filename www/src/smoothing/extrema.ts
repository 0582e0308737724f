/** The user's side of exact extrema: which vertices are marked as chosen, and what is said of them. */
import type { ExactReport, Found } from '../protocol';
import type { Reading } from '../reading/reading';
import type { Constraining } from './constraining';
import { isExact } from './settings';
import type { Smoothing } from './settings';

const BY_SMOOTHED = 'The threshold is for the smoothed field; dots: input, crosses: result';

export const EXACT_PREVIEW = 'Preview: the chosen extrema, still rough';

export class ChosenExtrema {
  /** Of the field after, where its extrema were chosen. */
  report: ExactReport | null = null;

  constructor(
    private readonly reading: Reading,
    private readonly constraining: Constraining,
  ) {}

  /** They have rings, as constraints have. */
  mark(settings: Pick<Smoothing, 'method' | 'exact'>): void {
    const isOn = isExact(settings);
    const isByField = settings.exact.of === 'smoothed';
    this.reading.setElsewhere(isOn && isByField ? BY_SMOOTHED : '');
    const vertices = isByField ? this.found : this.reading.kept;
    this.constraining.setExtrema(isOn ? foundOf(vertices) : null, isByField);
  }

  /** Those of the result, where nobody knows them before. */
  private get found(): number[] {
    const { report } = this;
    return report ? [...report.minima, ...report.maxima].sort((a, b) => a - b) : [];
  }
}

/** As constraints are marked, without neighbours. */
function foundOf(vertices: readonly number[]): Found {
  const features = Uint32Array.from(vertices);
  return { features, values: new Float64Array(features.length), all: features };
}
