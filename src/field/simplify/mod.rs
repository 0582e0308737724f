//! A field with fewer extrema, as near to the given one as can be: ε-simplification.

mod flats;
mod flooding;
mod hanging;
mod tilt;

use flats::{Surroundings, Target, ordered};
use flooding::{Mergers, flood, having};
use hanging::unavoidable;
use tilt::tilted;

use crate::error::{FieldError, OutOfMemory, Result};
use crate::field::arrays::{copied, filled, numbers};
use crate::field::critical::{CriticalKind, exact};
use crate::field::order::{Threshold, VertexOrder};
use crate::field::saddles::Saddles;
use crate::field::scalar_field::{OnMesh, Part, ScalarField};
use crate::field::steepest::Steepest;
use crate::field::sweep::Sweep;
use crate::mesh::{Connectivity, LinkKind, TriMesh};
use crate::support::union_find::UnionFind;
use crate::support::watch::{Phase, Watch};

/// The extrema that [`simplify`] leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Keep<'a> {
    /// Those of persistence above the threshold, and the lowest and highest vertex of every component.
    Above(Threshold),
    /// These minima and maxima, at least one of each in every component.
    Extrema(&'a [u32]),
}

impl Default for Keep<'_> {
    fn default() -> Self {
        Self::Above(Threshold::default())
    }
}

/// A field with fewer extrema.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Simplified {
    /// One value for each vertex; NaN where values are missing, or missing all around.
    pub values: Vec<f64>,
    /// Extrema that were to go, but that no field on this mesh can do without, one in each part that hangs on by a single vertex.
    /// Ascending.
    pub unavoidable: Vec<u32>,
}

impl OnMesh for Simplified {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        part.vertices(&mut self.unavoidable);
        part.spread(&mut self.values, f64::NAN)
    }
}

/// Computes a field that has no other extrema than the wanted ones, and those that cannot be avoided.
///
/// # Definition
/// First every value rises to the least height from which a path that never climbs above it leads to a wanted minimum; then
/// every value sinks to the greatest height from which a path that never drops below it leads to a wanted maximum. What
/// became flat is tilted by the smallest steps that doubles have, so that the extrema by (value, id) are exactly the wanted
/// ones; this is checked before the field is returned. With a threshold this is ε-simplification \[Edelsbrunner06\].
///
/// Where a part of the mesh hangs on by a single vertex, or by nothing but wanted minima (maxima), and has no wanted extremum, its
/// lowest or highest vertex is an extremum of any field. One extremum of each such part is kept as if it were wanted, and listed
/// ([`Simplified::unavoidable`]); there is no field with fewer.
///
/// # Properties
/// With a threshold, no value changes by more than it, but for the tilt where a pair is as persistent as the threshold or so
/// nearly that the difference is of its size: at most as many steps of double precision as the flat region has vertices. Around
/// extrema whose neighbours do not hang together, values may change by more. On closed surfaces saddles then number
/// minima + maxima − χ, and nothing is unavoidable. Where a vertex was not involved, its value is unchanged. O(n) but for sorting.
///
/// # Units
/// Those of the values.
///
/// # Errors
/// `InvalidOption` for a threshold that is negative or not finite; `RangeOverflow` where the tilt leaves the range of doubles;
/// `IndexOutOfBounds`, `MissingValue`, `NotAnExtremum` for what is to be kept, `Unconstrained` where a component keeps no minimum or
/// no maximum; `Cancelled`, `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let torus = shapes::torus(40, 20, 0.0)?;
/// let bumps = |v: usize| 0.1 * (v % 7) as f64;
/// let bumpy: Vec<f64> = torus.positions().chunks_exact(3).enumerate().map(|(v, p)| p[0] + 0.1 * p[2] + bumps(v)).collect();
/// let keep = field::Keep::Above(field::Threshold::Absolute(0.6));
/// let simple = field::simplify(&field::ScalarField::new(&torus, &bumpy)?, keep, &Watch::none())?;
/// let simple = field::ScalarField::new(&torus, &simple.values)?;
/// let counts = field::critical_points(&simple, &field::DeltaOptions::default(), &Watch::none())?.counts;
/// assert_eq!((counts.minima, counts.maxima, counts.saddles), (1, 1, 2));
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn simplify(field: &ScalarField<'_>, keep: Keep<'_>, watch: &Watch<'_>) -> Result<Simplified> {
    let simplified = match keep {
        Keep::Above(threshold) => {
            let bound = threshold.absolute(field.range(), "threshold")?;
            let mut plan = watch.plan(&[(Phase::Field, 3.0), (Phase::Field, 5.0)]);
            plan.begin(60 * field.values().len() as u64)?;
            let wanted = Wanted::persistent(field.mesh(), field.order(), bound, watch)?;
            plan.begin(0)?;
            let simplified = simplified(field, wanted, bound, watch)?;
            plan.finish()?;
            simplified
        }
        Keep::Extrema(vertices) => {
            let kept = field.to_part(vertices)?;
            let mut plan = watch.plan(&[(Phase::Field, 2.0), (Phase::Field, 6.0)]);
            plan.begin(0)?;
            let wanted = Wanted::named(field.mesh(), field.order(), &kept, watch);
            let wanted = wanted.map_err(|error| of_whole(field, error))?;
            plan.begin(0)?;
            let simplified = simplified(field, wanted, f64::INFINITY, watch);
            let simplified = simplified.map_err(|error| of_whole(field, error))?;
            plan.finish()?;
            simplified
        }
    };
    Ok(field.on_whole(simplified)?)
}

