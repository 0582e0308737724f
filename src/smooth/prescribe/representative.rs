//! A field that has exactly the chosen extrema, near a smooth one. What is needed of it is the order of its vertices.

use super::extrema::Chosen;
use crate::error::Result;
use crate::field::{Keep, ScalarField, VertexOrder, simplify};
use crate::mesh::Connectivity;
use crate::support::memory;
use crate::support::watch::Watch;

/// How far a chosen extremum is put beyond its neighbours, relative to the range of the input: so little that the order of the others
/// is that of the smooth field.
const BEYOND: f64 = 1e-9;

/// A field with exactly these extrema.
#[derive(Debug, Clone)]
pub(super) struct Representative {
    pub(super) values: Vec<f64>,
    /// The chosen extrema, and those that are unavoidable.
    pub(super) extrema: Chosen,
    /// Ascending.
    pub(super) unavoidable: Vec<u32>,
}

/// Puts the chosen extrema beyond their neighbours, where they are not, and floods the field until no others are left.
///
/// # Errors
/// Those of [`simplify`].
pub(super) fn representative(
    smooth: &ScalarField<'_>,
    chosen: &Chosen,
    range: f64,
    watch: &Watch<'_>,
) -> Result<Representative> {
    memory::ensure(16 * smooth.values().len() as u64)?;
    let connectivity = smooth.mesh().connectivity();
    let mut values = smooth.values().to_vec();
    for &minimum in &chosen.minima {
        let lowest = around(connectivity, minimum).map(|w| values[w as usize]).fold(f64::INFINITY, f64::min);
        if values[minimum as usize] >= lowest {
            values[minimum as usize] = (lowest - BEYOND * range).min(lowest.next_down());
        }
    }
    for &maximum in &chosen.maxima {
        let highest = around(connectivity, maximum).map(|w| values[w as usize]).fold(f64::NEG_INFINITY, f64::max);
        if values[maximum as usize] <= highest {
            values[maximum as usize] = (highest + BEYOND * range).max(highest.next_up());
        }
    }
    let forced = ScalarField::new(smooth.mesh(), &values)?;
    let simple = simplify(&forced, Keep::Extrema(&chosen.all()), watch)?;
    let mut extrema = chosen.clone();
    let order = VertexOrder::of_checked(&simple.values);
    for &vertex in &simple.unavoidable {
        let is_minimum = around(connectivity, vertex).all(|w| order.is_below(vertex, w));
        if is_minimum { &mut extrema.minima } else { &mut extrema.maxima }.push(vertex);
    }
    extrema.minima.sort_unstable();
    extrema.maxima.sort_unstable();
    Ok(Representative { values: simple.values, extrema, unavoidable: simple.unavoidable })
}

/// The neighbours of a vertex, some of them several times.
pub(super) fn around(connectivity: &Connectivity, vertex: u32) -> impl Iterator<Item = u32> {
    connectivity.link(vertex).flatten()
}
