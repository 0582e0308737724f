//! The routes without a factor of the system: conjugate gradients with the matrix in factored form.

use super::eigenvalue::smallest_eigenvalue;
use super::problem::{Form, Problem, SymmetricPart};
use super::refine::{Iterate, Refinement, Residual, refine};
use super::task::{Answer, Task};
use crate::error::{Cancelled, SolveError};
use crate::smooth::Precision;
use crate::smooth::names::{Route, UsedPrecision};
use crate::solve::{CgOptions, Jacobi, Multigrid, Preconditioner, SquaredSum, conjugate_gradient, conjugate_steps};
use crate::support::random::Random;
use crate::support::watch::{Phase, Watch};

/// Relative residual of each solution by conjugate gradients: within reach of double precision for every system that
/// refinement can solve; refinement makes up the rest.
const CG_TOLERANCE: f64 = 1e-6;
/// Relative residual that is taken for converged where rounding allows no less.
const ROUGH_RESIDUAL: f64 = 0.5;
/// A good preconditioner takes ten to twenty iterations; past this many, rounding prevails.
const MOST_PRECONDITIONED: usize = 200;
/// Where some unknowns are beyond the data term, the preconditioner is a rough one, and takes more the larger the mesh is.
const MOST_ROUGHLY_PRECONDITIONED: usize = 2000;
/// The inner tolerance of a second attempt.
const TIGHT: f64 = 1e-8;

/// The shares of making a preconditioner, of the solution, and of another attempt or of an eigenvalue.
const STEPS: [(Phase, f64); 3] = [(Phase::Solve, 1.0), (Phase::Solve, 8.0), (Phase::Solve, 4.0)];

/// What iterations that multigrid preconditions take for each entry of the matrix, making it included: twice as many inner ones for the
/// square root of a regularised system, in a dozen outer ones (measured on meshes of 10,000 to 1,000,000 vertices).
const TICKS_PER_ENTRY: u64 = 1_200;
const TICKS_PER_ENTRY_OF_ROOT: u64 = 4_600;

/// About how long iterations for one right-hand side take, in ticks, where the data reach all unknowns and multigrid is sure to do.
pub(super) fn ticks(problem: &Problem<'_>) -> Option<u64> {
    let each = match problem.form {
        Form::Symmetric => TICKS_PER_ENTRY,
        Form::Normal { .. } => return None,
        Form::Regularized { data, .. } if data.mass.has_gaps() => return None,
        Form::Regularized { .. } => TICKS_PER_ENTRY_OF_ROOT,
    };
    problem.symmetric_part().map(|part| each * part.matrix.nnz() as u64)
}

/// Solves with the best preconditioner that needs little memory.
pub(super) fn solve(task: &Task<'_>, watch: &Watch<'_>) -> Result<Answer, SolveError> {
    if let Some(outcome) = by_multigrid(task, watch) {
        return outcome;
    }
    let jacobi = Jacobi::new(&task.problem.diagonal())?;
    let iterates = refined_within(task, &jacobi, CgOptions::default().max_iterations, watch)?;
    answer(task, &jacobi, iterates, Route::CgJacobi, watch)
}

fn answer(
    task: &Task<'_>,
    preconditioner: &dyn Preconditioner,
    iterates: Vec<Iterate>,
    route: Route,
    watch: &Watch<'_>,
) -> Result<Answer, SolveError> {
    let smallest_eigenvalue = eigenvalue(task, preconditioner, watch)?;
    Ok(Answer { iterates, route, precision: UsedPrecision::Double, factor_nonzeros: 0, smallest_eigenvalue })
}

/// Solves with multigrid for the matrix, or twice for its square root; nothing where there is no multigrid for it.
fn by_multigrid(task: &Task<'_>, watch: &Watch<'_>) -> Option<Result<Answer, SolveError>> {
    let part = task.problem.symmetric_part()?;
    let mut plan = watch.plan(&STEPS);
    if matches!(task.problem.form, Form::Symmetric) {
        let made = plan.begin(0).map_err(SolveError::from).and_then(|()| Multigrid::new(part.matrix, watch));
        let multigrid = match unless_cancelled(made)? {
            Ok(multigrid) => multigrid,
            Err(Cancelled) => return Some(Err(Cancelled.into())),
        };
        let iterates = plan.begin(0).map_err(SolveError::from).and_then(|()| refined(task, &multigrid, watch));
        return Some(iterates.and_then(|iterates| answer(task, &multigrid, iterates, Route::CgMultigrid, watch)));
    }
    let made = plan.begin(0).map_err(SolveError::from).and_then(|()| squared_sum(task, part, watch));
    let mut squared = match unless_cancelled(made)? {
        Ok(squared) => squared,
        Err(Cancelled) => return Some(Err(Cancelled.into())),
    };
    let mut outcome = plan.begin(0).map_err(SolveError::from).and_then(|()| refined(task, &squared, watch));
    if matches!(outcome, Err(SolveError::IndefinitePreconditioner { .. } | SolveError::NotConverged { .. })) {
        // Rows of needle triangles: a small residual of the inner systems is not yet a solution.
        squared.set_tolerance(TIGHT);
        outcome = plan.begin(0).map_err(SolveError::from).and_then(|()| refined(task, &squared, watch));
    }
    Some(outcome.and_then(|iterates| answer(task, &squared, iterates, Route::CgMultigrid, watch)))
}