/// An error in the ids of the mesh that the field was given on.
fn of_whole(field: &ScalarField<'_>, mut error: FieldError) -> FieldError {
    if let FieldError::NotAnExtremum { vertex } | FieldError::Unconstrained { vertex, .. } = &mut error {
        field.to_whole(core::slice::from_mut(vertex));
    }
    error
}

/// The extrema that are to stay.
struct Wanted {
    targets: Vec<Target>,
    /// The field with its basins filled, where that is known already.
    filled: Option<Vec<f64>>,
}

/// The shares of: filling basins, cutting hills, ordering flat regions, tilting them, checking.
const STEPS: [(Phase, f64); 5] =
    [(Phase::Field, 2.0), (Phase::Field, 3.0), (Phase::Field, 2.0), (Phase::Field, 2.0), (Phase::Field, 1.5)];

fn simplified(
    field: &ScalarField<'_>,
    wanted: Wanted,
    bound: f64,
    watch: &Watch<'_>,
) -> Result<Simplified, FieldError> {
    let (mesh, values, n) = (field.mesh(), field.values(), field.values().len() as u64);
    let connectivity = mesh.connectivity();
    let Wanted { mut targets, filled } = wanted;
    let mut plan = watch.plan(&STEPS);
    plan.begin(60 * n)?;
    let unavoidable = unavoidable(connectivity, field.order(), &mut targets, watch)?;
    let filled = match filled {
        Some(filled) if unavoidable.is_empty() && !is_pinched(connectivity, &targets) => filled,
        _ => {
            let needles = needles(field, &targets, &unavoidable)?;
            let start = needles.as_deref().map_or(field.order(), VertexOrder::of_checked);
            flood(mesh, start, false, &targets, watch)?
        }
    };
    plan.begin(80 * n)?;
    let heights = flood(mesh, VertexOrder::of_checked(&filled), true, &targets, watch)?;
    drop(filled);
    plan.begin(100 * n)?;
    let around = Surroundings::new(connectivity, &heights, &targets, watch)?;
    let sequence = ordered(connectivity, &around, &targets, watch)?;
    plan.begin(60 * n)?;
    let simple = tilted(connectivity, &around, &heights, sequence, values, bound, watch)?;
    drop((around, heights));
    if !simple.iter().all(|value| value.is_finite()) {
        return Err(FieldError::RangeOverflow {});
    }
    plan.begin(0)?;
    check(mesh, &simple, targets, watch)?;
    plan.finish()?;
    Ok(Simplified { values: simple, unavoidable })
}

/// Whether wanted extrema have neighbours that do not hang together.
fn is_pinched(connectivity: &Connectivity, targets: &[Target]) -> bool {
    let kinds = connectivity.link_kinds();
    let mut special = connectivity.special_vertices().iter().map(|&v| v as usize);
    special.any(|v| targets[v] != Target::Ordinary && kinds[v] == LinkKind::NonManifold)
}

/// The values with those of the `unavoidable` vertices that are no extrema put just beyond their neighbours; nothing where there are
/// no such vertices.
fn needles(field: &ScalarField<'_>, targets: &[Target], unavoidable: &[u32]) -> Result<Option<Vec<f64>>, FieldError> {
    let order = field.order();
    let mut needles = None;
    for &v in unavoidable {
        let is_minimum = targets[v as usize] == Target::Minimum;
        let neighbours = || field.mesh().connectivity().link(v).flatten();
        if neighbours().any(|w| order.is_below(w, v) == is_minimum) {
            let ends = neighbours().map(|w| order.values()[w as usize]);
            let beyond = if is_minimum {
                ends.fold(f64::INFINITY, f64::min).next_down()
            } else {
                ends.fold(f64::NEG_INFINITY, f64::max).next_up()
            };
            let values = match &mut needles {
                Some(values) => values,
                none => none.insert(copied(order.values())?),
            };
            values[v as usize] = beyond;
        }
    }
    Ok(needles)
}

