//! What eqs. (3), (5) and (7) of \[Patane09\] have in common: values are pulled towards the input by εB, and all vertices are free.

use super::bounds;
use super::channels::Channels;
use super::constraints::{ConstraintSet, LeftOut, level_constant_components};
use super::report::{Facts, Smoothed, SolverReport, measure};
use super::routes::Mass;
use super::system::{Attraction, FullSystem, Solved};
use super::{Phase, Progress, Smoother};
use crate::error::Result;

/// One of these equations.
pub(super) struct Regularization<'a> {
    pub(super) method: &'static str,
    pub(super) equation: &'static str,
    pub(super) epsilon: f64,
    pub(super) attraction: Attraction,
    /// With the components that have none.
    pub(super) constraints: Option<(&'a ConstraintSet, LeftOut)>,
}

pub(super) fn run(
    smoother: &mut Smoother,
    channels: &Channels<'_>,
    request: &Regularization<'_>,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    let left_out = request.constraints.as_ref().map(|(_, left_out)| left_out).filter(|left_out| !left_out.is_empty());
    let mut system = match left_out {
        None => smoother.take_full_system()?,
        Some(left_out) => smoother.take_partial_system(left_out)?,
    };
    let outcome = solve(smoother, &mut system, channels, request, progress);
    // Kept after an error too: the analysis stays valid.
    match left_out {
        None => smoother.full = Some(system),
        Some(_) => smoother.partial = Some(system),
    }
    outcome
}

fn solve(
    smoother: &Smoother,
    system: &mut FullSystem,
    channels: &Channels<'_>,
    request: &Regularization<'_>,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    let Regularization { method, equation, epsilon, attraction, constraints } = request;
    let reach = smoother.reach();
    let left_out = constraints.as_ref().map(|(_, left_out)| left_out);
    let mut changed = system.unknowns().to_vec();
    if let Some(left_out) = left_out {
        changed.extend(reach.active().iter().filter(|&&v| left_out.moves(reach, v)));
    }
    let mut interleaved = channels.to_interleaved();
    let mut reports = Vec::with_capacity(channels.count());
    let mut factor = None;
    for (first, group) in channels.groups(&smoother.mesh) {
        let manner = smoother.manner(first == 0);
        let progress = &mut channels.share_of_progress(first, group.len(), progress);
        let solved = system.solve(&smoother.mesh, &group, *epsilon, attraction, manner, progress)?;
        let mass = system.mass().unwrap_or(&Mass::Identity);
        if manner.bounds {
            factor = perturbation_factor(mass, &solved, *epsilon);
        }
        progress(Phase::Report, 0.95);
        for (c, (channel, solution)) in (first..).zip(group.iter().zip(&solved.solutions)) {
            let mut x = channel.normalized.clone();
            if let Some(left_out) = left_out {
                left_out.write(reach, &mut x);
            }
            for (&v, &value) in system.unknowns().iter().zip(&solution.x) {
                x[v as usize] = value;
            }
            let mut values = channel.restored(&x, &changed);
            if let Some((set, _)) = constraints {
                level_constant_components(reach, set, channel, &mut x, &mut values);
            }
            let mut moved = Vec::with_capacity(solution.x.len());
            for &v in system.unknowns() {
                moved.push(x[v as usize] - channel.normalized[v as usize]);
            }
            let facts = Facts {
                method,
                equation,
                epsilon: Some(*epsilon),
                constraints: constraints.as_ref().map(|(set, _)| *set),
                metric_norm: Some(mass.norm(&moved)),
                perturbation_factor: factor,
                maximum_principle: None,
                solver: SolverReport::new(&solved, solution),
            };
            reports.push(measure(smoother, channel, &x, &values, facts)?);
            channels.write(c, &values, &mut interleaved);
        }
    }
    progress(Phase::Report, 1.0);
    Ok(Smoothed { values: interleaved, reports })
}

fn perturbation_factor(mass: &Mass, solved: &Solved, epsilon: f64) -> Option<f64> {
    if solved.unknowns == 0 {
        return Some(1.0);
    }
    // The system was divided by this.
    let epsilon = epsilon / epsilon.max(1.0);
    bounds::regularized(mass, solved.unknowns, epsilon, solved.smallest_eigenvalue)
}
