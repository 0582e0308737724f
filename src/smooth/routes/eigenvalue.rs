//! The smallest eigenvalue of a system's matrix, which tells how much a solution can move.

use crate::error::SolveError;
use crate::mesh::shapes::Random;
use crate::smooth::system::Problem;
use crate::solve::norm;

/// The fewest steps, in which the start is forgotten, and the most.
const STEPS: core::ops::Range<usize> = 8..80;
/// The residual that is small enough, relative to the eigenvalue.
const TOLERANCE: f64 = 0.01;

/// Solves the system with a right side.
type Solve<'a> = &'a mut dyn FnMut(&[f64]) -> Result<Vec<f64>, SolveError>;

/// A lower bound of the smallest eigenvalue of a symmetric positive definite matrix; none where it cannot be told from
/// rounding.
///
/// Inverse iteration comes down to it from above. An eigenvalue lies within the residual of its last quotient, and so what is
/// returned is the quotient less the residual.
pub(super) fn smallest_eigenvalue(problem: &Problem<'_>, solve: Solve<'_>) -> Result<Option<f64>, SolveError> {
    let mut random = Random::new(1);
    let mut v: Vec<f64> = (0..problem.unknowns()).map(|_| random.signed()).collect();
    let mut bound = 0.0_f64;
    for step in 0..STEPS.end {
        let mut next = solve(&v)?;
        let length = norm(&next);
        if !(length.is_finite() && length > 0.0) {
            return Ok(None);
        }
        next.iter_mut().for_each(|x| *x /= length);
        v = next;
        let image = problem.apply(&v);
        let quotient: f64 = image.iter().zip(&v).map(|(a, x)| a * x).sum();
        let rest: Vec<f64> = image.iter().zip(&v).map(|(a, x)| a - quotient * x).collect();
        let residual = norm(&rest);
        bound = quotient - residual;
        if step >= STEPS.start && residual <= TOLERANCE * quotient {
            break;
        }
    }
    Ok((bound > 0.0 && bound.is_finite()).then_some(bound))
}
