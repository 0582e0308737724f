//! Conjugate gradients with a Jacobi preconditioner.

use super::matrix::norm;
use crate::error::SolveError;

/// When [`conjugate_gradient`] stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CgOptions {
    /// ‖b − A x‖₂ ≤ tolerance · ‖b‖₂. Default 1e-11.
    pub tolerance: f64,
    /// Most products with A. Default 20,000.
    pub max_iterations: usize,
}

impl Default for CgOptions {
    fn default() -> Self {
        Self { tolerance: 1e-11, max_iterations: 20_000 }
    }
}

/// How [`conjugate_gradient`] went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CgInfo {
    /// Products with A.
    pub iterations: usize,
    /// ‖b − A x‖₂ / ‖b‖₂, computed from x anew at the end.
    pub relative_residual: f64,
}

/// Solves A x = b for a symmetric positive definite A given by its products, starting from and overwriting `x`
/// (\[Hestenes52\]; preconditioner diag(A)⁻¹).
///
/// # Errors
/// `DimensionMismatch`; `NonFiniteEntry` in `b` or `x`; `NotPositiveDefinite` where the diagonal or a curvature is not
/// positive; `NotConverged` with the relative residual reached. On an error `x` holds the last iterate.
pub fn conjugate_gradient(
    mut apply: impl FnMut(&[f64]) -> Vec<f64>,
    diagonal: &[f64],
    b: &[f64],
    x: &mut [f64],
    options: &CgOptions,
) -> Result<CgInfo, SolveError> {
    let n = b.len();
    for actual in [diagonal.len(), x.len()] {
        if actual != n {
            return Err(SolveError::DimensionMismatch { expected: n, actual });
        }
    }
    if let Some(row) = (0..n).find(|&i| !(b[i].is_finite() && x[i].is_finite())) {
        return Err(SolveError::NonFiniteEntry { row });
    }
    if let Some(column) = diagonal.iter().position(|&d| !(d.is_finite() && d > 0.0)) {
        return Err(SolveError::NotPositiveDefinite { column });
    }
    let size = norm(b);
    if size == 0.0 {
        x.fill(0.0);
        return Ok(CgInfo { iterations: 0, relative_residual: 0.0 });
    }
    let target = options.tolerance * size;
    let mut iterations = 0;
    // The recursive residual drifts from the true one: restart from the true one until that is small too.
    loop {
        let mut residual: Vec<f64> = apply(x).iter().zip(b).map(|(ax, b)| b - ax).collect();
        let start = norm(&residual);
        if start <= target {
            return Ok(CgInfo { iterations, relative_residual: start / size });
        }
        let used = descend(&mut apply, diagonal, &mut residual, x, target, options.max_iterations - iterations)?;
        iterations += used;
        let reached: Vec<f64> = apply(x).iter().zip(b).map(|(ax, b)| b - ax).collect();
        let reached = norm(&reached);
        if reached <= target {
            return Ok(CgInfo { iterations, relative_residual: reached / size });
        }
        if iterations >= options.max_iterations || reached > 0.5 * start {
            return Err(SolveError::NotConverged { iterations, residual: reached / size });
        }
    }
}

/// Plain preconditioned iteration until the recursive residual is below `target`; the number of iterations. The residual
/// is scaled to length 1, so that its squares stay within the range of double precision.
fn descend(
    apply: &mut impl FnMut(&[f64]) -> Vec<f64>,
    diagonal: &[f64],
    residual: &mut [f64],
    x: &mut [f64],
    target: f64,
    most: usize,
) -> Result<usize, SolveError> {
    let precondition = |r: &[f64]| -> Vec<f64> { r.iter().zip(diagonal).map(|(r, d)| r / d).collect() };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let scale = norm(residual);
    residual.iter_mut().for_each(|r| *r /= scale);
    let mut z = precondition(residual);
    let mut direction = z.clone();
    let mut rz = dot(residual, &z);
    for iteration in 0..most {
        let image = apply(&direction);
        let curvature = dot(&direction, &image);
        if !(curvature.is_finite() && curvature > 0.0) {
            return Err(SolveError::NotPositiveDefinite { column: 0 });
        }
        let step = rz / curvature;
        for i in 0..x.len() {
            x[i] += scale * (step * direction[i]);
            residual[i] -= step * image[i];
        }
        if scale * norm(residual) <= target {
            return Ok(iteration + 1);
        }
        z = precondition(residual);
        let next = dot(residual, &z);
        let ratio = next / rz;
        rz = next;
        for i in 0..x.len() {
            direction[i] = z[i] + ratio * direction[i];
        }
    }
    Ok(most)
}
