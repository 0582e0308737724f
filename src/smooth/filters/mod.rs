//! The filters that \[Patane09, section 2.2\] compares with: a number of steps, each from the values of the step before.

mod bilateral;
mod grid;
mod low_pass;

pub use bilateral::BilateralOptions;
pub use low_pass::LowPassOptions;

pub(super) use bilateral::run as bilateral;
pub(super) use low_pass::run as low_pass;

use super::channels::{Channel, Channels};
use super::report::{Facts, Smoothed, SolverReport, measure};
use super::{Phase, Progress, Smoother};
use crate::error::{OptionError, Result};

/// The share of the steps in the whole work.
const STEPS: f64 = 0.95;

/// The least progress worth telling: displays do not show less, and telling it may cost more than a step.
const TOLD: f64 = 0.005;

/// What a filter is to the report.
struct Filter {
    method: &'static str,
    equation: &'static str,
    iterations: usize,
    perturbation_factor: Option<f64>,
}

/// Takes the steps on one channel: the values after them, normalised. The function is for the fraction done.
type Steps<'a> = &'a mut dyn FnMut(&Channel, &mut dyn FnMut(f64)) -> Result<Vec<f64>>;

/// Filters all channels, each by itself.
fn apply(
    smoother: &Smoother,
    channels: &Channels<'_>,
    filter: &Filter,
    steps: Steps<'_>,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    let mut interleaved = channels.to_interleaved();
    let mut reports = Vec::with_capacity(channels.count());
    for (first, group) in channels.groups(&smoother.mesh) {
        let share = |channel: usize, of_it: f64| STEPS * (channel as f64 + of_it) / channels.count() as f64;
        let mut told = share(first, 0.0);
        progress(Phase::Solve, told);
        let mut filtered = Vec::with_capacity(group.len());
        for (c, channel) in (first..).zip(&group) {
            let mut tell = |of_it: f64| {
                let fraction = share(c, of_it);
                if fraction >= told + TOLD {
                    told = fraction;
                    progress(Phase::Solve, fraction);
                }
            };
            filtered.push(steps(channel, &mut tell)?);
        }
        progress(Phase::Report, share(first + group.len(), 0.0));
        for (c, (channel, x)) in (first..).zip(group.iter().zip(&filtered)) {
            // Scaling there and back rounds: what no step moved is not to change by that.
            let moved = |&v: &u32| x[v as usize] != channel.normalized[v as usize];
            let changed: Vec<u32> = (0..x.len() as u32).filter(moved).collect();
            let facts = Facts {
                method: filter.method,
                equation: filter.equation,
                epsilon: None,
                constraints: None,
                metric_norm: None,
                perturbation_factor: filter.perturbation_factor,
                maximum_principle: None,
                solver: SolverReport::none(filter.iterations),
            };
            let values = channel.restored(x, &changed);
            reports.push(measure(smoother, channel, x, &values, facts)?);
            channels.write(c, &values, &mut interleaved);
        }
    }
    progress(Phase::Report, 1.0);
    Ok(Smoothed { values: interleaved, reports })
}

/// # Errors
/// `InvalidOption` where the option's value is not `valid`.
fn require(valid: bool, option: &str, expected: &str) -> Result<(), OptionError> {
    if valid {
        return Ok(());
    }
    Err(OptionError::invalid(option, expected))
}
