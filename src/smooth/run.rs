//! The one loop over channels that all methods share: solve, restore, measure.

use std::sync::Arc;

use super::channels::Channel;
use super::constraints::level_constant_components;
use super::input::Input;
use super::operators::Operators;
use super::report::{About, Facts, Measures, Smoothed, SolverReport, measure};
use super::schedule::Stages;
use crate::error::{FieldError, Result};
use crate::support::memory;
use crate::support::watch::Phase;

/// The work with a vertex whose values are restored and measured, in about a nanosecond each.
const MEASURED: u64 = 60;

/// What finds the smooth values: a linear system, or the steps of a filter.
///
/// A family of all ε is one, too, where it is asked for the values and the report of one ε; building it is not. An interior-point method
/// is one, whose `solve` factors several times.
pub(super) trait Procedure {
    /// Finds the values of channels that are solved for together. `is_first`: whether they are the first ones, for which alone
    /// bounds are computed.
    fn solve(&mut self, group: &[Channel], is_first: bool, stages: &mut Stages<'_, '_>) -> Result<Found>;

    /// What is measured of a result x with the input f, both normalised.
    fn measures(&mut self, x: &[f64], f: &[f64]) -> Measures;
}

/// The values of some channels.
pub(super) struct Found {
    pub(super) solutions: Vec<Solution>,
    /// See [`super::SmoothReport::perturbation_factor`].
    pub(super) perturbation_factor: Option<f64>,
}

/// The values of one channel.
pub(super) struct Solution {
    /// The vertices that were solved for. All others keep their values to the last bit.
    pub(super) vertices: Arc<[u32]>,
    /// Their normalised values.
    pub(super) x: Vec<f64>,
    /// All values in the units of the input, where they were found in these: then the two above are empty.
    pub(super) values: Option<Vec<f64>>,
    pub(super) solver: SolverReport,
}

impl Solution {
    /// Values in the units of the input.
    pub(super) fn of_values(values: Vec<f64>, solver: SolverReport) -> Self {
        Self { vertices: [].into(), x: Vec::new(), values: Some(values), solver }
    }
}

/// The values of a channel from those that some vertices have got: normalised, and in the units of the input.
pub(super) fn whole(
    operators: &Operators,
    about: &About,
    channel: &Channel,
    vertices: &[u32],
    solution: &[f64],
) -> Result<(Vec<f64>, Vec<f64>), FieldError> {
    let mut x = channel.normalized.clone();
    let mut moved = Vec::new();
    if let Some(components) = &about.unconstrained {
        components.write(&operators.active, &channel.values, &mut x);
        moved = components.moved(&operators.active);
    }
    for (&v, &value) in vertices.iter().zip(solution) {
        x[v as usize] = value;
    }
    let mut values = channel.restored(&x, vertices.iter().chain(&moved))?;
    if let Some(set) = &about.constraints {
        level_constant_components(&operators.active, set, channel, &mut x, &mut values);
    }
    Ok((x, values))
}

/// Smooths all channels, some at a time.
pub(super) fn run(
    input: &Input<'_>,
    about: &About,
    procedure: &mut dyn Procedure,
    mut stages: Stages<'_, '_>,
) -> Result<Smoothed> {
    let Input { operators, channels, .. } = input;
    let n = operators.mesh.vertex_count() as u64;
    // The results of all channels; values and normalised values of some, and one more in between.
    memory::ensure(8 * n * channels.count() as u64 + (16 * channels.most_together() as u64 + 16) * n)?;
    let mut interleaved = channels.to_interleaved();
    let mut reports = Vec::with_capacity(channels.count());
    let mut factor = None;
    for (first, group) in channels.groups(&operators.mesh) {
        let found = procedure.solve(&group, first == 0, &mut stages)?;
        if first == 0 {
            factor = found.perturbation_factor;
        }
        stages.begin(Phase::Report, 0)?;
        // The result twice, its difference, what the method measures, an image by L, and all that on the part with values.
        memory::ensure(80 * n)?;
        for (c, (channel, solution)) in (first..).zip(group.iter().zip(found.solutions)) {
            let (x, values) = match solution.values {
                Some(values) => (channel.normalize(&operators.mesh, &values), values),
                None => whole(operators, about, channel, &solution.vertices, &solution.x)?,
            };
            stages.watch.tick(MEASURED * n)?;
            let facts = Facts {
                measures: procedure.measures(&x, &channel.normalized),
                perturbation_factor: factor,
                solver: solution.solver,
            };
            reports.push(measure(input, about, channel, &x, &values, facts, stages.watch)?);
            channels.write(c, &values, &mut interleaved);
        }
        stages.next_group();
    }
    stages.finish()?;
    Ok(Smoothed { values: interleaved, reports })
}
