/** The worker's side of constraints: which vertices a rule comes to, and what to say where they leave something unheld. */
import { MorseSmoothError } from 'morse-smooth';
import type { Constraints, PersistencePairs, TriMesh } from 'morse-smooth';
import { short } from '../dom';
import { thresholdOf } from '../findings';
import { omitting } from '../gaps';
import type { Found, Settings, Unsmoothed } from '../protocol';
import { hasOverrides, keptPairs } from '../reading/pairs';

/** Constraints by a rule, not as a mere list. */
type Rules = Exclude<Constraints, ArrayLike<number>>;

/** The rule in the package's terms, without stars. */
function featuresOf(settings: Settings, values: Float64Array, pairs: PersistencePairs): Rules {
  const { rule, delta, link, persistence, overrides, clusters, picked } = settings;
  const stars = false;
  switch (rule) {
    case 'critical':
      return { from: 'criticalPoints', stars };
    case 'delta':
      return { from: 'criticalPoints', delta, link, stars };
    case 'persistence': {
      if (!hasOverrides(overrides)) return { from: 'persistence', threshold: persistence, stars };
      const kept = keptPairs(pairs, thresholdOf(values, settings), overrides);
      const ends = kept.flatMap((k) => [pairs.extrema[k]!, pairs.saddles[k]!]);
      const unpaired = [...pairs.essentialMinima, ...pairs.essentialSaddles, ...pairs.essentialMaxima];
      return { from: 'vertices', vertices: [...ends, ...unpaired], stars };
    }
    case 'kMeans':
      return { from: 'kMeans', clusters, stars };
    case 'picked':
      // What was picked on another field may have no value on this one.
      return { from: 'vertices', vertices: [...picked].filter((vertex) => !Number.isNaN(values[vertex])), stars };
  }
}

export function findConstraints(
  mesh: TriMesh,
  settings: Settings,
  values: Float64Array,
  pairs: PersistencePairs,
): Found {
  const rule = featuresOf(settings, values, pairs);
  const holes = omitting(values);
  const find = (wanted: Rules): Uint32Array<ArrayBuffer> =>
    new Uint32Array(mesh.constrainedVertices(values, wanted, holes));
  const features = find(rule);
  const all = settings.stars ? find({ from: 'vertices', vertices: features, stars: true }) : features;
  return { features, values: Float64Array.from(features, (vertex) => values[vertex]!), all };
}

const WAYS =
  'Or choose, under “Components without constraints”, to keep the values that nothing holds or to take their mean.';

/** Nothing to hold the field with, which is no error: a slider comes by it. */
export function nothingHeld({ rule, delta }: Settings): Unsmoothed {
  const what = {
    critical: 'The field has no critical point, so nothing would hold it. Choose other constraints.',
    delta: `No critical point is left at δ = ${short(delta)}, so nothing would hold the field. Lower δ or choose other constraints.`,
    persistence: 'No critical point is kept, so nothing would hold the field. Lower the threshold.',
    kMeans: 'No vertex is constrained. Choose other constraints.',
    picked:
      'No vertex is picked yet. Click on the surface, tick critical points in the table, or click pairs in the persistence diagram.',
  }[rule];
  return { code: 'NothingConstrained', message: `${what} ${WAYS}` };
}

/** Null where the error is another one. */
export function partUnheld(error: unknown, components: number): Unsmoothed | null {
  if (!(error instanceof MorseSmoothError) || error.code !== 'Unconstrained') return null;
  const { component, vertex } = error.detail as { component?: number; vertex?: number };
  const which = component === undefined ? 'A component' : `Component ${component + 1} of ${components}`;
  const where = vertex === undefined ? '' : ` (vertex ${vertex} lies in it)`;
  return {
    code: error.code,
    message: `${which} of the mesh has no constrained vertex${where}, so nothing would hold the field there. Constrain one of its vertices. ${WAYS}`,
  };
}
