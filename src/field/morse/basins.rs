//! The regions whose steepest paths end at the same extremum.

use super::NONE;
use super::cancellations::Cancellations;
use crate::error::{OutOfMemory, Result};
use crate::field::order::Threshold;
use crate::field::scalar_field::{OnMesh, Part, ScalarField};
use crate::field::steepest::{Steepest, ends};
use crate::mesh::LinkKind;
use crate::support::watch::{Phase, Watch};

/// For every vertex the extrema that it belongs to; `u32::MAX` for a vertex of no triangle, and for one without a value or with
/// values missing all around it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Basins {
    /// The minimum at which the path downwards ends.
    pub descending: Vec<u32>,
    /// The maximum at which the path upwards ends.
    pub ascending: Vec<u32>,
}

impl OnMesh for Basins {
    fn tell_of_whole(&mut self, part: &Part) -> Result<(), OutOfMemory> {
        for labels in [&mut self.descending, &mut self.ascending] {
            labels.iter_mut().filter(|label| **label != NONE).for_each(|label| part.vertex(label));
            part.spread(labels, NONE)?;
        }
        Ok(())
    }
}

/// The regions whose paths end at each extremum, once pairs of persistence up to a threshold are cancelled; none are at 0.
///
/// # Errors
/// `InvalidOption` where the threshold is negative or not finite; `Cancelled`, `OutOfMemory`.
pub fn basins(field: &ScalarField<'_>, persistence: Threshold, watch: &Watch<'_>) -> Result<Basins> {
    let (mesh, order, n) = (field.mesh(), field.order(), field.values().len() as u64);
    let threshold = persistence.absolute(field.range(), "persistence")?;
    let mut plan = watch.plan(&[(Phase::Field, 5.0), (Phase::Field, 2.0)]);
    let [mut descending, mut ascending] = if threshold > 0.0 {
        plan.begin(0)?;
        let all = Cancellations::new(mesh, order, threshold, watch)?;
        plan.begin(8 * n)?;
        let extrema = all.extrema(threshold, watch)?;
        let Cancellations { ends, .. } = all;
        let mut labels = ends;
        for (labels, extrema) in labels.iter_mut().zip(&extrema) {
            watch.tick(2 * n)?;
            labels.iter_mut().for_each(|end| *end = extrema[*end as usize]);
        }
        labels
    } else {
        plan.begin(20 * mesh.edge_count() as u64)?;
        let steepest = Steepest::by_slope(mesh, order, watch)?;
        plan.begin(24 * n)?;
        [ends(&steepest.down, watch)?, ends(&steepest.up, watch)?]
    };
    for labels in [&mut descending, &mut ascending] {
        watch.tick(2 * n)?;
        for (label, &kind) in labels.iter_mut().zip(mesh.connectivity().link_kinds()) {
            *label = if kind == LinkKind::Isolated { NONE } else { *label };
        }
    }
    plan.finish()?;
    Ok(field.on_whole(Basins { descending, ascending })?)
}
