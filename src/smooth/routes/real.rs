//! The real route: the Cholesky factor of A, or of AᵀWA/scale + εB, refined with the residual in factored form.

use nalgebra_sparse::pattern::SparsityPattern;

use super::eigenvalue::smallest_eigenvalue;
use super::factors::Factors;
use super::refine::{Refinement, refine};
use super::{Answer, Mass, Order, Problem, Pull, Task};
use crate::Watch;
use crate::error::SolveError;
use crate::smooth::{Phase, Precision, Progress};
use crate::solve::{CholeskyAnalysis, gram};

/// A or AᵀWA, its analysis, and the last factor.
#[derive(Debug)]
pub(super) struct RealRoute {
    /// The values on the pattern that was analysed.
    values: Vec<f64>,
    factors: Factors<f64, f32>,
}

impl RealRoute {
    pub(super) fn new(task: &Task<'_>) -> Result<Self, SolveError> {
        let Problem { matrix, order, weights, .. } = task.problem;
        let system = match (order, weights) {
            (Order::First, _) => matrix.clone(),
            (Order::Squared, None) => gram(matrix, &Watch::none())?,
            (Order::Squared, Some(weights)) => {
                let mut scaled = matrix.clone();
                let (_, rows, values) = scaled.csc_data_mut();
                rows.iter().zip(values).for_each(|(&row, value)| *value *= weights[row].sqrt());
                gram(&scaled, &Watch::none())?
            }
        };
        let (pattern, values) = system.into_pattern_and_values();
        let analysis = CholeskyAnalysis::new(pattern, &Watch::none())?;
        Ok(Self { values, factors: Factors::new(analysis) })
    }

    pub(super) fn drop_factor(&mut self) {
        self.factors.drop_factor();
    }

    pub(super) fn solve(
        &mut self,
        task: &Task<'_>,
        precision: Precision,
        progress: Progress<'_>,
    ) -> Result<Answer, SolveError> {
        let values = |analysis: &CholeskyAnalysis| values(&self.values, analysis.pattern(), &task.problem);
        let factor = self.factors.take(task.key, precision, &values, progress)?;
        progress(Phase::Solve, 0.9);
        let n = task.problem.unknowns();
        let iterates = refine(Refinement {
            count: task.loads.len(),
            length: n,
            tolerance: task.tolerance(precision),
            inverse_norm: None,
            residual: &|c, x| task.problem.residual(&task.loads[c], x),
            solve: &mut |b, _| factor.solve(b),
        })?;
        let eigenvalue = match task.manner.bounds {
            true => smallest_eigenvalue(&task.problem, &mut |b| factor.solve(b)),
            false => None,
        };
        Ok(self.factors.answer(task.key, factor, iterates, "cholesky", eigenvalue))
    }
}

/// The values of A, or of AᵀWA/scale + εB on the pattern of AᵀA, which holds that of B.
fn values(matrix: &[f64], pattern: &SparsityPattern, problem: &Problem<'_>) -> Vec<f64> {
    let mut values: Vec<f64> = matrix.iter().map(|value| value / problem.scale).collect();
    let Some(Pull { mass, epsilon }) = problem.pull else { return values };
    for j in 0..pattern.major_dim() {
        let start = pattern.major_offsets()[j];
        let rows = pattern.lane(j);
        if let Mass::Matrix(matrix) = mass {
            let column = matrix.col(j);
            let mut place = 0;
            for (&row, &value) in column.row_indices().iter().zip(column.values()) {
                while rows[place] < row {
                    place += 1;
                }
                values[start + place] += epsilon * value;
            }
        } else if let Ok(place) = rows.binary_search(&j) {
            values[start + place] += epsilon * mass.diagonal(j);
        }
    }
    values
}
