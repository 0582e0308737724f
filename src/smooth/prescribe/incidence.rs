//! The prescribed steps as the rows of a matrix D, what multipliers of them pull at, and what the search for the best field ends with.

use super::quadratic::Quadratic;
use super::steps::{GROUND, Step};
use crate::error::{Result, SolveError};
use crate::smooth::prescribed::PrescribeRoute;
use crate::support::memory;

/// The field of the least energy that takes all steps.
pub(super) struct Optimum {
    pub(super) x: Vec<f64>,
    pub(super) route: PrescribeRoute,
    /// The energy is above that of the best field by no more than this share of itself.
    pub(super) gap: f64,
    /// ‖Hx − c − Dᵀz‖ relative to what balances it.
    pub(super) unbalanced: f64,
    /// Iterations of the method, and solves in all.
    pub(super) iterations: usize,
    pub(super) solves: usize,
}

/// The prescribed steps between variables: places among them.
pub(super) struct Steps {
    pub(super) steps: Vec<Step>,
    /// Where the weight of each step goes in the matrix: to the diagonal of both ends, and off it; where an end has no variable to
    /// nowhere.
    diagonal: Vec<[u32; 2]>,
    beside: Vec<[u32; 2]>,
}

const NOWHERE: u32 = u32::MAX;

impl Steps {
    /// # Errors
    /// `OutOfMemory`.
    pub(super) fn new(steps: Vec<Step>, quadratic: &Quadratic<'_>) -> Result<Self> {
        memory::ensure(16 * steps.len() as u64)?;
        let is_free = |place: u32| place != GROUND && !quadratic.is_fixed[place as usize];
        let steps: Vec<Step> = steps.into_iter().filter(|step| is_free(step.from) || is_free(step.to)).collect();
        let mut diagonal = Vec::with_capacity(steps.len());
        let mut beside = Vec::with_capacity(steps.len());
        let at = |row: u32, column: u32| -> Result<u32, SolveError> {
            if is_free(row) && is_free(column) {
                Ok(quadratic.place(row as usize, column as usize)? as u32)
            } else {
                Ok(NOWHERE)
            }
        };
        for &Step { from, to, .. } in &steps {
            diagonal.push([at(from, from)?, at(to, to)?]);
            beside.push([at(from, to)?, at(to, from)?]);
        }
        Ok(Self { steps, diagonal, beside })
    }

    pub(super) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Dx.
    pub(super) fn rises(&self, x: &[f64]) -> Vec<f64> {
        (0..self.len()).map(|k| self.rise(x, k)).collect()
    }

    /// One component of Dx.
    pub(super) fn rise(&self, x: &[f64], step: usize) -> f64 {
        let value = |place: u32| if place == GROUND { 0.0 } else { x[place as usize] };
        let Step { from, to, .. } = self.steps[step];
        value(to) - value(from)
    }

    /// The steps that a field lacks by more than `tolerance`.
    pub(super) fn lacking(&self, x: &[f64], tolerance: f64) -> Vec<usize> {
        (0..self.len()).filter(|&k| self.rise(x, k) < self.steps[k].least - tolerance).collect()
    }

    /// y + Dᵀz for a z of which few components are given.
    pub(super) fn add_few_transposed(&self, z: impl Iterator<Item = (usize, f64)>, y: &mut [f64]) {
        for (k, z) in z {
            let Step { from, to, .. } = self.steps[k];
            if to != GROUND {
                y[to as usize] += z;
            }
            if from != GROUND {
                y[from as usize] -= z;
            }
        }
    }

    /// y + Dᵀz.
    pub(super) fn add_transposed(&self, z: &[f64], y: &mut [f64]) {
        self.add_few_transposed(z.iter().copied().enumerate(), y);
    }

    /// Adds DᵀWD to the values of the matrix.
    pub(super) fn add_weights(&self, weights: &[f64], values: &mut [f64]) {
        for ((&weight, diagonal), beside) in weights.iter().zip(&self.diagonal).zip(&self.beside) {
            for &place in diagonal.iter().filter(|&&place| place != NOWHERE) {
                values[place as usize] += weight;
            }
            for &place in beside.iter().filter(|&&place| place != NOWHERE) {
                values[place as usize] -= weight;
            }
        }
    }

    /// The steps between vertices.
    fn between(&self) -> impl Iterator<Item = (usize, &Step)> {
        self.steps.iter().enumerate().filter(|(_, step)| step.from != GROUND && step.to != GROUND)
    }

    /// The least rise that is asked for.
    pub(super) fn margin(&self) -> f64 {
        self.between().map(|(_, step)| step.least).fold(f64::INFINITY, f64::min).min(1.0)
    }

    /// The least rise over what is asked for.
    pub(super) fn least_slack(&self, x: &[f64]) -> f64 {
        let rises = self.rises(x);
        self.between().map(|(k, step)| rises[k] / step.least).fold(f64::INFINITY, f64::min)
    }
}
