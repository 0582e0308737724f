/** What the report says of a field with exactly the chosen extrema. */
import { short, whole } from '../dom';
import type { ExactReport } from '../protocol';
import type { Group } from './report';

/** More vertices than this are counted instead of named. */
const NAMED = 12;

/** Of the energy, over that of smoothing without the choice. */
export function surplus({ energy, unconstrainedEnergy }: ExactReport): string {
  if (unconstrainedEnergy === 0) return '–';
  const percent = 100 * (energy / unconstrainedEnergy - 1);
  return percent < 0.01 ? 'below +0.01 %' : `+${short(percent)} %`;
}

export function exactGroup(exact: ExactReport): Group {
  const { minima, maxima, unavoidable, leastSlack, margin, gap, iterations, route } = exact;
  const left = new Set(unavoidable);
  const chosen = (all: Uint32Array): number => all.filter((vertex) => !left.has(vertex)).length;
  return {
    title: 'The choice',
    lines: [
      {
        name: 'Chosen',
        value: `exactly the chosen ${count(chosen(minima), 'minimum', 'minima')} and ${count(chosen(maxima), 'maximum', 'maxima')}`,
        meaning: 'Checked by classifying the result; a closed surface has as many saddles as its topology then demands',
        id: 'report-chosen',
        isLong: true,
      },
      {
        name: 'Energy',
        value: `${surplus(exact)} over smoothing without the choice`,
        meaning: '‖Lx‖² + ε‖x − f‖² beside its least value among all fields: no other field can have less than that',
        id: 'report-energy',
        isLong: true,
      },
      {
        name: 'Certificate',
        value:
          `every step rises by at least ${short(leastSlack)} times the margin of ${short(margin)} of the range; ` +
          `${leastSlack >= 0.9 ? '0.9 or more proves' : 'less than 0.9 does not prove'} that there are no other extrema`,
        meaning:
          'From every vertex that is no chosen extremum there is a step down and a step up to a neighbour, each with at least this rise',
        id: 'report-certificate',
        isLong: true,
      },
      unavoidable.length > 0
        ? {
            name: 'Unavoidable',
            value:
              unavoidable.length > NAMED
                ? `${whole(unavoidable.length)} more extrema`
                : `also vertices ${[...unavoidable].join(', ')}`,
            meaning:
              'Nobody chose these, but no field on this mesh can do without them: parts of it hang together in single vertices',
            id: 'report-unavoidable',
            isLong: true,
          }
        : null,
      {
        name: 'Iterations',
        value: `${whole(iterations)}, ${route === 'dual' ? 'dual method' : 'interior point'}`,
        meaning: 'Each has one factorisation of its own; the dual method makes do with that of smoothing',
        id: 'report-exact-iterations',
      },
      {
        name: 'Gap',
        value: gap === 0 ? 'none' : `≤ ${short(100 * gap)} %`,
        meaning: 'No field that rises along the same steps has less energy by more than this share of it',
        id: 'report-gap',
      },
    ],
  };
}

const count = (number: number, one: string, many: string): string => `${whole(number)} ${number === 1 ? one : many}`;