/// What was made, or that it was stopped; nothing where it cannot be made.
fn unless_cancelled<T>(made: Result<T, SolveError>) -> Option<Result<T, Cancelled>> {
    match made {
        Ok(made) => Some(Ok(made)),
        Err(SolveError::Cancelled {}) => Some(Err(Cancelled)),
        Err(_) => None,
    }
}

fn squared_sum(task: &Task<'_>, part: SymmetricPart<'_>, watch: &Watch<'_>) -> Result<SquaredSum, SolveError> {
    let squared = SquaredSum::new(part.matrix, &task.shift(), SquaredSum::TOLERANCE, watch)?;
    Ok(match part.weights {
        Some(weights) => squared.between(&weights.iter().map(|w| w.recip()).collect::<Vec<f64>>()),
        None => squared,
    })
}

/// A lower bound of the smallest eigenvalue, if it is wanted and can be found.
pub(super) fn eigenvalue(
    task: &Task<'_>,
    preconditioner: &dyn Preconditioner,
    watch: &Watch<'_>,
) -> Result<Option<f64>, Cancelled> {
    if !task.settings.bounds {
        return Ok(None);
    }
    let options = CgOptions { tolerance: CG_TOLERANCE, ..CgOptions::default() };
    let mut solve = |b: &[f64]| {
        let mut x = vec![0.0; b.len()];
        match conjugate_gradient(&mut |x| task.problem.apply(x), preconditioner, b, &mut x, &options, watch) {
            // Rough solutions only take more steps.
            Ok(_) | Err(SolveError::NotConverged { .. }) => Ok(x),
            Err(error) => Err(error),
        }
    };
    smallest_eigenvalue(&task.problem, &mut solve, watch)
}

/// Conjugate gradients with a good preconditioner, refined.
pub(super) fn refined(
    task: &Task<'_>,
    preconditioner: &dyn Preconditioner,
    watch: &Watch<'_>,
) -> Result<Vec<Iterate>, SolveError> {
    let is_rough = match task.problem.form {
        Form::Symmetric => false,
        Form::Normal { .. } => true,
        Form::Regularized { data, .. } => data.mass.has_gaps(),
    };
    let most = if is_rough { MOST_ROUGHLY_PRECONDITIONED } else { MOST_PRECONDITIONED };
    refined_within(task, preconditioner, most, watch)
}

/// The part of the error, in the norm of the matrix, that a round of [`refined_nearby`] leaves, but for rounding; and its most steps.
const NEARBY: f64 = 1e-8;
const MOST_NEARBY: usize = 60;
/// The relative correction by which a system counts as one with a solution.
const REGULAR: f64 = 1e-3;
/// The smallest eigenvalue of M⁻¹A, for the matrix M nearby, with which corrections still tell the error.
const NEAR: f64 = 1e-4;

/// Conjugate gradients with the factor of a matrix nearby, refined by residuals in factored form. The matrix may be so badly conditioned
/// that the length of a residual tells nothing: corrections have to shrink.
pub(super) fn refined_nearby(
    task: &Task<'_>,
    nearby: &dyn Preconditioner,
    watch: &Watch<'_>,
) -> Result<Vec<Iterate>, SolveError> {
    let residual = |c: usize, x: &[f64]| task.problem.residual(&task.right_hand_sides[c], x);
    let precise = |c: usize, x: &[f64]| task.problem.precise_residual(&task.right_hand_sides[c], x);
    let accuracy = (task.right_hand_sides.len(), task.tolerance(Precision::Double));
    Ok(by_steps(task, nearby, accuracy, &residual, Some(&precise), watch)?.0)
}

