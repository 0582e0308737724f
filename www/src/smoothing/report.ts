/** The report as a panel: everything that is known of the last smoothing, in words and with units. */
import { duration, element, short, whole } from '../dom';
import type { AfterReport } from '../protocol';
import { exactGroup } from './exact-report';
import type { Method } from './settings';

/** A name, what it says, what it means, and the id by which it is found. */
export interface Line {
  name: string;
  value: string;
  meaning: string;
  id: string;
  /** Sentences go over the whole width. */
  isLong?: boolean;
}

export interface Group {
  title: string;
  lines: (Line | null)[];
}

const METHODS: Record<Method, string> = {
  prescribe: 'Exact extrema',
  tikhonov: 'Tikhonov',
  interpolate: 'Interpolation',
  leastSquares: 'Least squares',
  lowPass: 'Low-pass filter',
  bilateral: 'Bilateral filter',
  simplify: 'Simplification',
};

export class ReportPanel {
  private readonly root = element('#report', HTMLElement);

  constructor() {
    this.clear('There is no smoothed field.');
  }

  clear(text: string): void {
    const sentence = document.createElement('p');
    sentence.className = 'report-empty';
    sentence.textContent = text;
    this.root.replaceChildren(sentence);
  }

  show(report: AfterReport): void {
    const { exact } = report;
    const groups = [exact && exactGroup(exact), change(report), constraints(report), solver(report)];
    this.root.replaceChildren(counts(report), ...groups.flatMap((group) => (group ? [groupOf(group)] : [])));
  }
}

/** Before → after, as a table. */
function counts({ method, settings, smoothing, before, after }: AfterReport): HTMLElement {
  const section = sectionOf(methodOf(method, settings, smoothing?.equation));
  const table = document.createElement('table');
  const head = table.createTHead().insertRow();
  for (const title of ['', 'before', 'after']) {
    const cell = document.createElement('th');
    cell.scope = 'col';
    cell.textContent = title;
    head.append(cell);
  }
  const body = table.createTBody();
  for (const kind of ['minima', 'maxima', 'saddles'] as const) {
    const row = body.insertRow();
    const name = document.createElement('th');
    name.scope = 'row';
    name.textContent = kind;
    row.append(name);
    for (const [side, value] of [
      ['before', before[kind]],
      ['after', after[kind]],
    ] as const) {
      const cell = row.insertCell();
      cell.textContent = whole(value);
      cell.dataset['testid'] = `report-${kind}-${side}`;
    }
  }
  table.title = 'Critical points at δ = 0, saddles by their multiplicity';
  section.append(table);
  return section;
}

/** With the number of the paper's equation, where it is one. */
function methodOf(method: Method, { metric, energy, isDiffusion }: AfterReport['settings'], equation?: string): string {
  const kinds: Partial<Record<Method, string>> = {
    prescribe: metric === 'finiteElements' ? ', finite elements' : '',
    tikhonov: metric === 'finiteElements' ? ', finite elements' : '',
    interpolate: `, ${energy}`,
    lowPass: isDiffusion ? ', diffusion' : ', λ | μ',
  };
  return `${METHODS[method]}${kinds[method] ?? ''}${equation?.startsWith('(') ? `\u00a0${equation}` : ''}`;
}

function change(report: AfterReport): Group {
  const { lInfinity, sobolevBefore, sobolevAfter, smoothing, pairsRemoved, unavoidable } = report;
  const share = sobolevBefore > 0 ? ` (${percentage(sobolevAfter / sobolevBefore - 1)})` : '';
  const norm = smoothing && metricOf(report);
  return {
    title: 'Change',
    lines: [
      line(
        'Largest, L∞',
        `${short(100 * lInfinity)} % of range`,
        'max |x − f|, as a share of the range before',
        'report-linf',
      ),
      norm && line(norm.name, short(smoothing.metricNorm), norm.meaning, 'report-metric'),
      smoothing && line('‖Lx‖', short(smoothing.laplacianNorm), 'Of the result, scaled by the range before', 'report-laplacian'), // prettier-ignore
      line(
        'Sobolev',
        `${short(sobolevBefore)} → ${short(sobolevAfter)}${share}`,
        'Semi-norm fᵀLf, how rough the field is: before and after, both scaled by the range before',
        'report-sobolev',
      ),
      pairsRemoved === null
        ? null
        : line('Pairs removed', whole(pairsRemoved), 'Pairs of critical points that are gone', 'read-pairs'),
      unavoidable
        ? line(
            'Extrema left',
            whole(unavoidable),
            'Extrema that were to go, but without which there is no field on this mesh: parts of it hang together in single vertices',
            'read-unavoidable',
          )
        : null,
      smoothing && smoothing.perturbationFactor !== null
        ? line(
            'Error bound',
            `≤ ${short(smoothing.perturbationFactor)} ‖e‖₂`,
            'If the values change by e, the result changes by at most this times ‖e‖₂',
            'report-bound',
          )
        : null,
    ],
  };
}

