//! Diffusion, and the low-pass filter of \[Taubin95\].

use nalgebra_sparse::CscMatrix;

use super::{filtered, filtering_bytes, require};
use crate::error::{OptionError, Result, SmoothError};
use crate::field::Missing;
#[cfg(doc)]
use crate::smooth::Smoother;
use crate::smooth::bounds;
use crate::smooth::channels::Channel;
use crate::smooth::input::Input;
use crate::smooth::names::{Equation, MethodName};
use crate::smooth::report::{About, Measures, Smoothed};
use crate::smooth::run::{Found, Procedure, Solution, run};
use crate::smooth::schedule::{Schedule, Stages};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

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
    /// What NaN means; filters cannot fill. Default an error.
    pub missing: Missing,
}

impl Default for LowPassOptions {
    fn default() -> Self {
        Self { iterations: 10, lambda: 0.5, mu: 0.0, channels: 1, missing: Missing::default() }
    }
}

/// # Errors
/// `InvalidOption`.
pub(in crate::smooth) fn check(options: &LowPassOptions) -> Result<(), OptionError> {
    // Comparisons with NaN are false.
    require(options.lambda > 0.0 && options.lambda <= 1.0, "lambda", "a number above 0 and at most 1")?;
    require((-1.0..=0.0).contains(&options.mu), "mu", "a number from -1 to 0")
}

pub(in crate::smooth) fn start(input: &Input<'_>, options: &LowPassOptions, watch: &Watch<'_>) -> Result<Smoothed> {
    let operators = input.operators;
    let &LowPassOptions { iterations, lambda, mu, .. } = options;
    let schedule = Schedule::of_filter(input.channels.group_count());
    let stages = schedule.stages(watch);
    // The averages; the diagonal, the sums that bounds are made from, or the values of two steps.
    let (n, entries) = (operators.mesh.vertex_count() as u64, operators.laplacian.nnz() as u64);
    memory::ensure(12 * entries + 40 * n)?;
    let diagonal = diagonal(&operators.laplacian);
    let perturbation_factor = match operators.options.bounds {
        true => bounds::low_pass(&operators.laplacian, &diagonal, operators.is_symmetric(), [lambda, mu], iterations),
        false => None,
    };
    let averages = Averages::new(&operators.laplacian, &diagonal);
    let about = About {
        method: MethodName::LowPass,
        equation: Equation::LowPass,
        epsilon: None,
        constraints: None,
        unconstrained: None,
    };
    run(input, &about, &mut LowPass { options, averages, perturbation_factor }, stages)
}

struct LowPass<'a> {
    options: &'a LowPassOptions,
    averages: Averages,
    perturbation_factor: Option<f64>,
}

impl Procedure for LowPass<'_> {
    fn solve(&mut self, group: &[Channel], _: bool, stages: &mut Stages<'_, '_>) -> Result<Found> {
        let step = 4 * (self.averages.offsets.len() + self.averages.neighbours.len()) as u64;
        let steps = group.len() * self.options.iterations * if self.options.mu == 0.0 { 1 } else { 2 };
        stages.begin(Phase::Solve, step.saturating_mul(steps as u64))?;
        memory::ensure(filtering_bytes(self.averages.offsets.len(), group.len()))?;
        let smooth = |channel: &Channel| self.smoothed(channel, step, stages.watch);
        let solutions = group.iter().map(smooth).collect::<Result<_>>()?;
        Ok(Found { solutions, perturbation_factor: self.perturbation_factor })
    }

    fn measures(&mut self, _: &[f64], _: &[f64]) -> Measures {
        Measures::default()
    }
}

impl LowPass<'_> {
    /// Takes all steps, of so many ticks each.
    fn smoothed(&self, channel: &Channel, step: u64, watch: &Watch<'_>) -> Result<Solution> {
        let mut x = channel.normalized.clone();
        let mut next = vec![0.0; x.len()];
        for iteration in 0..self.options.iterations {
            let mut bounded = true;
            for scale in [self.options.lambda, self.options.mu] {
                if scale != 0.0 {
                    watch.tick(step)?;
                    bounded &= self.averages.step(&x, scale, &mut next);
                    core::mem::swap(&mut x, &mut next);
                }
            }
            if !bounded {
                return Err(SmoothError::Diverged { iterations: iteration + 1 }.into());
            }
        }
        Ok(filtered(channel, &x, self.options.iterations))
    }
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
