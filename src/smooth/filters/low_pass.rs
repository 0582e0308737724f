//! Diffusion, and the low-pass filter of \[Taubin95\].

use nalgebra_sparse::CscMatrix;

use super::{Filter, apply, require};
use crate::error::{Result, SmoothError};
use crate::smooth::channels::{Channel, Channels};
use crate::smooth::report::Smoothed;
use crate::smooth::{Progress, Smoother, bounds};

/// Beyond this, in units of the range of the input, values grow and do not come back: no filter with non-negative weights that
/// is of any use comes near.
const DIVERGED: f64 = 1e6;

/// Options of [`Smoother::low_pass`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowPassOptions {
    /// Number of iterations, each of one step with λ and, where μ is not zero, one with μ. Default 10.
    pub iterations: usize,
    /// The step that smooths, in (0, 1]. Default 0.5.
    pub lambda: f64,
    /// The step that takes back what λ has shrunk, in [−1, 0]; beyond −λ to be of use. Zero for plain diffusion. Default 0.
    pub mu: f64,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`. Default 1.
    pub channels: usize,
}

impl Default for LowPassOptions {
    fn default() -> Self {
        Self { iterations: 10, lambda: 0.5, mu: 0.0, channels: 1 }
    }
}

pub(in crate::smooth) fn run(
    smoother: &Smoother,
    values: &[f64],
    options: &LowPassOptions,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    let &LowPassOptions { iterations, lambda, mu, channels } = options;
    // Comparisons with NaN are false.
    require(lambda > 0.0 && lambda <= 1.0, "lambda", "a number above 0 and at most 1")?;
    require((-1.0..=0.0).contains(&mu), "mu", "a number from -1 to 0")?;
    let channels = Channels::new(&smoother.mesh, values, channels)?;
    let diagonal = diagonal(&smoother.laplacian);
    let is_symmetric = smoother.options.weights.is_symmetric();
    let perturbation_factor = match smoother.options.bounds {
        true => bounds::low_pass(&smoother.laplacian, &diagonal, is_symmetric, [lambda, mu], iterations),
        false => None,
    };
    let filter = Filter { method: "lowPass", equation: "[18, 24]", iterations, perturbation_factor };
    let averages = Averages::new(&smoother.laplacian, &diagonal);
    let mut steps = |channel: &Channel, tell: &mut dyn FnMut(f64)| -> Result<Vec<f64>> {
        let mut x = channel.normalized.clone();
        let mut next = vec![0.0; x.len()];
        for iteration in 0..iterations {
            let mut bounded = true;
            for scale in [lambda, mu] {
                if scale != 0.0 {
                    bounded &= averages.step(&x, scale, &mut next);
                    core::mem::swap(&mut x, &mut next);
                }
            }
            if !bounded {
                return Err(SmoothError::Diverged { iterations: iteration + 1 }.into());
            }
            tell((iteration + 1) as f64 / iterations as f64);
        }
        Ok(x)
    };
    apply(smoother, &channels, &filter, &mut steps, progress)
}

fn diagonal(laplacian: &CscMatrix<f64>) -> Vec<f64> {
    let mut diagonal = vec![0.0; laplacian.ncols()];
    for (j, column) in laplacian.col_iter().enumerate() {
        if let Ok(place) = column.row_indices().binary_search(&j) {
            diagonal[j] = column.values()[place];
        }
    }
    diagonal
}

/// The weighted averages of the neighbours that D⁻¹L compares each vertex with: rows of I − D⁻¹L.
struct Averages {
    offsets: Vec<usize>,
    neighbours: Vec<u32>,
    weights: Vec<f64>,
}

impl Averages {
    /// Rows without a positive diagonal, which nothing can be divided by, are empty.
    fn new(laplacian: &CscMatrix<f64>, diagonal: &[f64]) -> Self {
        let mut offsets = vec![0; diagonal.len() + 1];
        let enters = |row: usize, column: usize| row != column && diagonal[row] > 0.0;
        for (row, column, _) in laplacian.triplet_iter() {
            offsets[row + 1] += usize::from(enters(row, column));
        }
        for row in 0..diagonal.len() {
            offsets[row + 1] += offsets[row];
        }
        let mut next = offsets.clone();
        let entries = offsets[diagonal.len()];
        let (mut neighbours, mut weights) = (vec![0; entries], vec![0.0; entries]);
        for (row, column, &value) in laplacian.triplet_iter() {
            if enters(row, column) {
                neighbours[next[row]] = column as u32;
                weights[next[row]] = -value / diagonal[row];
                next[row] += 1;
            }
        }
        Self { offsets, neighbours, weights }
    }

    /// (I − scale · D⁻¹L) x, and whether that is bounded. Formed from differences, so that constants stay to the last bit.
    #[inline(never)]
    fn step(&self, x: &[f64], scale: f64, next: &mut [f64]) -> bool {
        let mut bounded = true;
        for i in 0..x.len() {
            let here = x[i];
            let mut sum = 0.0;
            for k in self.offsets[i]..self.offsets[i + 1] {
                sum += self.weights[k] * (x[self.neighbours[k] as usize] - here);
            }
            let there = here + scale * sum;
            // False for NaN too.
            bounded &= there.abs() <= DIVERGED;
            next[i] = there;
        }
        bounded
    }
}
