//! Preconditioned conjugate gradients.

use super::preconditioner::Preconditioner;
use crate::Watch;
use crate::error::SolveError;
use crate::solve::matrix::norm;
use crate::support::memory;

/// What counts as a lower residual.
const PROGRESS: f64 = 0.99;
/// Residuals may grow before they shrink, by the square root of the condition number at most, and double precision
/// solves nothing past the square of this.
const DIVERGED: f64 = 1e8;

/// An unknown in one iteration, with a product with the matrix of an operator on a mesh and without the preconditioner.
const TICKS_PER_UNKNOWN: u64 = 40;
/// Vectors that are in use at once, those of a product and of a preconditioner included.
const VECTORS: usize = 12;

/// When [`conjugate_gradient`] stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CgOptions {
    /// ‖b − A x‖₂ ≤ tolerance · ‖b‖₂. Default 1e-11.
    pub tolerance: f64,
    /// Most products with A. Default 20,000.
    pub max_iterations: usize,
    /// Most iterations in a row that bring the residual no lower than it was. Residuals of ill-conditioned systems stay on
    /// plateaus as long as that before they fall; with a good preconditioner a hundred say that they never will.
    /// Default 5,000.
    pub patience: usize,
}

impl Default for CgOptions {
    fn default() -> Self {
        Self { tolerance: 1e-11, max_iterations: 20_000, patience: 5_000 }
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

/// Solves A x = b for a symmetric positive definite A given by its products, starting from and overwriting `x`.
///
/// # Definition
/// Preconditioned conjugate gradients \[Hestenes52\] in the flexible variant, whose directions are conjugate to the one
/// before whatever the preconditioner was, so that it may vary from step to step \[Notay00\].
///
/// # Errors
/// `DimensionMismatch`; `NonFiniteEntry` in `b`, `x` or a product; `NotPositiveDefinite` where a curvature is not
/// positive, with the unknown that moves most; `IndefinitePreconditioner`; what the preconditioner fails with; `Cancelled`;
/// `OutOfMemory`;
/// `NotConverged` with the relative residual reached, as soon as iterations no longer help. On an error `x` holds the last
/// iterate.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, mesh::shapes, operators::uniform_laplacian};
/// use morse_smooth::solve::{CgOptions, Multigrid, conjugate_gradient, transposed_product};
/// let mut matrix = uniform_laplacian(&shapes::torus(60, 40, 0.2)?)?;
/// matrix.triplet_iter_mut().filter(|(i, j, _)| i == j).for_each(|(_, _, value)| *value += 0.01);
/// let multigrid = Multigrid::new(&matrix, &Watch::none())?;
/// let (b, mut x) = (vec![1.0; 2400], vec![0.0; 2400]);
/// let apply = &mut |x: &[f64]| transposed_product(&matrix, x);
/// let info = conjugate_gradient(apply, &multigrid, &b, &mut x, &CgOptions::default(), &Watch::none())?;
/// assert!(info.iterations < 30 && (x[7] - 100.0).abs() < 1e-6);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn conjugate_gradient(
    apply: &mut dyn FnMut(&[f64]) -> Vec<f64>,
    preconditioner: &dyn Preconditioner,
    b: &[f64],
    x: &mut [f64],
    options: &CgOptions,
    watch: &Watch<'_>,
) -> Result<CgInfo, SolveError> {
    let n = b.len();
    for actual in [preconditioner.size(), x.len()] {
        if actual != n {
            return Err(SolveError::DimensionMismatch { expected: n, actual });
        }
    }
    if let Some(row) = (0..n).find(|&i| !(b[i].is_finite() && x[i].is_finite())) {
        return Err(SolveError::NonFiniteEntry { row });
    }
    if !(options.tolerance > 0.0 && options.tolerance < 1.0) {
        return Err(SolveError::NotConverged { iterations: 0, residual: 1.0 });
    }
    let size = norm(b);
    if size == 0.0 {
        x.fill(0.0);
        return Ok(CgInfo { iterations: 0, relative_residual: 0.0 });
    }
    memory::ensure((VECTORS * size_of_val(b)) as u64)?;
    let target = options.tolerance * size;
    let mut iterations = 0;
    let (mut residual, mut start) = true_residual(apply, b, x)?;
    // The recursive residual drifts from the true one: restart from the true one until that is small too.
    while start > target {
        let limits = Limits { most: options.max_iterations - iterations, patience: options.patience };
        let used = descend(apply, preconditioner, &mut residual, x, target, limits, watch)?;
        iterations += used;
        let reached;
        (residual, reached) = true_residual(apply, b, x)?;
        let spent = iterations >= options.max_iterations || reached > 0.5 * start || reached > DIVERGED * size;
        if reached > target && spent {
            return Err(SolveError::NotConverged { iterations, residual: reached / size });
        }
        start = reached;
    }
    Ok(CgInfo { iterations, relative_residual: start / size })
}

/// b − A x and its length.
fn true_residual(
    apply: &mut dyn FnMut(&[f64]) -> Vec<f64>,
    b: &[f64],
    x: &[f64],
) -> Result<(Vec<f64>, f64), SolveError> {
    let mut residual = apply(x);
    if residual.len() != b.len() {
        return Err(SolveError::DimensionMismatch { expected: b.len(), actual: residual.len() });
    }
    residual.iter_mut().zip(b).for_each(|(r, b)| *r = b - *r);
    let length = norm(&residual);
    if !length.is_finite() {
        let row = residual.iter().position(|r| !r.is_finite()).unwrap_or(0);
        return Err(SolveError::NonFiniteEntry { row });
    }
    Ok((residual, length))
}

/// Where [`descend`] gives up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    pub(super) most: usize,
    pub(super) patience: usize,
}

