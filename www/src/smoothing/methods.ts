/** The worker's side of the methods: runs the chosen one and reports on it. */
import { Smoother } from 'morse-smooth';
import type { Metric, PersistencePairs, Prescribed, Smoothed, SmoothingFamily, TriMesh } from 'morse-smooth';
import { keptExtrema, thresholdOf } from '../findings';
import { omitting } from '../gaps';
import type { Field } from '../gaps';
import { rangeOf } from '../measures';
import type { AfterReport, ExactReport, Found, Settings } from '../protocol';
import { hasOverrides, keptPairs } from '../reading/pairs';
import { prescribed } from './exact';
import { byElements, isExact } from './settings';

/** A field and what became of it; the time is measured around it. */
export type Result = Omit<AfterReport, 'milliseconds'> & { values: Float64Array };

export class Methods {
  private smoother: Smoother | null = null;
  /** What the smoother was made for. */
  private made = '';

  constructor(
    private readonly mesh: TriMesh,
    /** The mean length of the triangles' sides. */
    private readonly meanEdge: number,
    private readonly onProgress: (fraction: number) => void,
  ) {}

  free(): void {
    this.smoother?.free();
    this.smoother = null;
  }

  /** `found`: of the methods with constraints. */
  run(field: Field, settings: Settings, pairs: PersistencePairs, found: Found | null): Result {
    if (settings.method === 'simplify') return this.simplified(field.known, settings, pairs);
    const exact = isExact(settings) ? this.exact(field, settings, pairs, false) : null;
    const { values: smoothed, report } = exact ?? this.smoothed(field, settings, found);
    const { lInfinity, sobolevBefore, sobolevAfter, before, after } = report;
    return {
      values: smoothed,
      method: settings.method,
      settings: nameOf(settings),
      before,
      after,
      lInfinity,
      sobolevBefore,
      sobolevAfter,
      features: found?.features.length ?? null,
      smoothing: report,
      pairsRemoved: null,
      unavoidable: null,
      exact: exact && withoutField(exact),
    };
  }

  /** A field with exactly the chosen extrema; for a preview one that takes no longer than smoothing. */
  exact(field: Field, settings: Settings, pairs: PersistencePairs, preview: boolean): Prescribed {
    return prescribed(this.smootherFor(settings), field, settings, { pairs, meanEdge: this.meanEdge, preview });
  }

  /** Of all ε at once, as far as one factorisation takes it: best near the ε of the settings. */
  family({ values, gaps }: Field, settings: Settings, found: Found | null): SmoothingFamily {
    const { epsilon, metric, stars, unconstrained } = settings;
    const constraints = { from: 'vertices', vertices: found?.features ?? [], stars } as const;
    return this.smootherFor(settings).family(values, {
      epsilon,
      factorizations: 1,
      onProgress: () => undefined,
      ...(gaps > 0 ? { missing: settings.missing } : {}),
      ...(settings.method === 'leastSquares'
        ? { method: 'leastSquares', constraints, unconstrained }
        : { method: 'tikhonov', metric: metric as Metric }),
    });
  }

  private smoothed({ values, known, gaps }: Field, settings: Settings, found: Found | null): Smoothed {
    const smoother = this.smootherFor(settings);
    const { epsilon, metric, wavelength, energy, stars, unconstrained } = settings;
    const holes = omitting(values);
    const missing = gaps > 0 ? { missing: settings.missing } : {};
    const constraints = { from: 'vertices', vertices: found?.features ?? [], stars } as const;
    switch (settings.method) {
      case 'interpolate':
        return smoother.interpolate(values, { constraints, energy, unconstrained, ...missing });
      case 'leastSquares':
        return smoother.leastSquares(values, { constraints, epsilon, unconstrained, ...missing });
      case 'lowPass':
        return smoother.lowPass(values, { ...settings.lowPass, ...holes });
      case 'bilateral': {
        const { iterations, radius, sigmaDistance, sigmaValue } = settings.bilateral;
        const [low, high] = rangeOf(known);
        return smoother.bilateral(values, {
          ...holes,
          iterations,
          radius: radius * this.meanEdge,
          sigmaDistance: sigmaDistance * this.meanEdge,
          // A constant field has no range, and stays as it is whatever this is.
          sigmaValue: sigmaValue * (high > low ? high - low : 1),
        });
      }
      default:
        return metric === 'finiteElements'
          ? smoother.tikhonov(values, { cutoffWavelength: wavelength * this.meanEdge, ...missing })
          : smoother.tikhonov(values, { epsilon, metric, ...missing });
    }
  }

  /** Its operators and symbolic factors serve every method, ε and field, as long as the operator is the same. */
  private smootherFor(settings: Settings): Smoother {
    const { weights } = settings;
    // What extrema are prescribed for is not linear in the values.
    const bounds = settings.bounds && !isExact(settings);
    const operator = byElements(settings) ? ({ operator: 'fem' } as const) : { weights };
    const wanted = JSON.stringify([operator, bounds]);
    if (!this.smoother || this.made !== wanted) {
      this.free();
      const onProgress = ({ fraction }: { fraction: number }): void => this.onProgress(fraction);
      this.smoother = new Smoother(this.mesh, { ...operator, bounds, onProgress });
      this.made = wanted;
    }
    return this.smoother;
  }

  private simplified(before: Float64Array, settings: Settings, pairs: PersistencePairs): Result {
    const { persistence, overrides } = settings;
    const holes = omitting(before);
    const { values, unavoidable } = this.mesh.simplify(before, {
      ...(hasOverrides(overrides) ? { keep: keptExtrema(pairs, before, settings) } : { threshold: persistence }),
      ...holes,
    });
    const [low, high] = rangeOf(before);
    const range = high > low ? high - low : 1;
    const dropped = pairs.extrema.length - keptPairs(pairs, thresholdOf(before, settings), overrides).length;
    let largest = 0;
    // What is missing differs by nothing.
    for (let i = 0; i < values.length; i++) largest = Math.max(largest, Math.abs(values[i]! - before[i]!) || 0);
    return {
      values,
      method: 'simplify',
      settings: nameOf(settings),
      before: this.mesh.criticalPoints(before, holes).counts,
      after: this.mesh.criticalPoints(values, holes).counts,
      lInfinity: largest / range,
      sobolevBefore: sobolevOf(this.mesh, before) / range ** 2,
      sobolevAfter: sobolevOf(this.mesh, values) / range ** 2,
      features: null,
      smoothing: null,
      pairsRemoved: Math.max(0, dropped - unavoidable.length),
      unavoidable: unavoidable.length,
      exact: null,
    };
  }
}

/** What is sent is given away. */
function withoutField({ values: _values, report: _report, reports: _reports, ...exact }: Prescribed): ExactReport {
  const { minima, maxima, unavoidable } = exact;
  return { ...exact, minima: minima.slice(), maxima: maxima.slice(), unavoidable: unavoidable.slice() };
}

const sobolevOf = (mesh: TriMesh, values: Float64Array): number => mesh.smoothness(values, omitting(values)).sobolev;

/** What the report needs to know of how the field was made. */
function nameOf({ metric, energy, lowPass }: Settings): AfterReport['settings'] {
  return { metric, energy, isDiffusion: lowPass.mu === 0 };
}
