//! The smallest eigenvalue of a system's matrix, which tells how much a solution can move.

use super::problem::Problem;
use crate::error::{Cancelled, SolveError};
use crate::solve::norm;
use crate::support::random::Random;
use crate::support::watch::Watch;

/// The fewest steps, in which the start is forgotten, and the most.
const STEPS: core::ops::Range<usize> = 16..80;
/// The residual that is small enough, relative to the eigenvalue.
const TOLERANCE: f64 = 0.01;
/// What is taken of the eigenvalue found. A smaller one whose eigenvector has a share of only 1e-4 in the start would have been
/// seen if it were below this part: that share grows by 0.7⁻¹⁶ = 300 in the fewest steps, and its residual past the tolerance.
const SHARE: f64 = 0.7;

/// Solves the system with a right-hand side.
type Solve<'a> = &'a mut dyn FnMut(&[f64]) -> Result<Vec<f64>, SolveError>;

/// A lower bound of the smallest eigenvalue of a symmetric positive definite matrix; none where it cannot be told from
/// rounding, or a system cannot be solved.
///
/// # Errors
/// `Cancelled` alone.
///
/// Inverse iteration comes down to it from above. An eigenvalue lies within the residual of its last quotient, and so what is
/// returned is the quotient less the residual, and less a margin: that eigenvalue may be the next one to the smallest.
pub(super) fn smallest_eigenvalue(
    problem: &Problem<'_>,
    solve: Solve<'_>,
    watch: &Watch<'_>,
) -> Result<Option<f64>, Cancelled> {
    let mut random = Random::new(1);
    let mut v: Vec<f64> = (0..problem.unknowns()).map(|_| random.signed()).collect();
    let mut bound = 0.0_f64;
    for step in 0..STEPS.end {
        watch.tick(problem.ticks())?;
        let mut next = match solve(&v) {
            Ok(next) => next,
            Err(SolveError::Cancelled {}) => return Err(Cancelled),
            Err(_) => return Ok(None),
        };
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
        bound = SHARE * (quotient - residual);
        if step >= STEPS.start && residual <= TOLERANCE * quotient {
            break;
        }
    }
    Ok((bound > 0.0 && bound.is_finite()).then_some(bound))
}
