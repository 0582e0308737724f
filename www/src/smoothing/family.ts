/**
 * The worker's side of ε: the smoothed fields of all ε, made and grown while nobody asks the worker for anything, and the curves and
 * choices that are read off them. A step of that takes as long as one factorisation, during which the worker cannot listen; so there
 * is a pause between each two.
 */
import { MorseSmoothError } from 'morse-smooth';
import type { ChosenEpsilon, EpsilonRule, SmoothingFamily } from 'morse-smooth';
import { Refusal } from '../failure';
import type { EpsilonCurve, Part } from '../protocol';
import { usesEpsilon } from './settings';
import type { Smoothing } from './settings';

/** A factorisation of more vertices takes so long that the page would seem to hang. */
const MOST_VERTICES = 200_000;
/** ε in each decade of the curves, and in the whole range from 1e-6 to 1e4. */
const PER_DECADE = 8;
const EPSILONS = Float64Array.from({ length: 10 * PER_DECADE + 1 }, (_, k) => 10 ** (-6 + k / PER_DECADE));
/** Counts come coarse first: of every eighth ε, then of those half way between. */
const ORDER = [8, 4, 2, 1].flatMap((stride) =>
  [...EPSILONS.keys()].filter((k) => k % stride === 0 && (stride === 8 || k % (2 * stride) !== 0)),
);
/** Milliseconds of curves at a time. */
const SLICE = 25;
const MARKED: readonly EpsilonRule[] = [{ rule: 'gcv' }, { rule: 'lCurve' }, { rule: 'discrepancy' }];
/** About as many factorisations as the whole range takes. */
const USUAL = 7;
/** The least and the largest pause, in milliseconds: half as long as the last step took. */
const PAUSES = [20, 800] as const;

/** What a family is made of. */
export interface FamilyJob {
  /** Everything that the family depends on. */
  key: string;
  /** Why there is none; null where there can be one. */
  why: string | null;
  make(): SmoothingFamily;
  /** How long one factorisation takes, in milliseconds. */
  cost: number;
}

export function whyNoFamily(settings: Smoothing, vertexCount: number): string | null {
  if (!usesEpsilon(settings)) {
    return settings.method === 'tikhonov'
      ? 'With finite elements a cut-off wavelength takes the place of ε.'
      : 'This method takes no ε. Tikhonov smoothing and least squares do.';
  }
  if (vertexCount > MOST_VERTICES)
    return `The mesh has more than ${MOST_VERTICES.toLocaleString('en')} vertices: each ε is computed by itself, and there are no curves.`;
  return null;
}

export class Families {
  /** Milliseconds until the next step. */
  pause: number = PAUSES[0];
  private job: FamilyJob | null = null;
  private family: SmoothingFamily | null = null;
  private steps: Iterator<void> | null = null;

  constructor(private readonly onProgress: (fraction: number) => void) {}

  /** The family of another job is freed. */
  prepare(job: FamilyJob, send: (part: Part) => void): void {
    if (this.job?.key === job.key) return;
    this.drop();
    this.job = job;
    send({ kind: 'family', state: job.why === null ? 'coming' : 'none', why: job.why ?? '', error: 1 });
    if (job.why !== null) return;
    this.rest(job.cost);
    this.steps = this.work(job, send);
  }

  drop(): void {
    this.family?.free();
    this.family = this.job = this.steps = null;
  }

  /** Whether there is more to do. */
  step(): boolean {
    if (!this.steps) return false;
    const start = performance.now();
    let isDone = true;
    try {
      isDone = this.steps.next().done === true;
    } catch {
      // Nobody has asked for it: what is there remains, and the slider answers with the exact field.
    }
    this.rest(performance.now() - start);
    if (isDone) this.steps = null;
    return !isDone;
  }

