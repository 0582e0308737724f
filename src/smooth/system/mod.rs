//! The linear systems of \[Patane09, section 4\] on the vertices of a mesh.
//!
//! - [`RegularizedSystem`]: every active vertex is an unknown, and a data term ties some or all to their values: eqs. (3), (5), (7).
//! - [`ReducedSystem`]: some vertices are fixed, the others are the unknowns: eq. (6).

mod reduced;
mod regularized;

pub use reduced::Energy;
pub(super) use reduced::ReducedSystem;
pub(super) use regularized::{Matrices, RegularizedSystem};

use super::names::{Route, UsedPrecision};
pub(super) use super::routes::Square;
use super::routes::{Accuracy, Answer, Problem, RightHandSide};
use crate::error::{Cancelled, Error, OutOfMemory, SmoothError, SolveError};
use crate::support::memory;
use crate::support::watch::Watch;

/// Bytes of an entry of a sparse matrix, and those that solving takes for each unknown and channel beside the factor: the right-hand
/// side, the solution, its residual and correction, each twice as long where the route is complex, and as complex numbers.
const ENTRY: u64 = (size_of::<usize>() + size_of::<f64>()) as u64;
const SOLVING: u64 = 128;

/// The work with an entry of a matrix that is copied into a part of it.
const COPIED: u64 = 10;

/// Makes sure of the memory that solving takes beside the factor.
fn ensure_solving(rows: usize, channels: usize) -> Result<(), OutOfMemory> {
    memory::ensure(SOLVING * rows as u64 * channels as u64)
}

/// One solved channel.
#[derive(Debug)]
pub(super) struct Solution {
    /// The normalised values of the unknowns.
    pub(super) x: Vec<f64>,
    /// ‖b − Ax‖₂/‖b‖₂ in factored form; NaN for a rough solution, of which nobody asks.
    pub(super) relative_residual: f64,
    pub(super) refinement_steps: usize,
    pub(super) iterations: usize,
}

/// All channels, and how they were solved.
#[derive(Debug)]
pub(super) struct Solved {
    pub(super) solutions: Vec<Solution>,
    pub(super) route: Route,
    pub(super) precision: UsedPrecision,
    pub(super) unknowns: usize,
    pub(super) factor_nonzeros: u64,
    /// See [`Answer`].
    pub(super) smallest_eigenvalue: Option<f64>,
}

/// The answer as solutions, with their residuals.
fn solved(
    problem: &Problem<'_>,
    right_hand_sides: &[RightHandSide],
    answer: Answer,
    accuracy: Accuracy,
    watch: &Watch<'_>,
) -> Result<Solved, Cancelled> {
    let mut solutions = Vec::with_capacity(answer.iterates.len());
    for (iterate, side) in answer.iterates.into_iter().zip(right_hand_sides) {
        let relative_residual = match accuracy {
            Accuracy::Full => {
                watch.tick(2 * problem.ticks())?;
                problem.relative_residual(side, &iterate.x)
            }
            Accuracy::Rough => f64::NAN,
        };
        solutions.push(Solution {
            relative_residual,
            refinement_steps: iterate.refinement_steps,
            iterations: iterate.iterations,
            x: iterate.x,
        });
    }
    Ok(Solved {
        solutions,
        route: answer.route,
        precision: answer.precision,
        unknowns: problem.unknowns(),
        factor_nonzeros: answer.factor_nonzeros,
        smallest_eigenvalue: answer.smallest_eigenvalue,
    })
}

/// A failure of the solver in the words of meshes, where unknowns are vertices.
fn on_mesh(unknowns: &[u32], error: SolveError) -> Error {
    let vertex = |place: usize| unknowns.get(place).map_or(place, |&v| v as usize);
    match error {
        SolveError::NotPositiveDefinite { column } => {
            SmoothError::NotPositiveDefinite { column: vertex(column) }.into()
        }
        SolveError::NotConverged { iterations, residual } => SmoothError::NotConverged { iterations, residual }.into(),
        SolveError::NonFiniteEntry { row } => SolveError::NonFiniteEntry { row: vertex(row) }.into(),
        other => other.into(),
    }
}
