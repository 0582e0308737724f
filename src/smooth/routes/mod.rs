//! The ways to solve a system of smoothing, and the choice between them.
//!
//! | route | for | costs |
//! | --- | --- | --- |
//! | `complexCholesky` | a symmetric L with B = I (eq. 3), and the finite-element operator | a complex factor on the pattern of L |
//! | `cholesky` | everything | a real factor on the pattern of LᵀL, of L for harmonic interpolation |
//! | `cgComplexCholesky` | eq. (5) with a symmetric L, when LᵀL is large | a complex factor on the pattern of L, some iterations |
//! | `cgCholesky` | where rounding takes a pivot of LᵀL | a real factor of a matrix nearby, some iterations |
//! | `cgMultigrid` | a symmetric L, when no factor fits | iterations in little memory |
//! | `cgJacobi` | everything | little memory, many iterations for small ε |

mod complex;
mod eigenvalue;
mod factors;
mod iterative;
mod problem;
mod real;
mod refine;
mod task;

use super::names::{Route, UsedPrecision};
use super::schedule::{Stages, Work};
use super::{Precision, SolverChoice};
use crate::error::SolveError;
use crate::solve::CholeskyFactor;
use crate::support::watch::{Phase, Watch};
use complex::ComplexFactors;
pub(super) use problem::{DataPart, Form, Problem, RightHandSide, SymmetricPart, Symmetry, difference};
use real::RealRoute;
pub(super) use real::Square;
use refine::Iterate;
pub(super) use task::{Accuracy, Answer, FactorKey, Solutions, SolverSettings, Task};

/// From about this many unknowns on, conjugate gradients with the complex factor should beat the factor of LᵀL for a solution or two:
/// the cost of that factor grows faster. Estimated from the times of both at 100,000 and 1,000,000 vertices (benches/README.md).
pub(super) const LARGE: usize = 400_000;

/// A factor that takes so many times as long as iterations for the right-hand sides at hand is not computed: the estimates of both are
/// rough, and the factor serves the next call, too.
const DEAR: u64 = 4;
/// So many times the solutions at hand are wanted of it where there are to be many.
const MANY: u64 = 6;

/// Iterations that are tried after a factor failed may take so many times as long as it, and so many ticks for each unknown: about as long
/// as all that was done before, a few times.
const PATIENCE: u64 = 3;
const PATIENCE_PER_UNKNOWN: u64 = 10_000;

/// A way to try: one that has a factor, or iterations without.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Complex,
    Real,
    ComplexIterations,
    /// Iterations with the factor of [`Way::Real`], whose lost pivots are raised.
    Raised,
    Iterations,
}

/// What solved a system.
#[derive(Debug, Clone)]
struct Solver {
    key: FactorKey,
    way: Way,
    precision: UsedPrecision,
    /// How many solutions the way was chosen for.
    solutions: Solutions,
}

impl Solver {
    /// Whether it is the one for such a system, too.
    fn serves(&self, key: &FactorKey, settings: SolverSettings) -> bool {
        self.key == *key && self.solutions >= settings.solutions
    }
}

/// Analyses and factors, kept for the next call.
#[derive(Debug, Default)]
pub(super) struct Routes {
    real: Option<RealRoute>,
    complex: Option<ComplexFactors>,
    /// What solved the last system.
    last: Option<Solver>,
    /// How long the factor of a way takes that was not computed for that.
    dear: Option<(Way, u64)>,
}

/// The ways to try, the best one first.
fn ways(problem: &Problem<'_>, settings: SolverSettings) -> (Way, &'static [Way]) {
    // Where some unknowns are beyond the data term, the product is a rough preconditioner, with hundreds of iterations.
    let is_rough = problem.data().is_some_and(|data| data.mass.has_gaps());
    let is_squaring_dear = problem.unknowns() >= LARGE && settings.solutions == Solutions::Few && !is_rough;
    // Where the product (A + iD) W (A − iD) is near the system, if not the system itself.
    let is_near_product = problem.data().is_some() && problem.symmetric_part().is_some();
    match (settings.choice, problem.is_product()) {
        (SolverChoice::ConjugateGradient, _) => (Way::Iterations, &[]),
        (SolverChoice::Cholesky, true) => (Way::Complex, &[]),
        (SolverChoice::Cholesky, false) => (Way::Real, &[Way::Raised]),
        (SolverChoice::Auto, true) => (Way::Complex, &[Way::Iterations]),
        (SolverChoice::Auto, false) if !is_near_product || problem.weights().is_some() => {
            (Way::Real, &[Way::Raised, Way::Iterations])
        }
        // A real factor in single precision hardly ever refines: the condition number of LᵀL is that of L squared.
        (SolverChoice::Auto, false) if is_squaring_dear || settings.precision == Precision::Single => {
            (Way::ComplexIterations, &[Way::Real, Way::Raised, Way::Iterations])
        }
        (SolverChoice::Auto, false) => (Way::Real, &[Way::ComplexIterations, Way::Raised, Way::Iterations]),
    }
}

