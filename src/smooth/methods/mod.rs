//! The methods: the options of each, and what is specific to it.

pub(super) mod bilateral;
mod functional;
mod grid;
pub(super) mod interpolate;
pub(super) mod least_squares;
pub(super) mod low_pass;
mod regularized;
pub(super) mod tikhonov;

pub use bilateral::BilateralOptions;
pub use functional::Functional;
pub use interpolate::InterpolateOptions;
pub use least_squares::LeastSquaresOptions;
pub use low_pass::LowPassOptions;
pub(super) use regularized::Regularization;
pub use tikhonov::{TikhonovOptions, epsilon_for_wavelength};

use super::SmootherOptions;
use super::channels::Channel;
use super::constraints::{ConstraintSet, Constraints};
use super::input::Input;
use super::report::SolverReport;
use super::routes::{Accuracy, Solutions, SolverSettings};
use super::run::Solution;
use super::schedule::Stages;
use super::unconstrained::UnconstrainedComponents;
use crate::error::{OptionError, Result};
use crate::support::memory;

/// How systems are to be solved. Bounds are the same for all channels, and so are computed with the first ones.
pub(super) fn settings(options: SmootherOptions, is_first: bool) -> SolverSettings {
    SolverSettings {
        choice: options.solver,
        precision: options.precision,
        bounds: options.bounds && is_first,
        accuracy: Accuracy::Full,
        solutions: Solutions::Few,
    }
}

/// The vertices that are constrained, and the components of the mesh without any.
fn constrained(
    input: &Input<'_>,
    constraints: &Constraints<'_>,
    stages: &mut Stages<'_, '_>,
) -> Result<(ConstraintSet, UnconstrainedComponents)> {
    let set = ConstraintSet::new(input, constraints, stages)?;
    // The unknowns, and the constraints once more.
    memory::ensure(40 * input.operators.mesh.vertex_count() as u64)?;
    let components = UnconstrainedComponents::new(&input.operators.active, &set.vertices, constraints.unconstrained)?;
    Ok((set, components))
}

/// The bytes that filtering some channels takes: values of two steps, twice where they are sorted, and the results with their lists.
fn filtering_bytes(vertices: usize, channels: usize) -> u64 {
    (40 + 16 * channels as u64) * vertices as u64
}

/// What a filter made of a channel.
fn filtered(channel: &Channel, x: &[f64], iterations: usize) -> Solution {
    // Scaling there and back rounds: what no step moved is not to change by that.
    let moved = |&v: &u32| x[v as usize] != channel.normalized[v as usize];
    let vertices: Vec<u32> = (0..x.len() as u32).filter(moved).collect();
    let x = vertices.iter().map(|&v| x[v as usize]).collect();
    Solution { vertices: vertices.into(), x, values: None, solver: SolverReport::none(iterations) }
}

/// # Errors
/// `InvalidOption` where the option's value is not `valid`.
fn require(valid: bool, option: &str, expected: &str) -> Result<(), OptionError> {
    if valid {
        return Ok(());
    }
    Err(OptionError::invalid(option, expected))
}
