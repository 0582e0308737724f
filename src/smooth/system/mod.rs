//! The linear systems of \[Patane09, section 4\] on the vertices of a mesh.
//!
//! - [`FullSystem`]: every vertex that the operators reach is an unknown, and pulled towards its value or not: eqs. (3), (5), (7).
//! - [`ReducedSystem`]: some vertices are fixed, the others are the unknowns: eq. (6).

mod full;
mod reach;
mod reduced;

pub(super) use full::{Attraction, FullSystem};
pub(super) use reach::Reach;
pub use reduced::Energy;
pub(super) use reduced::ReducedSystem;

use super::routes::{Answer, Load, Problem};
use crate::error::{Error, SolveError};

/// One solved channel.
#[derive(Debug)]
pub(super) struct Solution {
    /// Per unknown, normalised.
    pub(super) x: Vec<f64>,
    /// ‖b − Ax‖₂/‖b‖₂ in factored form.
    pub(super) relative_residual: f64,
    pub(super) refinement_steps: usize,
    pub(super) iterations: usize,
}

/// All channels, and what the solver was.
#[derive(Debug)]
pub(super) struct Solved {
    pub(super) solutions: Vec<Solution>,
    pub(super) route: &'static str,
    pub(super) precision: &'static str,
    pub(super) unknowns: usize,
    pub(super) factor_nonzeros: u64,
    /// See [`Answer`].
    pub(super) smallest_eigenvalue: Option<f64>,
}

/// The answer as solutions, with their residuals.
fn solved(problem: &Problem<'_>, loads: &[Load], answer: Answer) -> Solved {
    let solutions = answer
        .iterates
        .into_iter()
        .zip(loads)
        .map(|(iterate, load)| Solution {
            relative_residual: problem.relative_residual(load, &iterate.x),
            refinement_steps: iterate.refinement_steps,
            iterations: iterate.iterations,
            x: iterate.x,
        })
        .collect();
    Solved {
        solutions,
        route: answer.route,
        precision: answer.precision,
        unknowns: problem.unknowns(),
        factor_nonzeros: answer.factor_nonzeros,
        smallest_eigenvalue: answer.smallest_eigenvalue,
    }
}

/// Unknowns are vertices to the user.
fn by_vertex(unknowns: &[u32], error: SolveError) -> Error {
    let vertex = |place: usize| unknowns.get(place).map_or(place, |&v| v as usize);
    match error {
        SolveError::NotPositiveDefinite { column } => SolveError::NotPositiveDefinite { column: vertex(column) }.into(),
        SolveError::NonFiniteEntry { row } => SolveError::NonFiniteEntry { row: vertex(row) }.into(),
        other => other.into(),
    }
}
