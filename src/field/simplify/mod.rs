//! A field with fewer extrema, as near to the given one as can be: ε-simplification.

mod flats;
mod flooding;
mod tilt;

use flats::{Role, Surroundings, ordered};
use flooding::{Mergers, flood};
use tilt::tilted;

use crate::error::{Error, FieldError, Result};
use crate::field::critical::{CriticalKind, exact};
use crate::field::order::{Threshold, VertexOrder};
use crate::field::saddles::Saddles;
use crate::field::scalar_field::ScalarField;
use crate::field::steepest::Steepest;
use crate::field::sweep::Sweep;
use crate::mesh::TriMesh;
use crate::support::watch::Watch;

/// The extrema that [`simplify`] leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Keep<'a> {
    /// Those of persistence above the threshold, and the lowest and highest vertex of every component.
    Above(Threshold),
    /// These minima and maxima, at least one of each in every component.
    Extrema(&'a [u32]),
}

/// A field with fewer extrema.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Simplified {
    /// One value for each vertex.
    pub values: Vec<f64>,
    /// Extrema that were to go, but that no field on this mesh can do without. Ascending.
    pub unavoidable: Vec<u32>,
}

/// Computes a field that has no other extrema than the wanted ones.
///
/// # Definition
/// First every value rises to the least height from which a path that never climbs above it leads to a wanted minimum; then
/// every value sinks to the greatest height from which a path that never drops below it leads to a wanted maximum. What
/// became flat is tilted by the smallest steps that doubles have, so that the extrema by (value, id) are exactly the wanted
/// ones; this is checked before the field is returned. With a threshold this is ε-simplification \[Edelsbrunner06\].
///
/// # Properties
/// With a threshold, no value changes by more than it, but for the tilt where a pair is as persistent as the threshold or so
/// nearly that the difference is of its size: at most as many steps of double precision as the flat region has vertices. On
/// closed surfaces saddles then number minima + maxima − χ. Where a
/// vertex was not involved, its value is unchanged. O(n) but for sorting.
///
/// # Units
/// Those of the values.
///
/// # Errors
/// `InvalidOption` for a threshold that is negative or not finite;
/// `RangeOverflow` where the tilt leaves the range of doubles; `IndexOutOfBounds`, `NotAnExtremum` for what is to be kept, `Unconstrained` where a component keeps no minimum or no
/// maximum; `UnavoidableExtremum` where the mesh hangs together in a single vertex and has no such field.
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
    let (mesh, values, order) = (field.mesh(), field.values(), field.order());
    watch.tick(200 * values.len() as u64)?;
    let (roles, bound, filled) = match keep {
        Keep::Above(threshold) => {
            let bound = threshold.absolute(field.range(), "threshold")?;
            let (roles, filled) = persistent(mesh, order, bound)?;
            (roles, bound, filled)
        }
        Keep::Extrema(vertices) => {
            let roles = named(mesh, order, vertices)?;
            let filled = flood(mesh, order, false, having(&roles, Role::Minimum))?;
            (roles, f64::INFINITY, filled)
        }
    };
    let between = VertexOrder::of_checked(&filled);
    let levels = flood(mesh, between, true, having(&roles, Role::Maximum))?;
    drop(filled);
    let around = Surroundings::new(mesh.connectivity(), &levels, &roles);
    let sequence = ordered(mesh.connectivity(), &around, &roles);
    let simple = tilted(mesh.connectivity(), &around, &levels, sequence, values, bound);
    if !simple.iter().all(|value| value.is_finite()) {
        return Err(FieldError::RangeOverflow {}.into());
    }
    check(mesh, &simple, &roles)?;
    Ok(Simplified { values: simple, unavoidable: Vec::new() })
}

fn having(roles: &[Role], wanted: Role) -> Vec<bool> {
    roles.iter().map(|&role| role == wanted).collect()
}

/// Roles by persistence, and the field with its basins filled, for which the same saddles serve.
fn persistent(mesh: &TriMesh, order: VertexOrder<'_>, bound: f64) -> Result<(Vec<Role>, Vec<f64>), FieldError> {
    let values = order.values();
    let saddles = Saddles::new(mesh, order);
    let ascending = saddles.ascending(values);
    let steepest = Steepest::by_value(mesh.connectivity(), order);
    let hills = Mergers::new(mesh, Sweep::downwards(order), &steepest.up, &saddles, &ascending);
    let basins = Mergers::new(mesh, Sweep::upwards(order), &steepest.down, &saddles, &ascending);
    let mut roles = vec![Role::Ordinary; values.len()];
    for (mergers, role) in [(&hills, Role::Maximum), (&basins, Role::Minimum)] {
        for merger in mergers.list() {
            let (extremum, persistence) = merger.pair(values);
            if persistence > bound {
                roles[extremum as usize] = role;
            }
        }
        for extremum in mergers.survivors() {
            roles[extremum as usize] = role;
        }
    }
    let filled = basins.flood(having(&roles, Role::Minimum))?;
    Ok((roles, filled))
}

/// Roles of extrema that the caller names.
fn named(mesh: &TriMesh, order: VertexOrder<'_>, vertices: &[u32]) -> Result<Vec<Role>, Error> {
    let values = order.values();
    let mut extrema = vec![Role::Ordinary; values.len()];
    for point in exact(mesh.connectivity(), order).points {
        extrema[point.vertex as usize] = role_of(point.kind);
    }
    let mut roles = vec![Role::Ordinary; values.len()];
    for &vertex in vertices {
        match extrema.get(vertex as usize) {
            None => return Err(FieldError::IndexOutOfBounds { index: vertex, vertices: values.len() }.into()),
            Some(Role::Ordinary) => return Err(FieldError::NotAnExtremum { vertex }.into()),
            Some(&role) => roles[vertex as usize] = role,
        }
    }
    Ok(roles)
}

fn role_of(kind: CriticalKind) -> Role {
    match kind {
        CriticalKind::Minimum => Role::Minimum,
        CriticalKind::Maximum => Role::Maximum,
        CriticalKind::Saddle => Role::Ordinary,
    }
}

/// Never assumed: the extrema of the result are the wanted ones.
fn check(mesh: &TriMesh, simple: &[f64], roles: &[Role]) -> Result<(), Error> {
    let mut missing = roles.to_vec();
    for point in exact(mesh.connectivity(), VertexOrder::of_checked(simple)).points {
        let (vertex, role) = (point.vertex, role_of(point.kind));
        if role != Role::Ordinary && core::mem::replace(&mut missing[vertex as usize], Role::Ordinary) != role {
            return Err(FieldError::UnavoidableExtremum { vertex }.into());
        }
    }
    match missing.iter().position(|&role| role != Role::Ordinary) {
        Some(vertex) => Err(FieldError::UnavoidableExtremum { vertex: vertex as u32 }.into()),
        None => Ok(()),
    }
}
