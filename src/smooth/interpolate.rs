//! Interpolation of constrained values, eq. (6) of \[Patane09\].

use super::channels::{Channel, Channels};
use super::constraints::{ConstraintSet, Constraints, LeftOut, level_constant_components};
use super::maximum_principle::Certifier;
use super::report::{Facts, Smoothed, SolverReport, measure};
use super::system::{ReducedSystem, Solved};
use super::{Energy, Phase, Progress, Smoother, bounds};
use crate::error::Result;

/// Options of [`Smoother::interpolate`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterpolateOptions<'a> {
    /// Which vertices keep their values, to the last bit.
    pub constraints: Constraints<'a>,
    /// What is made least. Default harmonic.
    pub energy: Energy,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`.
    pub channels: usize,
}

pub(super) fn run(
    smoother: &mut Smoother,
    values: &[f64],
    options: &InterpolateOptions<'_>,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    let channels = Channels::new(&smoother.mesh, values, options.channels)?;
    let set = ConstraintSet::new(&smoother.mesh, &channels, &options.constraints)?;
    let left_out = LeftOut::new(smoother.reach(), &set, options.constraints.unconstrained)?;
    let mut free = left_out.remaining(smoother.reach());
    free.retain(|v| set.vertices.binary_search(v).is_err());
    let mut system = smoother.take_reduced_system(options.energy, free)?;
    let outcome = solve(smoother, &mut system, &channels, (&set, &left_out), progress);
    // Kept after an error too: the analysis stays valid.
    smoother.reduced = Some(system);
    outcome
}

fn solve(
    smoother: &Smoother,
    system: &mut ReducedSystem,
    channels: &Channels<'_>,
    (set, left_out): (&ConstraintSet, &LeftOut),
    progress: Progress<'_>,
) -> Result<Smoothed> {
    let reach = smoother.reach();
    let mut changed = system.free().to_vec();
    changed.extend(reach.active().iter().filter(|&&v| left_out.moves(reach, v)));
    let mut interleaved = channels.to_interleaved();
    let mut reports = Vec::with_capacity(channels.count());
    let free = system.free().to_vec();
    let mut certifier = None;
    let mut factor = None;
    for (first, group) in channels.groups(&smoother.mesh) {
        let manner = smoother.manner(first == 0);
        let progress = &mut channels.share_of_progress(first, group.len(), progress);
        let fields: Vec<&[f64]> = group.iter().map(|channel: &Channel| channel.normalized.as_slice()).collect();
        let solved = system.solve(&smoother.laplacian, &fields, manner, progress)?;
        if manner.bounds {
            factor = perturbation_factor(smoother, system, set, &solved);
        }
        progress(Phase::Report, 0.95);
        if system.energy() == Energy::Harmonic && certifier.is_none() {
            certifier = Some(Certifier::new(smoother.mesh.connectivity(), &smoother.laplacian, &free));
        }
        for (c, (channel, solution)) in (first..).zip(group.iter().zip(&solved.solutions)) {
            let mut x = channel.normalized.clone();
            left_out.write(reach, &mut x);
            for (&v, &value) in system.free().iter().zip(&solution.x) {
                x[v as usize] = value;
            }
            let mut values = channel.restored(&x, &changed);
            level_constant_components(reach, set, channel, &mut x, &mut values);
            let facts = Facts {
                method: "interpolate",
                equation: "(6)",
                epsilon: None,
                constraints: Some(set),
                metric_norm: None,
                perturbation_factor: factor,
                maximum_principle: certifier.as_ref().map(|certifier| certifier.certify(&x)),
                solver: SolverReport::new(&solved, solution),
            };
            reports.push(measure(smoother, channel, &x, &values, facts)?);
            channels.write(c, &values, &mut interleaved);
        }
    }
    progress(Phase::Report, 1.0);
    Ok(Smoothed { values: interleaved, reports })
}

fn perturbation_factor(
    smoother: &Smoother,
    system: &ReducedSystem,
    set: &ConstraintSet,
    solved: &Solved,
) -> Option<f64> {
    if system.free().is_empty() {
        return Some(1.0);
    }
    let is_first_order = system.energy() == Energy::Harmonic && smoother.options.weights.is_symmetric();
    let eigenvalue = solved.smallest_eigenvalue;
    let singular_value = if is_first_order { eigenvalue } else { eigenvalue.map(f64::sqrt) };
    let takes_column = |v: usize| set.vertices.binary_search(&(v as u32)).is_ok();
    let fixed = bounds::norm_of_columns(&smoother.laplacian, &takes_column, &|row| system.row_scale(row));
    bounds::interpolation(fixed, singular_value)
}
