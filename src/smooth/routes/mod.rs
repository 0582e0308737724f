//! The ways to solve a system of smoothing, and the choice between them.
//!
//! | route | for | costs |
//! | --- | --- | --- |
//! | `complexCholesky` | a symmetric L with B = I (eq. 3), and the finite-element operator | a complex factor on the pattern of L |
//! | `cholesky` | everything | a real factor on the pattern of LᵀL, of L for harmonic interpolation |
//! | `cgComplexCholesky` | eq. (5) with a symmetric L, when LᵀL is large | a complex factor on the pattern of L, some iterations |
//! | `cgMultigrid` | a symmetric L, when no factor fits | iterations in little memory |
//! | `cgJacobi` | everything | little memory, many iterations for small ε |

mod complex;
mod eigenvalue;
mod factors;
mod iterative;
mod problem;
mod real;
mod refine;

use super::{Phase, Precision, Progress, SolverChoice};
use crate::error::SolveError;
use complex::ComplexRoute;
pub(super) use problem::{Inner, Load, Mass, Order, Problem, Pull, difference};
use real::RealRoute;
use refine::Iterate;

/// From about this many unknowns on, conjugate gradients with the complex factor should beat the factor of LᵀL, whose cost
/// grows faster: estimated from the times of both at 100,000 and 1,000,000 vertices (benches/README.md).
const LARGE: usize = 400_000;
/// Relative errors that refinement stops at: far below every use of the result, and above what a step could still mend.
const DOUBLE: f64 = 1e-16;
const SINGLE: f64 = 1e-13;

/// What a factor belongs to: ε, and which of the matrices B.
pub(super) type Key = (f64, u32);

/// How to solve, whatever the system.
#[derive(Debug, Clone, Copy)]
pub(super) struct Manner {
    pub(super) choice: SolverChoice,
    pub(super) precision: Precision,
    /// Whether L is symmetric.
    pub(super) symmetric: bool,
    /// Whether the smallest eigenvalue is wanted, too.
    pub(super) bounds: bool,
}

/// One call.
pub(super) struct Task<'a> {
    pub(super) problem: Problem<'a>,
    pub(super) key: Key,
    /// One per channel.
    pub(super) loads: &'a [Load],
    pub(super) manner: Manner,
}

/// Solutions, one per channel, and where they come from.
pub(super) struct Answer {
    pub(super) iterates: Vec<Iterate>,
    pub(super) route: &'static str,
    pub(super) precision: &'static str,
    pub(super) factor_nonzeros: u64,
    /// A lower bound of the smallest eigenvalue of the system's matrix, where it was asked for and could be found.
    pub(super) smallest_eigenvalue: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Route {
    ComplexCholesky,
    Cholesky,
    CgComplexCholesky,
    Iterative,
}

/// Analyses and factors, kept for the next call.
#[derive(Debug, Default)]
pub(super) struct Routes {
    real: Option<RealRoute>,
    complex: Option<ComplexRoute>,
    /// What solved the last system, and whether it did so after single precision had failed.
    last: Option<(Key, Route, &'static str)>,
}

impl Task<'_> {
    /// The routes to try, the best one first.
    fn candidates(&self) -> &'static [Route] {
        let large = self.problem.unknowns() >= LARGE;
        // Where the product (L + iD) W (L − iD) is near the system, if not the system itself.
        let paired = self.problem.pull.is_some() && self.problem.inner.is_some();
        match (self.manner.choice, self.problem.splits) {
            (SolverChoice::ConjugateGradient, _) => &[Route::Iterative],
            (SolverChoice::Cholesky, true) => &[Route::ComplexCholesky],
            (SolverChoice::Cholesky, false) => &[Route::Cholesky],
            (SolverChoice::Auto, true) => &[Route::ComplexCholesky, Route::Iterative],
            (SolverChoice::Auto, false) if !paired || self.problem.weights.is_some() => {
                &[Route::Cholesky, Route::Iterative]
            }
            // A real factor in single precision hardly ever refines: the condition number of LᵀL is that of L squared.
            (SolverChoice::Auto, false) if large || self.manner.precision == Precision::Single => {
                &[Route::CgComplexCholesky, Route::Cholesky, Route::Iterative]
            }
            (SolverChoice::Auto, false) => &[Route::Cholesky, Route::CgComplexCholesky, Route::Iterative],
        }
    }

    /// The diagonal D of the second-order operator that the routes for a symmetric L are made from, DWD ≈ εB: √ε·B where the
    /// system splits, else √(ε·b/w) with the row sums b of B.
    pub(super) fn shift(&self) -> Vec<f64> {
        let n = self.problem.unknowns();
        let Some(Pull { mass, .. }) = self.problem.pull else { return vec![0.0; n] };
        let root = self.key.0.sqrt();
        let sums = match mass {
            Mass::Identity => return vec![root; n],
            Mass::Diagonal(masses) if self.problem.splits => return masses.iter().map(|m| root * m).collect(),
            Mass::Diagonal(masses) => masses.clone(),
            // The rows of the Galerkin mass matrix sum to the lumped masses.
            Mass::Matrix(_) => mass.times(&vec![1.0; n]),
        };
        let weight = |i: usize| self.problem.weights.map_or(1.0, |weights| weights[i]);
        sums.iter().enumerate().map(|(i, b)| root * (b / weight(i)).sqrt()).collect()
    }

