/** The part of the form that chooses a method: shows only what that method takes. */
import { clamp, element, input, select, short } from '../dom';
import type { Missing } from '../gaps';
import { ExactControls } from './exact-controls';
import { byElements, canFill, INITIAL_SMOOTHING, TAUBIN_MU } from './settings';
import type { Method, Rule, Smoothing } from './settings';

const EPSILON_RANGE = [1e-6, 1e4] as const;
const WAVELENGTH_RANGE = [0.5, 1e4] as const;
const CLUSTERS_RANGE = [1, 1e5] as const;
const LOW_PASS_RANGES = { iterations: [0, 1e4], lambda: [0.01, 1], mu: [-1, 0] } as const;
const BILATERAL_RANGES = {
  iterations: [0, 1000],
  radius: [0.1, 20],
  sigmaDistance: [0.01, 100],
  sigmaValue: [1e-4, 10],
} as const;

/** All but what is picked outside the form. */
export type SmoothingChoices = Omit<Smoothing, 'picked'>;

/** One number with its box, its range and what stands in for nonsense. */
interface Quantity {
  box: HTMLInputElement;
  range: readonly [number, number];
  fallback: number;
  isWhole?: boolean;
  /** What the box shows for 1. */
  factor?: number;
}

export class SmoothingControls {
  private readonly method = select('method');
  private readonly epsilon = input('epsilon');
  private readonly epsilonNumber = input('epsilon-number');
  private readonly metric = select('metric');
  private readonly energy = select('energy');
  private readonly weights = select('weights');
  private readonly bounds = input('bounds');
  private readonly gaps = element('#gaps', HTMLElement);
  private readonly missing = select('missing');
  private readonly filter = select('filter');
  private readonly exact: ExactControls;
  private readonly rule = select('rule');
  private readonly stars = input('stars');
  private readonly unconstrained = select('unconstrained');
  private readonly units = element('#bilateral-units', HTMLElement);
  private readonly clusters: Quantity = {
    box: input('clusters'),
    range: CLUSTERS_RANGE,
    fallback: INITIAL_SMOOTHING.clusters,
    isWhole: true,
  };
  private readonly lowPass = quantities(
    { iterations: input('low-pass-iterations'), lambda: input('lambda'), mu: input('mu') },
    LOW_PASS_RANGES,
    { ...INITIAL_SMOOTHING.lowPass, mu: TAUBIN_MU },
  );
  private readonly bilateral = quantities(
    {
      iterations: input('bilateral-iterations'),
      radius: input('bilateral-radius'),
      sigmaDistance: input('sigma-distance'),
      sigmaValue: input('sigma-value'),
    },
    BILATERAL_RANGES,
    INITIAL_SMOOTHING.bilateral,
  );
  private readonly wavelength: Quantity = {
    box: input('wavelength'),
    range: WAVELENGTH_RANGE,
    fallback: INITIAL_SMOOTHING.wavelength,
  };
  private readonly wavelengthUnits = element('#wavelength-units', HTMLElement);
  /** Of the mesh and of the field: what the bilateral filter's multiples are of. */
  private meanEdge = 0;
  private width = 0;
  private hasGaps = false;

  /** `changed` is called for whatever has to be computed, `moved` while the slider of ε moves. */
  constructor(
    private readonly changed: () => void,
    private readonly moved: () => void,
  ) {
    this.exact = new ExactControls(() => {
      this.show();
      changed();
    });
    this.bilateral.sigmaValue.factor = 100;
    writeQuantity(this.lowPass.mu, TAUBIN_MU);
    this.wire();
  }

  read(): SmoothingChoices {
    const lowPass = readAll(this.lowPass);
    return {
      method: this.method.value as Method,
      weights: this.weights.value as Smoothing['weights'],
      bounds: this.bounds.checked,
      missing: this.missing.value as Missing,
      epsilon: Number(this.epsilonNumber.value),
      metric: this.metric.value as Smoothing['metric'],
      wavelength: readQuantity(this.wavelength),
      energy: this.energy.value as Smoothing['energy'],
      lowPass: this.filter.value === 'diffusion' ? { ...lowPass, mu: 0 } : lowPass,
      bilateral: readAll(this.bilateral),
      exact: this.exact.read(),
      rule: this.rule.value as Rule,
      clusters: readQuantity(this.clusters),
      stars: this.stars.checked,
      unconstrained: this.unconstrained.value as Smoothing['unconstrained'],
    };
  }

  write(choices: SmoothingChoices): void {
    const { method, weights, bounds, epsilon, metric, energy, lowPass, bilateral } = choices;
    this.method.value = method;
    this.weights.value = weights;
    this.bounds.checked = bounds;
    this.missing.value = choices.missing;
    this.metric.value = metric;
    this.energy.value = energy;
    this.rule.value = choices.rule;
    this.stars.checked = choices.stars;
    this.unconstrained.value = choices.unconstrained;
    this.writeEpsilon(epsilon);
    this.filter.value = lowPass.mu === 0 ? 'diffusion' : 'taubin';
    // The box keeps its number while there is no second step.
    writeAll(this.lowPass, { ...lowPass, mu: lowPass.mu === 0 ? readQuantity(this.lowPass.mu) : lowPass.mu });
    writeAll(this.bilateral, bilateral);
    this.exact.write(choices.exact);
    writeQuantity(this.clusters, choices.clusters);
    writeQuantity(this.wavelength, choices.wavelength);
    this.show();
  }