/// Makes sure that a matrix is regular as far as double precision can tell: that it has a solution for a random right-hand side, in which
/// everything has a share that the matrix might make zero. The right-hand sides of smoothing have none, and are solved for all the same.
///
/// # Errors
/// `NotConverged` where it is not, or not near enough to the other matrix to tell; those of the steps.
pub(super) fn check_regular(task: &Task<'_>, nearby: &dyn Preconditioner, watch: &Watch<'_>) -> Result<(), SolveError> {
    let mut random = Random::new(1);
    let b: Vec<f64> = (0..task.problem.unknowns()).map(|_| random.signed()).collect();
    let residual = |_: usize, x: &[f64]| {
        let mut rest = b.clone();
        if !x.is_empty() {
            rest.iter_mut().zip(task.problem.apply(x)).for_each(|(rest, image)| *rest -= image);
        }
        rest
    };
    let (_, smallest) = by_steps(task, nearby, (1, REGULAR), &residual, None, watch)?;
    if smallest >= NEAR { Ok(()) } else { Err(SolveError::NotConverged { iterations: 1, residual: smallest.recip() }) }
}

/// Refines so many right-hand sides to a relative error. Returns the smallest eigenvalue of M⁻¹A that was seen, too.
fn by_steps(
    task: &Task<'_>,
    nearby: &dyn Preconditioner,
    (count, tolerance): (usize, f64),
    residual: &Residual<'_>,
    precise: Option<&Residual<'_>>,
    watch: &Watch<'_>,
) -> Result<(Vec<Iterate>, f64), SolveError> {
    let n = task.problem.unknowns();
    let mut smallest = f64::INFINITY;
    let mut apply = |x: &[f64]| {
        // A product cannot fail: that it was stopped is heard right after it.
        let _: Result<(), Cancelled> = watch.tick(task.problem.ticks());
        task.problem.apply(x)
    };
    let refinement = Refinement {
        count,
        length: n,
        tolerance,
        inverse_norm: None,
        start: None,
        ticks: task.problem.ticks(),
        residual,
        precise,
        solve: &mut |right_hand_sides, iterations| {
            let mut solutions = Vec::with_capacity(right_hand_sides.len());
            for (b, iterations) in right_hand_sides.chunks_exact(n).zip(iterations) {
                let steps = conjugate_steps(&mut apply, nearby, b, NEARBY, MOST_NEARBY, watch)?;
                *iterations += steps.count;
                smallest = smallest.min(steps.smallest);
                solutions.extend_from_slice(&steps.x);
            }
            Ok(solutions)
        },
    };
    Ok((refine(refinement, watch)?, smallest))
}

fn refined_within(
    task: &Task<'_>,
    preconditioner: &dyn Preconditioner,
    max_iterations: usize,
    watch: &Watch<'_>,
) -> Result<Vec<Iterate>, SolveError> {
    let n = task.problem.unknowns();
    let options = CgOptions { tolerance: CG_TOLERANCE, max_iterations, ..CgOptions::default() };
    let mut apply = |x: &[f64]| {
        // A product cannot fail: that it was stopped is heard right after it.
        let _: Result<(), Cancelled> = watch.tick(task.problem.ticks());
        task.problem.apply(x)
    };
    // Where some unknowns are beyond the data term, the data are most of the right-hand side if ε is large: what is left when they are
    // met tells how far the others are.
    let start = task.problem.data().filter(|data| data.mass.has_gaps());
    let start = start.map(|data| move |c: usize| data.met(&task.right_hand_sides[c]));
    let refinement = Refinement {
        count: task.right_hand_sides.len(),
        length: n,
        tolerance: task.tolerance(Precision::Double),
        inverse_norm: None,
        start: start.as_ref().map(|start| start as &dyn Fn(usize) -> Vec<f64>),
        ticks: task.problem.ticks(),
        residual: &|c, x| task.problem.residual(&task.right_hand_sides[c], x),
        precise: Some(&|c, x| task.problem.precise_residual(&task.right_hand_sides[c], x)),
        solve: &mut |right_hand_sides, iterations| {
            let mut solutions = vec![0.0; right_hand_sides.len()];
            let columns = right_hand_sides.chunks_exact(n).zip(solutions.chunks_exact_mut(n));
            for ((b, x), iterations) in columns.zip(iterations) {
                *iterations += match conjugate_gradient(&mut apply, preconditioner, b, x, &options, watch) {
                    Ok(info) => info.iterations,
                    // What rounding leaves in the residual of small ε is rough, and A⁻¹ hardly feels it: whether the
                    // solution is one is seen by its corrections.
                    Err(SolveError::NotConverged { iterations, residual })
                        if residual < ROUGH_RESIDUAL && iterations < max_iterations =>
                    {
                        iterations
                    }
                    Err(error) => return Err(error),
                };
            }
            Ok(solutions)
        },
    };
    refine(refinement, watch)
}
