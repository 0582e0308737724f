//! How far the solutions of a family are from the exact ones.
//!
//! In such a space the residuals for all ε are multiples of one vector, by factors that are known from the shifts and the projected
//! systems. The same holds for the smaller space without the highest derivative of each shift, whose errors are known as the larger one is so much
//! better. What an error is for its residual is nearly the same in both: so the errors of the small space, times the quotient of
//! the two residuals, tell those of the large one. The quotient is measured at one ε.

use core::f64::consts::LN_10;

use super::space::{Space, Which};
use crate::smooth::routes::RightHandSide;
use crate::smooth::system::Matrices;

/// Errors of so many ε in each decade are looked at.
pub(super) const PER_DECADE: f64 = 24.0;
/// How much larger estimates are than what the quotient says, after so many shifts: it was found to be below the error by as much,
/// the more so the more of the range lies beyond the shifts.
fn safety(shifts: usize) -> f64 {
    match shifts {
        // Where the space begins, its error is smooth in ε, and nothing hides between shifts.
        0..=1 => 2.0,
        2..=3 => 3.0,
        4..=6 => 2.0,
        _ => 1.5,
    }
}

/// How far below the tolerance the estimate has to be for a family to be complete: where shifts are few, those errors count that
/// were three times what the quotient says.
pub(super) fn margin(shifts: usize) -> f64 {
    if shifts <= 6 { 3.0 / safety(shifts) } else { 1.0 }
}

/// Where the two spaces are equally good, the difference between them says nothing; this is the largest quotient that counts.
const LARGEST_QUOTIENT: f64 = 0.95;

/// ln of the quotient of the residuals, less what the shifts and projected systems say of it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Calibration(f64);

/// ε in equal steps of their logarithms, both ends included.
pub(super) fn logarithmic(range: (f64, f64), per_decade: f64) -> Vec<f64> {
    let (first, last) = (libm::log(range.0), libm::log(range.1));
    let steps = ((last - first) / LN_10 * per_decade).ceil().max(1.0) as usize;
    let at = |k: usize| power_of_ten(libm::exp(first + (last - first) * k as f64 / steps as f64));
    (0..=steps)
        .map(|k| {
            if k == 0 {
                range.0
            } else if k == steps {
                range.1
            } else {
                at(k)
            }
        })
        .collect()
}

/// A number, or the power of ten that it is but for rounding: the nearest to that power that there is.
fn power_of_ten(number: f64) -> f64 {
    let exponent = libm::round(libm::log10(number));
    let power = (0..exponent.abs() as u32).fold(1.0, |power, _| power * 10.0);
    let power = if exponent < 0.0 { 1.0 / power } else { power };
    if (number - power).abs() <= 1e-12 * power { power } else { number }
}

impl Calibration {
    /// Measures the two residuals where that of the large space is largest.
    pub(super) fn new(space: &Space, matrices: &Matrices, shifts: &[f64], range: (f64, f64)) -> Self {
        let quotient = |epsilon: f64| {
            space.log_residual(epsilon, shifts, Which::Full) - space.log_residual(epsilon, shifts, Which::Partial)
        };
        let relative = |epsilon: &f64| space.log_residual(*epsilon, shifts, Which::Full) - libm::log(*epsilon);
        let grid = logarithmic(range, PER_DECADE / 4.0);
        let Some(at) = grid.into_iter().max_by(|a, b| relative(a).total_cmp(&relative(b))) else {
            return Self::default();
        };
        let problem = matrices.problem(at);
        let diagonal = problem.diagonal();
        let side = RightHandSide { field: space.field().to_vec(), offset: Vec::new() };
        let size = |which: Which| {
            let residual = problem.residual(&side, &space.solution(at, which));
            let squares = residual.iter().zip(&diagonal).map(|(r, d)| if *d > 0.0 { r * r / d } else { 0.0 });
            squares.sum::<f64>().sqrt()
        };
        let (full, partial) = (size(Which::Full), size(Which::Partial));
        let measured = if full > 0.0 && partial > 0.0 { libm::log(full / partial) } else { -40.0 };
        Self(measured - quotient(at))
    }

    /// The relative error for an ε.
    pub(super) fn error(self, space: &Space, epsilon: f64, shifts: &[f64]) -> f64 {
        let full = space.log_residual(epsilon, shifts, Which::Full);
        let partial = space.log_residual(epsilon, shifts, Which::Partial);
        let quotient = libm::exp(full - partial + self.0).min(LARGEST_QUOTIENT);
        // The error of the small space is the difference and what the large one errs.
        safety(shifts.len()) * space.difference(epsilon) * quotient / (1.0 - quotient * quotient).sqrt()
    }
}
