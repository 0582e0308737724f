//! The routes without a factor of the system: conjugate gradients with the matrix in factored form.

use super::eigenvalue::smallest_eigenvalue;
use super::refine::{Iterate, Refinement, refine};
use super::{Answer, Inner, Mass, Order, Task};
use crate::Watch;
use crate::error::SolveError;
use crate::solve::{CgOptions, Jacobi, Multigrid, Preconditioner, SquaredSum, conjugate_gradient};

/// Relative residual of each solution by conjugate gradients: within reach of double precision for every system that
/// refinement can solve; refinement makes up the rest.
const CG_TOLERANCE: f64 = 1e-6;
/// Relative residual that is taken for converged where rounding allows no less.
const ROUGH_RESIDUAL: f64 = 0.5;
/// A good preconditioner takes ten to twenty iterations; past this many, rounding prevails.
const MOST_PRECONDITIONED: usize = 200;
/// Where not all unknowns are pulled, the preconditioner is a rough one, and takes more the larger the mesh is.
const MOST_ROUGHLY_PRECONDITIONED: usize = 2000;
/// The inner tolerance of a second attempt.
const TIGHT: f64 = 1e-8;
/// The relative error at which refinement stops.
const TOLERANCE: f64 = 1e-16;

/// Solves with the best preconditioner that needs little memory.
pub(super) fn solve(task: &Task<'_>) -> Result<Answer, SolveError> {
    if let Some(outcome) = by_multigrid(task) {
        return outcome;
    }
    let jacobi = Jacobi::new(&task.problem.diagonal())?;
    let iterates = refined_within(task, &jacobi, CgOptions::default().max_iterations)?;
    Ok(answer(task, &jacobi, iterates, "cgJacobi"))
}

fn answer(task: &Task<'_>, preconditioner: &dyn Preconditioner, iterates: Vec<Iterate>, route: &'static str) -> Answer {
    let smallest_eigenvalue = eigenvalue(task, preconditioner);
    Answer { iterates, route, precision: "double", factor_nonzeros: 0, smallest_eigenvalue }
}

/// With multigrid for the matrix, or twice for its square root; nothing where there is no multigrid for it.
fn by_multigrid(task: &Task<'_>) -> Option<Result<Answer, SolveError>> {
    const ROUTE: &str = "cgMultigrid";
    let inner = task.problem.inner?;
    if task.problem.order == Order::First {
        let multigrid = Multigrid::new(inner.matrix, &Watch::none()).ok()?;
        return Some(refined(task, &multigrid).map(|iterates| answer(task, &multigrid, iterates, ROUTE)));
    }
    let mut squared = squared_sum(task, inner).ok()?;
    let mut outcome = refined(task, &squared);
    if matches!(outcome, Err(SolveError::IndefinitePreconditioner { .. } | SolveError::NotConverged { .. })) {
        // Rows of needle triangles: a small residual of the inner systems is not yet a solution.
        squared.set_tolerance(TIGHT);
        outcome = refined(task, &squared);
    }
    Some(outcome.map(|iterates| answer(task, &squared, iterates, ROUTE)))
}

fn squared_sum(task: &Task<'_>, inner: Inner<'_>) -> Result<SquaredSum, SolveError> {
    let squared = SquaredSum::new(inner.matrix, &task.shift(), SquaredSum::TOLERANCE, &Watch::none())?;
    Ok(match inner.weights {
        Some(weights) => squared.between(&weights.iter().map(|w| w.recip()).collect::<Vec<f64>>()),
        None => squared,
    })
}

/// A lower bound of the smallest eigenvalue, if it is wanted and can be found.
pub(super) fn eigenvalue(task: &Task<'_>, preconditioner: &dyn Preconditioner) -> Option<f64> {
    if !task.manner.bounds {
        return None;
    }
    let options = CgOptions { tolerance: CG_TOLERANCE, ..CgOptions::default() };
    smallest_eigenvalue(&task.problem, &mut |b| {
        let mut x = vec![0.0; b.len()];
        match conjugate_gradient(&mut |x| task.problem.apply(x), preconditioner, b, &mut x, &options, &Watch::none()) {
            // Rough solutions only take more steps.
            Ok(_) | Err(SolveError::NotConverged { .. }) => Ok(x),
            Err(error) => Err(error),
        }
    })
}

/// Conjugate gradients with a good preconditioner, refined.
pub(super) fn refined(task: &Task<'_>, preconditioner: &dyn Preconditioner) -> Result<Vec<Iterate>, SolveError> {
    let is_rough = match task.problem.pull.map(|pull| pull.mass) {
        Some(Mass::Diagonal(masses)) => masses.contains(&0.0),
        Some(_) => false,
        None => task.problem.order == Order::Squared,
    };
    refined_within(task, preconditioner, if is_rough { MOST_ROUGHLY_PRECONDITIONED } else { MOST_PRECONDITIONED })
}

fn refined_within(
    task: &Task<'_>,
    preconditioner: &dyn Preconditioner,
    max_iterations: usize,
) -> Result<Vec<Iterate>, SolveError> {
    let n = task.problem.unknowns();
    let options = CgOptions { tolerance: CG_TOLERANCE, max_iterations, ..CgOptions::default() };
    let mut apply = |x: &[f64]| task.problem.apply(x);
    refine(Refinement {
        count: task.loads.len(),
        length: n,
        tolerance: TOLERANCE,
        inverse_norm: None,
        residual: &|c, x| task.problem.residual(&task.loads[c], x),
        solve: &mut |right_hand_sides, iterations| {
            let mut solutions = vec![0.0; right_hand_sides.len()];
            let columns = right_hand_sides.chunks_exact(n).zip(solutions.chunks_exact_mut(n));
            for ((b, x), iterations) in columns.zip(iterations) {
                *iterations += match conjugate_gradient(&mut apply, preconditioner, b, x, &options, &Watch::none()) {
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
    })
}