  writeRule(rule: Rule): void {
    this.rule.value = rule;
    this.show();
  }

  /** In the units of the mesh and those of the field. */
  setUnits({ meanEdge = this.meanEdge, width = this.width }: { meanEdge?: number; width?: number }): void {
    Object.assign(this, { meanEdge, width });
    this.show();
  }

  /** The choice what becomes of gaps is there where the field has some and the method can do either. */
  setGaps(count: number): void {
    this.hasGaps = count > 0;
    this.show();
  }

  writeEpsilon(value: number): void {
    const epsilon = clamp(value, EPSILON_RANGE);
    this.epsilonNumber.value = String(Number(epsilon.toPrecision(4)));
    this.epsilon.value = String(Math.log10(epsilon));
    this.epsilon.setAttribute('aria-valuetext', this.epsilonNumber.value);
  }

  /** Only what the method takes. */
  private show(): void {
    const { method, metric, exact } = this.read();
    const kinds: [string, string[]][] = [
      ['forMethod', kindsOf(method, byElements({ method, metric }))],
      ['forFilter', [this.filter.value]],
      ['forRule', [this.rule.value]],
      ['forExact', [exact.of]],
    ];
    for (const [key, values] of kinds) {
      const name = key.replace(/[A-Z]/, (letter) => `-${letter.toLowerCase()}`);
      for (const part of document.querySelectorAll<HTMLElement>(`[data-${name}]`))
        part.hidden = !part.dataset[key]!.split(' ').some((value) => values.includes(value));
    }
    this.gaps.hidden = !this.hasGaps || !canFill({ method });
    const made = { simplify: 'simplified', prescribe: 'exact' }[method as string] ?? 'smoothed';
    element('#save', HTMLButtonElement).textContent = `Save ${made} field (PLY)`;
    this.wavelengthUnits.textContent = `${short(readQuantity(this.wavelength) * this.meanEdge)} in units of the mesh. Waves of this length keep half of their amplitude.`;
    const { radius, sigmaDistance, sigmaValue } = readAll(this.bilateral);
    this.units.textContent =
      `Radius ${short(radius * this.meanEdge)} and σ ${short(sigmaDistance * this.meanEdge)} in units of the mesh, ` +
      `σ ${short(sigmaValue * this.width)} in those of the field.`;
  }

  private wire(): void {
    const { changed, moved } = this;
    // Sliders report while they move; the client drops what a newer position makes stale.
    this.epsilon.addEventListener('input', () => {
      this.writeEpsilon(Number((10 ** Number(this.epsilon.value)).toPrecision(3)));
      moved();
    });
    this.epsilonNumber.addEventListener('change', () => {
      const { valueAsNumber } = this.epsilonNumber;
      this.writeEpsilon(Number.isFinite(valueAsNumber) ? valueAsNumber : INITIAL_SMOOTHING.epsilon);
      changed();
    });
    for (const quantity of [
      this.clusters,
      this.wavelength,
      ...Object.values(this.lowPass),
      ...Object.values(this.bilateral),
    ]) {
      quantity.box.addEventListener('change', () => {
        writeQuantity(quantity, readQuantity(quantity));
        this.show();
        changed();
      });
    }
    const { method, metric, energy, weights, bounds, missing, filter, rule, stars, unconstrained } = this;
    for (const choice of [method, metric, energy, weights, bounds, missing, filter, rule, stars, unconstrained]) {
      choice.addEventListener('change', () => {
        this.show();
        changed();
      });
    }
  }
}

/** As what the method is named in the form's `data-for-method`. */
function kindsOf(method: Method, isByElements: boolean): string[] {
  const kinds: string[] = method === 'prescribe' ? ['prescribe'] : [];
  if (isByElements) return [...kinds, 'finiteElements', `${method}Elements`];
  return method === 'prescribe' ? [...kinds, 'prescribeEpsilon'] : [method];
}

function quantities<Name extends string>(
  boxes: Record<Name, HTMLInputElement>,
  ranges: Record<Name, readonly [number, number]>,
  fallbacks: Record<Name, number>,
): Record<Name, Quantity> {
  const names = Object.keys(boxes) as Name[];
  const made = names.map((name): [Name, Quantity] => [
    name,
    { box: boxes[name], range: ranges[name], fallback: fallbacks[name], isWhole: name === 'iterations' },
  ]);
  return Object.fromEntries(made) as Record<Name, Quantity>;
}

function readQuantity({ box, range, fallback, isWhole = false, factor = 1 }: Quantity): number {
  const value = Number.isFinite(box.valueAsNumber) ? box.valueAsNumber / factor : fallback;
  return clamp(isWhole ? Math.round(value) : value, range);
}

function writeQuantity({ box, range, factor = 1 }: Quantity, value: number): void {
  box.value = String(Number((factor * clamp(value, range)).toPrecision(6)));
}

function readAll<Name extends string>(all: Record<Name, Quantity>): Record<Name, number> {
  const names = Object.keys(all) as Name[];
  return Object.fromEntries(names.map((name) => [name, readQuantity(all[name])])) as Record<Name, number>;
}

function writeAll<Name extends string>(all: Record<Name, Quantity>, values: Record<Name, number>): void {
  for (const name of Object.keys(all) as Name[]) writeQuantity(all[name], values[name]);
}
