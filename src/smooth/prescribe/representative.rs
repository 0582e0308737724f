//! A field that has exactly the chosen extrema, near a smooth one. What is needed of it is the order of its vertices.

use super::extrema::Chosen;
use super::ranking::{around, ascending, ranking};
use crate::error::Result;
use crate::field::{Keep, ScalarField, VertexOrder, simplify};
use crate::mesh::TriMesh;
use crate::support::memory;
use crate::support::watch::Watch;

/// How far a chosen extremum is put beyond its neighbours, relative to the range of the input: so little that the order of the others
/// is that of the smooth field.
const BEYOND: f64 = 1e-9;

/// A field with exactly the chosen extrema, and those that are unavoidable.
#[derive(Debug, Clone)]
pub(super) struct Flooded {
    pub(super) values: Vec<f64>,
    /// The chosen extrema, and those that are unavoidable.
    pub(super) extrema: Chosen,
    /// Ascending.
    pub(super) unavoidable: Vec<u32>,
    /// The smooth field with the chosen extrema beyond their neighbours, not flooded yet.
    forced: Vec<f64>,
}

/// Puts the chosen extrema beyond their neighbours, where they are not, and floods the field until no others are left.
///
/// # Errors
/// Those of [`simplify`].
pub(super) fn flooded(smooth: &ScalarField<'_>, chosen: &Chosen, range: f64, watch: &Watch<'_>) -> Result<Flooded> {
    memory::ensure(16 * smooth.values().len() as u64)?;
    let connectivity = smooth.mesh().connectivity();
    let mut forced = smooth.values().to_vec();
    for &minimum in &chosen.minima {
        let lowest = around(connectivity, minimum).map(|w| forced[w as usize]).fold(f64::INFINITY, f64::min);
        if forced[minimum as usize] >= lowest {
            forced[minimum as usize] = (lowest - BEYOND * range).min(lowest.next_down());
        }
    }
    for &maximum in &chosen.maxima {
        let highest = around(connectivity, maximum).map(|w| forced[w as usize]).fold(f64::NEG_INFINITY, f64::max);
        if forced[maximum as usize] <= highest {
            forced[maximum as usize] = (highest + BEYOND * range).max(highest.next_up());
        }
    }
    let simple = simplify(&ScalarField::new(smooth.mesh(), &forced)?, Keep::Extrema(&chosen.all()), watch)?;
    let mut extrema = chosen.clone();
    let order = VertexOrder::of_checked(&simple.values);
    for &vertex in &simple.unavoidable {
        let is_minimum = around(connectivity, vertex).all(|w| order.is_below(vertex, w));
        if is_minimum { &mut extrema.minima } else { &mut extrema.maxima }.push(vertex);
    }
    extrema.minima.sort_unstable();
    extrema.maxima.sort_unstable();
    Ok(Flooded { values: simple.values, extrema, unavoidable: simple.unavoidable, forced })
}

/// What the order of the vertices is taken from.
#[derive(Debug, Clone)]
pub(super) struct Representative {
    /// Their order by (value, id) has exactly the extrema.
    pub(super) heights: Vec<f64>,
    pub(super) extrema: Chosen,
    /// Ascending.
    pub(super) unavoidable: Vec<u32>,
}

/// An order with exactly the chosen extrema that is as near to that of the smooth field as one is known.
///
/// # Errors
/// `Cancelled`, `OutOfMemory`.
pub(super) fn representative(mesh: &TriMesh, flooded: Flooded, watch: &Watch<'_>) -> Result<Representative> {
    let Flooded { values: mut heights, extrema, unavoidable, forced } = flooded;
    // The flooded field is flat where it was flooded, and its order there is any that serves: fields with that order have up to thrice as
    // much energy beyond the smooth one's as those with this ranking. It is for meshes where no ranking is found.
    if let Some(order) = ranking(mesh.connectivity(), ascending(mesh.connectivity(), &forced, watch)?, &extrema, watch)?
    {
        for (rank, v) in order.into_iter().enumerate() {
            heights[v as usize] = rank as f64;
        }
    }
    Ok(Representative { heights, extrema, unavoidable })
}
