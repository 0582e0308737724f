//! The real route: the Cholesky factor of LᵀWL/scale + εB, refined with the residual in factored form.

use nalgebra_sparse::pattern::SparsityPattern;

use super::factors::Factors;
use super::refine::{Refinement, refine};
use super::routes::{Answer, Task};
use super::system::{Mass, Problem};
use super::{Phase, Precision, Progress};
use crate::error::SolveError;
use crate::solve::{CholeskyAnalysis, gram};

/// LᵀL, its analysis, and the last factor.
#[derive(Debug)]
pub(super) struct RealRoute {
    /// The values of LᵀL on the pattern that was analysed.
    gram: Vec<f64>,
    factors: Factors<f64, f32>,
}

impl RealRoute {
    pub(super) fn new(task: &Task<'_>) -> Result<Self, SolveError> {
        let (pattern, gram) = gram(task.problem.laplacian)?.into_pattern_and_values();
        let analysis = CholeskyAnalysis::new(pattern)?;
        Ok(Self { gram, factors: Factors::new(analysis) })
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
        let values = |analysis: &CholeskyAnalysis| values(&self.gram, analysis.pattern(), &task.problem);
        let factor = self.factors.take(task.key, precision, &values, progress)?;
        progress(Phase::Solve, 0.9);
        let n = task.problem.unknowns();
        let iterates = refine(Refinement {
            count: task.fields.len(),
            length: n,
            tolerance: task.tolerance(precision),
            residual: &|c, x| task.problem.residual(&task.fields[c], x),
            solve: &mut |b, _| factor.solve(b),
        })?;
        Ok(self.factors.answer(task.key, factor, iterates, "cholesky"))
    }
}

/// The values of (LᵀL)/scale + εB on the pattern of LᵀL, which holds that of B.
fn values(gram: &[f64], pattern: &SparsityPattern, problem: &Problem<'_>) -> Vec<f64> {
    let mut values: Vec<f64> = gram.iter().map(|value| value / problem.scale).collect();
    for j in 0..pattern.major_dim() {
        let start = pattern.major_offsets()[j];
        let rows = pattern.lane(j);
        if let Mass::Matrix(matrix) = problem.mass {
            let column = matrix.col(j);
            let mut place = 0;
            for (&row, &value) in column.row_indices().iter().zip(column.values()) {
                while rows[place] < row {
                    place += 1;
                }
                values[start + place] += problem.epsilon * value;
            }
        } else if let Ok(place) = rows.binary_search(&j) {
            values[start + place] += problem.epsilon * problem.mass.diagonal(j);
        }
    }
    values
}