impl Routes {
    /// What solving is expected to be, and whether it takes an analysis and a factorisation.
    pub(super) fn forecast(
        &self,
        problem: &Problem<'_>,
        key: &FactorKey,
        settings: SolverSettings,
    ) -> (Work, bool, bool) {
        let (best, _) = ways(problem, settings);
        let way = self.last.as_ref().filter(|last| last.serves(key, settings)).map_or(best, |last| last.way);
        let complex = (self.complex.is_none(), !self.complex.as_ref().is_some_and(|factors| factors.has(key)));
        let real = (self.real.is_none(), !self.real.as_ref().is_some_and(|route| route.has(key)));
        match way {
            Way::Complex => (Work::FactorOfLaplacian, complex.0, complex.1),
            Way::ComplexIterations => (Work::PreconditionedByFactor, complex.0, complex.1),
            Way::Real if matches!(problem.form, Form::Symmetric) => (Work::FactorOfLaplacian, real.0, real.1),
            Way::Real => (Work::FactorOfSquare, real.0, real.1),
            Way::Raised => (Work::FactorOfSquare, real.0, true),
            Way::Iterations => (Work::Iterations, false, false),
        }
    }

    /// Tries the ways in turn: the next one where memory is short or a factor is not good enough. The first failure is
    /// the one reported. Being stopped is no reason to try another way.
    pub(super) fn solve(&mut self, task: &Task<'_>, stages: &mut Stages<'_, '_>) -> Result<Answer, SolveError> {
        if task.problem.unknowns() == 0 {
            return Ok(Answer {
                iterates: vec![Iterate::default(); task.right_hand_sides.len()],
                route: Route::None,
                precision: UsedPrecision::Double,
                factor_nonzeros: 0,
                smallest_eigenvalue: None,
            });
        }
        // The same system again, with its factor at hand: what failed the last time would fail again.
        let last = self.last.take().filter(|last| last.serves(task.key, task.settings) && last.way != Way::Iterations);
        if let Some(last) = last {
            let tried = if last.precision == UsedPrecision::Single { Precision::Single } else { Precision::Double };
            match self.factored(last.way, task, tried, stages) {
                Ok(answer) => {
                    let precision = last.precision;
                    self.last = Some(last);
                    return Ok(Answer { precision, ..answer });
                }
                Err(SolveError::Cancelled {}) => return Err(SolveError::Cancelled {}),
                Err(_) => {}
            }
        }
        let (best, others) = ways(&task.problem, task.settings);
        if others.contains(&Way::Iterations) && self.is_dear(best, task, stages) {
            match self.by(Way::Iterations, task, stages) {
                Err(SolveError::Cancelled {}) => return Err(SolveError::Cancelled {}),
                Err(_) => {}
                solved => return solved,
            }
        }
        let first_failure = match self.by(best, task, stages) {
            Err(failure) => failure,
            solved => return solved,
        };
        // Iterations hardly go where a factor did not; they only need less memory. But where there is no data term, it is the
        // square that a factor fails at, and multigrid has the root of it.
        let by_root = task.problem.data().is_none() && task.problem.symmetric_part().is_some();
        let is_short = matches!(first_failure, SolveError::OutOfMemory { .. });
        let budget = (!is_short).then(|| self.budget(task));
        for &way in others {
            let is_hopeless = match way {
                Way::Iterations => !by_root && !is_short,
                // A factor that there is no room for.
                Way::Raised => is_short,
                _ => false,
            };
            if matches!(first_failure, SolveError::Cancelled {}) {
                break;
            }
            if is_hopeless {
                continue;
            }
            let outcome = match budget {
                Some(budget) if way == Way::Iterations => stages.watch.within(budget, || self.by(way, task, stages)),
                _ => self.by(way, task, stages),
            };
            match outcome {
                Err(SolveError::Cancelled {}) => return Err(SolveError::Cancelled {}),
                Err(_) => {}
                solved => return solved,
            }
        }
        Err(first_failure)
    }

    /// The matrix of a regularised system with its analysis, and the last factor in double precision, whose memory can be used again.
    pub(super) fn square(&mut self, task: &Task<'_>, watch: &Watch<'_>) -> Result<Square, SolveError> {
        self.last = None;
        self.complex.iter_mut().for_each(ComplexFactors::drop_factor);
        match &mut self.real {
            Some(real) => real.square(task),
            none => none.insert(RealRoute::new(task, watch)?).square(task),
        }
    }

    /// Takes back the factor that [`Routes::square`] gave away, or one that was computed in its place.
    pub(super) fn keep(&mut self, key: &FactorKey, factor: CholeskyFactor<f64>) {
        if let Some(real) = &mut self.real {
            real.keep(key, factor);
        }
    }