  /** The smoothed field, and how far it may be from the exact one; null where there is no family with that key. */
  read(key: string, epsilon: number): { values: Float64Array; error: number } | null {
    if (!this.family || this.job?.key !== key) return null;
    return { values: this.family.values(epsilon), error: this.family.errorAt(epsilon) };
  }

  /** Waits until the family is complete: the choice is that of the package then. */
  choose(rule: EpsilonRule): ChosenEpsilon {
    const { job, onProgress } = this;
    if (!job || job.why !== null) throw new Refusal('NoEpsilon', job?.why ?? 'There is no smoothed field.');
    const family = (this.family ??= job.make());
    while (!family.complete) {
      const done = family.factorizations;
      family.grow({ onProgress: ({ fraction }) => onProgress(Math.min(1, (done + fraction) / USUAL)) });
    }
    return family.choose(rule);
  }

  private rest(cost: number): void {
    const [least, most] = PAUSES;
    this.pause = Math.min(most, Math.max(least, cost / 2));
  }

  private *work(job: FamilyJob, send: (part: Part) => void): Generator<void, void> {
    const tell = (state: 'growing' | 'complete'): void =>
      send({ kind: 'family', state, why: '', error: family.errorEstimate });
    let family: SmoothingFamily;
    try {
      family = this.family ??= job.make();
    } catch (error) {
      return send({ kind: 'family', state: 'none', why: whyNot(error), error: 1 });
    }
    tell('growing');
    yield;
    yield* this.draw(family, send, false);
    while (!family.complete) {
      yield;
      try {
        family.grow({ onProgress: () => undefined });
      } catch {
        // It goes on as it is: its estimated error is told.
        break;
      }
      tell('growing');
    }
    tell('complete');
    yield;
    yield* this.draw(family, send, true);
  }

  /** The L-curve and the choices, then the counts, which take longest. */
  private *draw(family: SmoothingFamily, send: (part: Part) => void, counts: boolean): Generator<void, void> {
    const columns = (): Float64Array => new Float64Array(EPSILONS.length).fill(NaN);
    const curve: EpsilonCurve = {
      epsilons: EPSILONS,
      distances: columns(),
      roughness: columns(),
      minima: columns(),
      maxima: columns(),
      saddles: columns(),
    };
    yield* inSlices((k) => {
      const { metricNorm, laplacianNorm } = family.sweep({ epsilons: EPSILONS.subarray(k, k + 1) });
      curve.distances[k] = metricNorm[0]!;
      curve.roughness[k] = laplacianNorm[0]!;
    });
    send({ kind: 'epsilonCurve', curve: copied(curve) });
    send({ kind: 'choices', choices: MARKED.map((rule) => family.choose(rule)) });
    if (!counts) return;
    yield;
    const count = inSlices((k) => {
      const { minima, maxima, saddles } = family.sweep({ epsilons: EPSILONS.subarray(k, k + 1), counts: true });
      curve.minima[k] = minima[0]!;
      curve.maxima[k] = maxima[0]!;
      curve.saddles[k] = saddles[0]!;
    });
    for (const _ of count) {
      send({ kind: 'epsilonCurve', curve: copied(curve) });
      yield;
    }
    send({ kind: 'epsilonCurve', curve: copied(curve) });
  }
}

/** Of all ε, until a slice of time is over. */
function* inSlices(use: (k: number) => void): Generator<void, void> {
  let start = performance.now();
  for (const k of ORDER) {
    use(k);
    if (performance.now() - start < SLICE) continue;
    yield;
    start = performance.now();
  }
}

/** What is sent is given away. */
const copied = (curve: EpsilonCurve): EpsilonCurve =>
  Object.fromEntries(Object.entries(curve).map(([name, column]) => [name, column.slice()])) as unknown as EpsilonCurve;

function whyNot(error: unknown): string {
  if (error instanceof MorseSmoothError && error.code === 'OutOfMemory')
    return 'There is not enough memory for all ε at once: each is computed by itself, and there are no curves.';
  return error instanceof Error ? error.message : String(error);
}
