//! The real route: the Cholesky factor of A, or of AᵀWA/scale + εB, refined with the residual in factored form.

use nalgebra_sparse::pattern::SparsityPattern;

use super::eigenvalue::smallest_eigenvalue;
use super::factors::{Factor, Factors};
use super::iterative;
use super::problem::Form;
use super::problem::Problem;
use super::refine::{Refinement, refine};
use super::task::{Answer, FactorKey, Task};
use crate::error::SolveError;
use crate::smooth::Precision;
use crate::smooth::data_term::Mass;
use crate::smooth::names::Route;
use crate::smooth::schedule::Stages;
use crate::solve::{CholeskyAnalysis, CholeskyFactor, Preconditioner, gram};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// The shares of assembling the matrix and of analysing its pattern.
const STEPS: [(Phase, f64); 2] = [(Phase::Analysis, 1.0), (Phase::Analysis, 5.0)];

/// A or AᵀWA, its analysis, and the last factor.
#[derive(Debug)]
pub(super) struct RealRoute {
    /// The values on the pattern that was analysed.
    values: Vec<f64>,
    factors: Factors<f64, f32>,
}

/// The matrix AᵀWA/scale + εB, its analysis, and the memory of a factor.
pub(in crate::smooth) struct Square {
    pub(in crate::smooth) analysis: CholeskyAnalysis,
    /// On the pattern that was analysed.
    pub(in crate::smooth) values: Vec<f64>,
    pub(in crate::smooth) factor: Option<CholeskyFactor<f64>>,
    /// Whether that is the factor of this matrix.
    pub(in crate::smooth) is_current: bool,
}

impl RealRoute {
    pub(super) fn new(task: &Task<'_>, watch: &Watch<'_>) -> Result<Self, SolveError> {
        let mut plan = watch.plan(&STEPS);
        plan.begin(0)?;
        let Problem { matrix, form } = task.problem;
        memory::ensure(((size_of::<usize>() + size_of::<f64>()) * matrix.nnz() + 16 * matrix.ncols()) as u64)?;
        let system = match form {
            Form::Symmetric => matrix.clone(),
            Form::Normal { weights: None, .. } | Form::Regularized { weights: None, .. } => gram(matrix, watch)?,
            Form::Normal { weights: Some(weights), .. } | Form::Regularized { weights: Some(weights), .. } => {
                let mut scaled = matrix.clone();
                let (_, rows, values) = scaled.csc_data_mut();
                rows.iter().zip(values).for_each(|(&row, value)| *value *= weights[row].sqrt());
                gram(&scaled, watch)?
            }
        };
        let (pattern, values) = system.into_pattern_and_values();
        plan.begin(0)?;
        let analysis = CholeskyAnalysis::new(pattern, watch)?;
        Ok(Self { values, factors: Factors::new(analysis) })
    }

    /// Gives away the matrix of a system, and the factor.
    pub(super) fn square(&mut self, task: &Task<'_>) -> Result<Square, SolveError> {
        let analysis = self.factors.analysis().clone();
        memory::ensure(size_of_val(&*self.values) as u64)?;
        let values = values(&self.values, analysis.pattern(), &task.problem);
        let is_current = self.factors.has(task.key);
        Ok(Square { analysis, values, factor: self.factors.take_double(), is_current })
    }

    /// Takes the factor of a system back.
    pub(super) fn keep(&mut self, key: &FactorKey, factor: CholeskyFactor<f64>) {
        self.factors.keep(key, Factor::Double(factor));
    }

    /// Whether the last factor has this key.
    pub(super) fn has(&self, key: &FactorKey) -> bool {
        self.factors.has(key)
    }

    pub(super) fn drop_factor(&mut self) {
        self.factors.drop_factor();
    }

    pub(super) fn solve(
        &mut self,
        task: &Task<'_>,
        precision: Precision,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Answer, SolveError> {
        let values = |analysis: &CholeskyAnalysis| values(&self.values, analysis.pattern(), &task.problem);
        let factor = self.factors.take(task.key, precision, &values, stages)?;
        stages.begin(Phase::Solve, 0)?;
        let watch = stages.watch;
        let precise = |c: usize, x: &[f64]| task.problem.precise_residual(&task.right_hand_sides[c], x);
        let refinement = Refinement {
            count: task.right_hand_sides.len(),
            length: task.problem.unknowns(),
            tolerance: task.tolerance(precision),
            start: None,
            inverse_norm: None,
            ticks: task.problem.ticks(),
            residual: &|c, x| task.problem.residual(&task.right_hand_sides[c], x),
            // A factor in single precision gives way to one in double.
            precise: if precision == Precision::Double { Some(&precise) } else { None },
            solve: &mut |b, _| factor.solve(b, watch),
        };
        let iterates = refine(refinement, watch)?;
        let eigenvalue = match task.settings.bounds {
            true => smallest_eigenvalue(&task.problem, &mut |b| factor.solve(b, watch), watch)?,
            false => None,
        };
        Ok(self.factors.answer(task.key, factor, iterates, Route::Cholesky, eigenvalue))
    }

    /// Solves by conjugate gradients where rounding took a pivot, or refinement with the factor stalls: preconditioned by the factor with
    /// such pivots raised, and with the matrix in factored form, whose rounding is that of A and not of its square.
    pub(super) fn solve_raised(&mut self, task: &Task<'_>, stages: &mut Stages<'_, '_>) -> Result<Answer, SolveError> {
        let values = |analysis: &CholeskyAnalysis| values(&self.values, analysis.pattern(), &task.problem);
        let factor = self.factors.take_raised(task.key, &values, stages)?;
        stages.begin(Phase::Solve, 0)?;
        let watch = stages.watch;
        let nearby = Nearby { factor: &factor, size: task.problem.unknowns() };
        iterative::check_regular(task, &nearby, watch)?;
        let iterates = iterative::refined_nearby(task, &nearby, watch)?;
        let eigenvalue = iterative::eigenvalue(task, &nearby, watch)?;
        Ok(self.factors.answer_raised(task.key, factor, iterates, eigenvalue))
    }

    /// See [`Factors::ticks`].
    pub(super) fn ticks(&self, single: bool) -> u64 {
        self.factors.ticks(single)
    }
}

/// The inverse of a matrix nearby.
struct Nearby<'a> {
    factor: &'a Factor<f64, f32>,
    size: usize,
}

impl Preconditioner for Nearby<'_> {
    fn size(&self) -> usize {
        self.size
    }

    fn apply(&self, r: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        self.factor.solve(r, watch)
    }
}

/// The values of A, or of AᵀWA/scale + εB on the pattern of AᵀA, which holds that of B.
fn values(matrix: &[f64], pattern: &SparsityPattern, problem: &Problem<'_>) -> Vec<f64> {
    let scale = problem.scale();
    let mut values: Vec<f64> = matrix.iter().map(|value| value / scale).collect();
    let Some(data) = problem.data() else { return values };
    let (mass, epsilon) = (data.mass, data.scaled_epsilon());
    for j in 0..pattern.major_dim() {
        let start = pattern.major_offsets()[j];
        let rows = pattern.lane(j);
        if let Mass::Matrix(matrix) | Mass::Partial(matrix) = mass {
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