/** Which norm it is depends on the method; the range before is its unit. */
function metricOf({ method, settings }: AfterReport): { name: string; meaning: string } | null {
  const unit = 'the field scaled by its range before';
  switch (method) {
    case 'prescribe':
    case 'tikhonov': {
      const by = { mass: 'by mass', lumped: 'by lumped mass', identity: 'Euclidean', finiteElements: 'by area' }[
        settings.metric
      ];
      return { name: `‖x − f‖ ${by}`, meaning: `Distance in the metric that was used, of ${unit}` };
    }
    case 'leastSquares':
      return { name: '‖x − f‖ constrained', meaning: `Distance over the constrained vertices, of ${unit}` };
    default:
      return { name: '‖x − f‖', meaning: `Distance over all vertices, of ${unit}` };
  }
}

function constraints({ smoothing, features }: AfterReport): Group | null {
  if (!smoothing || features === null) return null;
  const { constraintCount, constrainedCriticalPoints, preserved, freeExtrema, maximumPrinciple } = smoothing;
  return {
    title: 'Constraints',
    lines: [
      line('Constrained', whole(constraintCount), 'Vertices, stars included', 'report-constrained'),
      line('Feature points', whole(features), 'Constrained vertices without their stars', 'report-features'),
      constrainedCriticalPoints === null || preserved === null
        ? null
        : line(
            'Kept',
            `${whole(preserved)} of ${whole(constrainedCriticalPoints)} critical points`,
            'Constrained critical points whose type and multiplicity are what they were',
            'report-kept',
          ),
      freeExtrema === null
        ? null
        : line('Extrema elsewhere', whole(freeExtrema), 'Minima and maxima of the result that are not constrained', 'report-free'), // prettier-ignore
      maximumPrinciple && {
        ...line('Maximum principle', principle(maximumPrinciple), 'Harmonic values are means of their neighbours’ where no weight is negative: no free vertex can be an extremum', 'report-principle'), // prettier-ignore
        isLong: true,
      },
    ],
  };
}

function principle({
  smallestWeight,
  extrema,
  meshExtrema,
}: NonNullable<NonNullable<AfterReport['smoothing']>['maximumPrinciple']>): string {
  // prettier-ignore
  const free = (count: number): string =>
    count === 0 ? 'no free extremum' : count === 1 ? '1 free extremum' : `${whole(count)} free extrema`;
  const onMesh = meshExtrema === extrema ? '' : `; ${free(meshExtrema)} along the mesh’s own edges`;
  return smallestWeight >= 0
    ? `holds: no weight is negative, ${free(extrema)}${onMesh}`
    : `void: smallest weight ${short(smallestWeight)}; ${free(extrema)} among neighbours${onMesh}`;
}

function solver({ smoothing, milliseconds, exact }: AfterReport): Group {
  const time = line('Time', duration(milliseconds), 'In the background worker, report included', 'report-time');
  if (!smoothing) return { title: 'Work', lines: [time] };
  const { route, precision, unknowns, factorNonzeros, relativeResidual, refinementSteps, iterations } =
    smoothing.solver;
  const isSolved = unknowns > 0;
  return {
    title: isSolved ? 'Solver' : 'Work',
    lines: [
      isSolved ? line('Route', route + (precision === 'double' ? '' : `, ${precision}`), 'How the linear system was solved', 'read-solver') : null, // prettier-ignore
      isSolved ? line('Unknowns', whole(unknowns), 'Size of the system', 'report-unknowns') : null,
      factorNonzeros > 0
        ? line('Factor', `${whole(factorNonzeros)} entries`, 'Nonzero entries of the sparse factor', 'report-factor')
        : null,
      isSolved ? line('Residual', short(relativeResidual), '‖b − Ax‖ / ‖b‖', 'read-residual') : null,
      isSolved
        ? line('Refinement', `${refinementSteps} ${refinementSteps === 1 ? 'step' : 'steps'}`, 'Corrections of the first solution', 'report-refinement') // prettier-ignore
        : null,
      // With exact extrema they stand beside the choice.
      iterations > 0 && !exact
        ? line('Iterations', whole(iterations), 'Of conjugate gradients, or of the filter', 'report-iterations')
        : null,
      time,
    ],
  };
}

const line = (name: string, value: string, meaning: string, id: string): Line => ({ name, value, meaning, id });

function percentage(share: number): string {
  const value = 100 * share;
  // Nearly all and all are not the same.
  const text = value < -99 && value > -100 ? (Math.ceil(value * 100) / 100).toFixed(2) : value.toFixed(Math.abs(value) < 10 ? 1 : 0); // prettier-ignore
  return `${value > 0 ? '+' : ''}${text.replace('-', '−')} %`;
}

function sectionOf(title: string): HTMLElement {
  const section = document.createElement('section');
  const heading = document.createElement('h3');
  heading.textContent = title;
  section.append(heading);
  return section;
}

function groupOf({ title, lines }: Group): HTMLElement {
  const section = sectionOf(title);
  const list = document.createElement('dl');
  for (const item of lines) {
    if (!item) continue;
    const row = document.createElement('div');
    row.title = item.meaning;
    row.classList.toggle('long', item.isLong === true);
    const name = document.createElement('dt');
    name.textContent = item.name;
    const value = document.createElement('dd');
    value.textContent = item.value;
    value.dataset['testid'] = item.id;
    row.append(name, value);
    list.append(row);
  }
  section.append(list);
  return section;
}
