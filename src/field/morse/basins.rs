//! The regions whose steepest paths end at the same extremum.

use super::NONE;
use super::cancellations::Cancellations;
use crate::error::Result;
use crate::field::order::Threshold;
use crate::field::scalar_field::ScalarField;
use crate::field::steepest::{Steepest, ends};
use crate::mesh::LinkKind;
use crate::support::watch::Watch;

/// For every vertex the extrema that it belongs to; `u32::MAX` for vertices of no triangle.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Basins {
    /// The minimum at which the path downwards ends.
    pub descending: Vec<u32>,
    /// The maximum at which the path upwards ends.
    pub ascending: Vec<u32>,
}

/// The regions whose paths end at each extremum, once pairs of persistence up to a threshold are cancelled; none are at 0.
///
/// # Errors
/// `InvalidOption` where the threshold is negative or not finite; `Cancelled`.
pub fn basins(field: &ScalarField<'_>, persistence: Threshold, watch: &Watch<'_>) -> Result<Basins> {
    let (mesh, order) = (field.mesh(), field.order());
    let threshold = persistence.absolute(field.range(), "persistence")?;
    watch.tick(100 * mesh.vertex_count() as u64)?;
    let kinds = mesh.connectivity().link_kinds();
    let [descending, ascending] = if threshold > 0.0 {
        let all = Cancellations::new(mesh, order, threshold);
        let extrema = all.extrema(threshold);
        [0, 1].map(|side| all.ends[side].iter().map(|&end| extrema[side][end as usize]).collect())
    } else {
        let steepest = Steepest::by_slope(mesh, order);
        [ends(&steepest.down), ends(&steepest.up)]
    };
    let connected = |labels: Vec<u32>| {
        labels
            .into_iter()
            .zip(kinds)
            .map(|(label, &kind)| if kind == LinkKind::Isolated { NONE } else { label })
            .collect()
    };
    Ok(Basins { descending: connected(descending), ascending: connected(ascending) })
}