impl Wanted {
    /// The extrema of persistence above a bound. The same saddles serve to fill the basins of the others.
    fn persistent(mesh: &TriMesh, order: VertexOrder<'_>, bound: f64, watch: &Watch<'_>) -> Result<Self, FieldError> {
        let values = order.values();
        let saddles = Saddles::new(mesh, order, watch)?;
        let ascending = saddles.ascending(values, watch)?;
        let steepest = Steepest::by_value(mesh.connectivity(), order, watch)?;
        let mergers = |sweep, paths| Mergers::new(mesh, sweep, paths, &saddles, &ascending, &|_| false, watch);
        let hills = mergers(Sweep::downwards(order), &steepest.up)?;
        let basins = mergers(Sweep::upwards(order), &steepest.down)?;
        let mut targets = filled(Target::Ordinary, values.len())?;
        for (mergers, target) in [(&hills, Target::Maximum), (&basins, Target::Minimum)] {
            watch.tick(20 * mergers.list().len() as u64 + values.len() as u64)?;
            for merger in mergers.list() {
                let (extremum, persistence) = merger.pair(values);
                if persistence > bound {
                    targets[extremum as usize] = target;
                }
            }
            for extremum in mergers.survivors() {
                targets[extremum as usize] = target;
            }
        }
        drop((steepest, hills));
        let filled = basins.flood(having(&targets, Target::Minimum)?, watch)?;
        Ok(Self { targets, filled: Some(filled) })
    }

    /// The extrema that the caller names.
    fn named(mesh: &TriMesh, order: VertexOrder<'_>, vertices: &[u32], watch: &Watch<'_>) -> Result<Self, FieldError> {
        let mut extrema = filled(Target::Ordinary, order.values().len())?;
        for point in exact(mesh.connectivity(), order, watch)?.points {
            extrema[point.vertex as usize] = target_of(point.kind);
        }
        let mut targets = filled(Target::Ordinary, order.values().len())?;
        for &vertex in vertices {
            match extrema[vertex as usize] {
                Target::Ordinary => return Err(FieldError::NotAnExtremum { vertex }),
                target => targets[vertex as usize] = target,
            }
        }
        if mesh.connectivity().link_kinds().contains(&LinkKind::NonManifold) {
            check_components(mesh.connectivity(), &targets, watch)?;
        }
        Ok(Self { targets, filled: None })
    }
}

/// Finds a component without a wanted minimum or maximum. On surfaces, flooding finds it.
///
/// # Errors
/// `Unconstrained`.
fn check_components(connectivity: &Connectivity, targets: &[Target], watch: &Watch<'_>) -> Result<(), FieldError> {
    let count = targets.len() as u32;
    let mut components = UnionFind::new(numbers(targets.len())?);
    watch.tick(20 * connectivity.edges().len() as u64)?;
    for &[a, b] in connectivity.edges() {
        components.unite(a, b);
    }
    for wanted in [Target::Minimum, Target::Maximum] {
        watch.tick(20 * u64::from(count))?;
        let mut has = filled(false, targets.len())?;
        for v in (0..count).filter(|&v| targets[v as usize] == wanted) {
            has[components.find(v) as usize] = true;
        }
        let mut seen = filled(false, targets.len())?;
        let mut component = 0;
        for vertex in (0..count).filter(|&v| connectivity.link_kinds()[v as usize] != LinkKind::Isolated) {
            let name = components.find(vertex) as usize;
            if !has[name] {
                return Err(FieldError::Unconstrained { component, vertex });
            }
            component += usize::from(!core::mem::replace(&mut seen[name], true));
        }
    }
    Ok(())
}

fn target_of(kind: CriticalKind) -> Target {
    match kind {
        CriticalKind::Minimum => Target::Minimum,
        CriticalKind::Maximum => Target::Maximum,
        CriticalKind::Saddle => Target::Ordinary,
    }
}

/// Never assumed: the extrema of the result are the wanted ones.
fn check(mesh: &TriMesh, simple: &[f64], targets: Vec<Target>, watch: &Watch<'_>) -> Result<(), FieldError> {
    let mut missing = targets;
    for point in exact(mesh.connectivity(), VertexOrder::of_checked(simple), watch)?.points {
        let (vertex, target) = (point.vertex, target_of(point.kind));
        if target == Target::Ordinary {
            continue;
        }
        if core::mem::replace(&mut missing[vertex as usize], Target::Ordinary) != target {
            return Err(FieldError::UnavoidableExtremum { vertex });
        }
    }
    match missing.iter().position(|&target| target != Target::Ordinary) {
        Some(vertex) => Err(FieldError::UnavoidableExtremum { vertex: vertex as u32 }),
        None => Ok(()),
    }
}
