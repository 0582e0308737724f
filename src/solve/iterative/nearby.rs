//! Conjugate gradients for matrices so badly conditioned that the length of a residual tells nothing, preconditioned by the factor of a
//! matrix nearby.

use super::preconditioner::Preconditioner;
use crate::error::SolveError;
use crate::solve::norm;
use crate::support::memory;
use crate::support::watch::Watch;

/// Vectors that are there at a time, b among them.
const VECTORS: usize = 8;
/// What a step takes besides the product and the preconditioner, for each unknown.
const TICKS_PER_UNKNOWN: u64 = 6;

/// Where the steps came to.
#[derive(Debug, Clone)]
pub(crate) struct Steps {
    pub(crate) x: Vec<f64>,
    pub(crate) count: usize,
    /// The smallest eigenvalue that was seen of M⁻¹A, for the preconditioner's matrix M: an error can be larger than a correction by so much.
    pub(crate) smallest: f64,
}

/// Solves A x = b from zero, until the residual is so small a fraction of b in the norm of M⁻¹, about that of the error in the norm of A.
/// Residuals are the recursive ones: what they miss is for refinement to find.
///
/// # Errors
/// `NotConverged` where that takes more than `most` steps; `IndefinitePreconditioner` and `NotPositiveDefinite` where a slope or a curvature
/// is not positive; those of the preconditioner; `OutOfMemory`.
pub(crate) fn conjugate_steps(
    apply: &mut dyn FnMut(&[f64]) -> Vec<f64>,
    preconditioner: &dyn Preconditioner,
    b: &[f64],
    fraction: f64,
    most: usize,
    watch: &Watch<'_>,
) -> Result<Steps, SolveError> {
    memory::ensure((VECTORS * size_of_val(b)) as u64)?;
    let scale = norm(b);
    let mut x = vec![0.0; b.len()];
    if scale == 0.0 {
        return Ok(Steps { x, count: 0, smallest: f64::INFINITY });
    }
    let mut residual: Vec<f64> = b.iter().map(|b| b / scale).collect();
    let mut direction = vec![0.0; b.len()];
    let mut lanczos = Lanczos::default();
    let (mut first, mut last) = (0.0, 1.0);
    for count in 0..=most {
        watch.tick(TICKS_PER_UNKNOWN * b.len() as u64)?;
        let z = preconditioner.apply(&residual, watch)?;
        let slope = dot(&residual, &z);
        if count == 0 {
            first = slope;
        } else if slope.abs() <= fraction * fraction * first {
            return Ok(Steps { x, count, smallest: lanczos.smallest() });
        }
        if !(slope > 0.0 && slope.is_finite()) {
            return Err(SolveError::IndefinitePreconditioner { iterations: count });
        }
        let ratio = if count == 0 { 0.0 } else { slope / last };
        direction.iter_mut().zip(&z).for_each(|(p, z)| *p = z + ratio * *p);
        let image = apply(&direction);
        let curvature = dot(&direction, &image);
        if !(curvature > 0.0 && curvature.is_finite()) {
            let largest =
                (0..b.len()).fold(0, |best, i| if direction[i].abs() > direction[best].abs() { i } else { best });
            return Err(SolveError::NotPositiveDefinite { column: largest });
        }
        let step = slope / curvature;
        lanczos.add(step, ratio);
        for i in 0..b.len() {
            x[i] += scale * (step * direction[i]);
            residual[i] -= step * image[i];
        }
        last = slope;
    }
    Err(SolveError::NotConverged { iterations: most, residual: (last / first).sqrt() })
}

/// The tridiagonal matrix whose eigenvalues approach those of M⁻¹A, made from the numbers of the steps.
#[derive(Debug, Default)]
struct Lanczos {
    diagonal: Vec<f64>,
    /// The squares beside the diagonal: the first belongs to the first two rows.
    beside: Vec<f64>,
    /// The reciprocal of the last step.
    inverse: f64,
}

impl Lanczos {
    fn add(&mut self, step: f64, ratio: f64) {
        if !self.diagonal.is_empty() {
            self.beside.push(ratio * self.inverse * self.inverse);
        }
        self.diagonal.push(step.recip() + ratio * self.inverse);
        self.inverse = step.recip();
    }

    /// The smallest eigenvalue, to a few digits, or the least number where it is none of a positive matrix.
    fn smallest(&self) -> f64 {
        let (mut low, mut high) = (f64::MIN_POSITIVE, self.diagonal.iter().copied().fold(f64::INFINITY, f64::min));
        // The geometric mean, as it may be of any size.
        while high > 1.1 * low {
            let middle = low.sqrt() * high.sqrt();
            if self.has_below(middle) { high = middle } else { low = middle }
        }
        low
    }

    /// Whether an eigenvalue is below a number: whether a pivot of what is left of the matrix is negative.
    fn has_below(&self, number: f64) -> bool {
        let mut pivot = self.diagonal[0] - number;
        for (d, square) in self.diagonal[1..].iter().zip(&self.beside) {
            if pivot <= 0.0 {
                return true;
            }
            pivot = d - number - square / pivot;
        }
        pivot <= 0.0
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