/// Iterates until the recursive residual is below `target` or iterations no longer help; their number. The residual is
/// scaled to length 1, so that its squares stay within the range of double precision.
pub(super) fn descend(
    apply: &mut dyn FnMut(&[f64]) -> Vec<f64>,
    preconditioner: &dyn Preconditioner,
    residual: &mut [f64],
    x: &mut [f64],
    target: f64,
    Limits { most, patience }: Limits,
    watch: &Watch<'_>,
) -> Result<usize, SolveError> {
    let scale = norm(residual);
    if scale == 0.0 {
        return Ok(0);
    }
    residual.iter_mut().for_each(|r| *r /= scale);
    let mut direction = vec![0.0; x.len()];
    // A times the last direction, and its curvature: the next direction is made conjugate to it.
    let (mut image, mut curvature) = (Vec::new(), 1.0);
    let (mut smallest, mut since) = (1.0_f64, 0);
    for iteration in 0..most {
        watch.tick(TICKS_PER_UNKNOWN * x.len() as u64)?;
        let z = preconditioner.apply(residual, watch)?;
        let ratio = if iteration == 0 { 0.0 } else { -dot(&z, &image) / curvature };
        direction.iter_mut().zip(&z).for_each(|(p, z)| *p = z + ratio * *p);
        let slope = dot(residual, &z);
        if !(slope > 0.0 && slope.is_finite()) {
            return Err(SolveError::IndefinitePreconditioner { iterations: iteration });
        }
        image = apply(&direction);
        curvature = dot(&direction, &image);
        if !(curvature > 0.0 && curvature.is_finite()) {
            return Err(SolveError::NotPositiveDefinite { column: largest(&direction) });
        }
        let step = slope / curvature;
        for i in 0..x.len() {
            x[i] += scale * (step * direction[i]);
            residual[i] -= step * image[i];
        }
        let length = norm(residual);
        if scale * length <= target {
            return Ok(iteration + 1);
        }
        since += 1;
        if length < PROGRESS * smallest {
            smallest = length;
            since = 0;
        }
        if since >= patience || length.is_nan() || length > DIVERGED {
            return Ok(iteration + 1);
        }
    }
    Ok(most)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The place of the largest magnitude.
fn largest(x: &[f64]) -> usize {
    (0..x.len()).fold(0, |best, i| if x[i].abs() > x[best].abs() { i } else { best })
}