    /// Refines to the accuracy of the precision.
    pub(super) fn tolerance(&self, precision: Precision) -> f64 {
        if precision == Precision::Single { SINGLE } else { DOUBLE }
    }
}

impl Routes {
    /// Tries the routes in turn: the next one where memory is short or a factor is not good enough. The first failure is
    /// the one reported.
    pub(super) fn solve(&mut self, task: &Task<'_>, progress: Progress<'_>) -> Result<Answer, SolveError> {
        if task.problem.unknowns() == 0 {
            let iterates = vec![Iterate::default(); task.loads.len()];
            return Ok(Answer {
                iterates,
                route: "none",
                precision: "double",
                factor_nonzeros: 0,
                smallest_eigenvalue: None,
            });
        }
        // The same system again, with its factor at hand: what failed the last time would fail again.
        if let Some((key, route, precision)) = self.last.take().filter(|(key, ..)| *key == task.key) {
            let tried = if precision == "single" { Precision::Single } else { Precision::Double };
            if route != Route::Iterative
                && let Ok(answer) = self.factored(route, task, tried, progress)
            {
                self.last = Some((key, route, precision));
                return Ok(Answer { precision, ..answer });
            }
        }
        let mut first_failure = None;
        for &route in task.candidates() {
            // Iterations hardly go where a factor did not; they only need less memory. But where nothing pulls, it is the square
            // that a factor fails at, and multigrid has the root of it.
            let by_root = task.problem.pull.is_none() && task.problem.inner.is_some();
            let hopeless =
                !by_root && first_failure.as_ref().is_some_and(|f| !matches!(f, SolveError::OutOfMemory { .. }));
            if route == Route::Iterative && hopeless {
                break;
            }
            match self.by(route, task, progress) {
                Err(failure) => {
                    first_failure.get_or_insert(failure);
                }
                Ok(answer) => {
                    self.last = Some((task.key, route, answer.precision));
                    return Ok(answer);
                }
            }
        }
        Err(first_failure.unwrap_or(SolveError::PatternMismatch {}))
    }

    /// Gives the memory of the last factors back.
    pub(super) fn drop_factors(&mut self) {
        self.complex.iter_mut().for_each(ComplexRoute::drop_factor);
        self.real.iter_mut().for_each(RealRoute::drop_factor);
    }

    fn by(&mut self, route: Route, task: &Task<'_>, progress: Progress<'_>) -> Result<Answer, SolveError> {
        if route == Route::Iterative {
            *self = Self::default();
            progress(Phase::Solve, 0.1);
            return iterative::solve(task);
        }
        if task.manner.precision == Precision::Single {
            match self.factored(route, task, Precision::Single, progress) {
                Ok(answer) => return Ok(answer),
                // Single precision was not enough for this matrix.
                Err(
                    SolveError::NotPositiveDefinite { .. }
                    | SolveError::NotConverged { .. }
                    | SolveError::NonFiniteEntry { .. },
                ) => {}
                Err(other) => return Err(other),
            }
            let answer = self.factored(route, task, Precision::Double, progress)?;
            return Ok(Answer { precision: "doubleAfterSingle", ..answer });
        }
        self.factored(route, task, Precision::Double, progress)
    }

    fn factored(
        &mut self,
        route: Route,
        task: &Task<'_>,
        precision: Precision,
        progress: Progress<'_>,
    ) -> Result<Answer, SolveError> {
        // One factor at a time: each can take most of the memory, and where it does, the analysis must go too. An error
        // leaves the analysis, which stays valid.
        let large = task.problem.unknowns() >= LARGE;
        if route == Route::Cholesky {
            self.complex = self.complex.take().filter(|_| !large);
            self.complex.iter_mut().for_each(ComplexRoute::drop_factor);
            analysed(&mut self.real, || RealRoute::new(task), progress)?.solve(task, precision, progress)
        } else {
            self.real = self.real.take().filter(|_| !large);
            self.real.iter_mut().for_each(RealRoute::drop_factor);
            analysed(&mut self.complex, || ComplexRoute::new(task), progress)?.solve(task, precision, progress)
        }
    }
}

/// What is there, or is made now.
fn analysed<'a, T>(
    slot: &'a mut Option<T>,
    make: impl FnOnce() -> Result<T, SolveError>,
    progress: Progress<'_>,
) -> Result<&'a mut T, SolveError> {
    match slot {
        Some(there) => Ok(there),
        none => {
            progress(Phase::Analysis, 0.0);
            Ok(none.insert(make()?))
        }
    }
}