    /// Whether a way's factor takes far longer than iterations would, as on meshes that are no surfaces: its size is known once the pattern
    /// is analysed.
    fn is_dear(&mut self, way: Way, task: &Task<'_>, stages: &mut Stages<'_, '_>) -> bool {
        let Some(iterations) = iterative::ticks(&task.problem) else { return false };
        let single = task.settings.precision == Precision::Single;
        let ticks = match self.dear.filter(|known| known.0 == way) {
            Some((_, ticks)) => Ok(ticks),
            None if matches!(way, Way::Real | Way::Raised) => {
                self.real_route(task, stages).map(|route| route.ticks(single))
            }
            None => self.complex_factors(task, stages).map(|factors| factors.ticks(single)),
        };
        // A pattern that cannot be analysed fails as soon as the way is gone.
        let Ok(ticks) = ticks else { return false };
        let times = if task.settings.solutions == Solutions::Many { MANY } else { 1 };
        let is_dear = ticks > DEAR * times * iterations * task.right_hand_sides.len() as u64;
        self.dear = is_dear.then_some((way, ticks));
        is_dear
    }

    /// How long iterations may take where a factor failed, in ticks: a system that is too much for its factor can be so for them, too, and
    /// they would not end.
    fn budget(&self, task: &Task<'_>) -> u64 {
        let factor = self.real.as_ref().map_or(0, |route| route.ticks(false));
        PATIENCE * factor + PATIENCE_PER_UNKNOWN * task.problem.unknowns() as u64
    }

    /// Gives the memory of the last factors back.
    pub(super) fn drop_factors(&mut self) {
        self.complex.iter_mut().for_each(ComplexFactors::drop_factor);
        self.real.iter_mut().for_each(RealRoute::drop_factor);
    }

    /// Solves in one way, and remembers it.
    fn by(&mut self, way: Way, task: &Task<'_>, stages: &mut Stages<'_, '_>) -> Result<Answer, SolveError> {
        let answer = self.tried(way, task, stages)?;
        let solutions = task.settings.solutions;
        self.last = Some(Solver { key: task.key.clone(), way, precision: answer.precision, solutions });
        Ok(answer)
    }

    fn tried(&mut self, way: Way, task: &Task<'_>, stages: &mut Stages<'_, '_>) -> Result<Answer, SolveError> {
        if way == Way::Iterations {
            *self = Self { dear: self.dear, ..Self::default() };
            stages.begin(Phase::Solve, 0)?;
            return iterative::solve(task, stages.watch);
        }
        if task.settings.precision == Precision::Single {
            // Single precision has no pivots that can be raised.
            let single = (way != Way::Raised).then(|| self.factored(way, task, Precision::Single, stages));
            match single.unwrap_or(Err(SolveError::NotConverged { iterations: 0, residual: 1.0 })) {
                Ok(answer) => return Ok(answer),
                // Single precision was not enough for this matrix.
                Err(
                    SolveError::NotPositiveDefinite { .. }
                    | SolveError::NotConverged { .. }
                    | SolveError::NonFiniteEntry { .. },
                ) => {}
                Err(other) => return Err(other),
            }
            let answer = self.factored(way, task, Precision::Double, stages)?;
            return Ok(Answer { precision: UsedPrecision::DoubleAfterSingle, ..answer });
        }
        self.factored(way, task, Precision::Double, stages)
    }

    fn factored(
        &mut self,
        way: Way,
        task: &Task<'_>,
        precision: Precision,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Answer, SolveError> {
        match way {
            Way::Raised => self.real_route(task, stages)?.solve_raised(task, stages),
            Way::Real => self.real_route(task, stages)?.solve(task, precision, stages),
            _ => complex::solve(self.complex_factors(task, stages)?, task, precision, stages),
        }
    }

    // One factor at a time: each can take most of the memory, and where it does, the analysis must go too. An error leaves the analysis,
    // which stays valid.

    /// The analysis of the real route, and no other factor.
    fn real_route(&mut self, task: &Task<'_>, stages: &mut Stages<'_, '_>) -> Result<&mut RealRoute, SolveError> {
        self.complex = self.complex.take().filter(|_| task.problem.unknowns() < LARGE);
        self.complex.iter_mut().for_each(ComplexFactors::drop_factor);
        analysed(&mut self.real, &|watch| RealRoute::new(task, watch), stages)
    }

    /// The analysis of the complex routes, and no other factor.
    fn complex_factors(
        &mut self,
        task: &Task<'_>,
        stages: &mut Stages<'_, '_>,
    ) -> Result<&mut ComplexFactors, SolveError> {
        self.real = self.real.take().filter(|_| task.problem.unknowns() < LARGE);
        self.real.iter_mut().for_each(RealRoute::drop_factor);
        analysed(&mut self.complex, &|watch| complex::analyse(task, watch), stages)
    }
}

/// What is there, or is made now.
fn analysed<'a, T>(
    slot: &'a mut Option<T>,
    make: &dyn Fn(&Watch<'_>) -> Result<T, SolveError>,
    stages: &mut Stages<'_, '_>,
) -> Result<&'a mut T, SolveError> {
    match slot {
        Some(there) => Ok(there),
        none => {
            stages.begin(Phase::Analysis, 0)?;
            Ok(none.insert(make(stages.watch)?))
        }
    }
}
