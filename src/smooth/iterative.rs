//! The routes without a factor of the system: conjugate gradients with the matrix in factored form.

use super::refine::{Iterate, Refinement, refine};
use super::routes::{Answer, Task};
use super::system::Mass;
use crate::error::SolveError;
use crate::solve::{CgOptions, Jacobi, Preconditioner, SquaredSum, conjugate_gradient};

/// Relative residual of each solution by conjugate gradients: within reach of double precision for every system that
/// refinement can solve; refinement makes up the rest.
const CG_TOLERANCE: f64 = 1e-6;
/// Relative residual that is taken for converged where rounding allows no less.
const ROUGH_RESIDUAL: f64 = 0.5;
/// A good preconditioner takes ten to twenty iterations; past this many, rounding prevails.
const MOST_PRECONDITIONED: usize = 200;
/// The inner tolerance of a second attempt.
const TIGHT: f64 = 1e-8;
/// The relative error at which refinement stops.
const TOLERANCE: f64 = 1e-16;

/// Solves with the best preconditioner that needs little memory.
pub(super) fn solve(task: &Task<'_>) -> Result<Answer, SolveError> {
    let answer = |iterates, route| Answer { iterates, route, precision: "double", factor_nonzeros: 0 };
    if task.problem.symmetric
        && let Ok(mut squared) = squared_sum(task)
    {
        let mut outcome = refined(task, &squared);
        if matches!(outcome, Err(SolveError::IndefinitePreconditioner { .. } | SolveError::NotConverged { .. })) {
            // Rows of needle triangles: a small residual of the inner systems is not yet a solution.
            squared.set_tolerance(TIGHT);
            outcome = refined(task, &squared);
        }
        return Ok(answer(outcome?, "cgMultigrid"));
    }
    let jacobi = Jacobi::new(&task.problem.diagonal())?;
    let iterates = refined_within(task, &jacobi, CgOptions::default().max_iterations)?;
    Ok(answer(iterates, "cgJacobi"))
}

fn squared_sum(task: &Task<'_>) -> Result<SquaredSum, SolveError> {
    let squared = SquaredSum::new(task.problem.laplacian, &task.shift(), SquaredSum::TOLERANCE)?;
    Ok(match (task.problem.weights, task.problem.mass) {
        // W is the inverse of the masses.
        (Some(_), Mass::Diagonal(masses)) => squared.between(masses),
        _ => squared,
    })
}

/// Conjugate gradients with a good preconditioner, refined.
pub(super) fn refined(task: &Task<'_>, preconditioner: &dyn Preconditioner) -> Result<Vec<Iterate>, SolveError> {
    refined_within(task, preconditioner, MOST_PRECONDITIONED)
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
        count: task.fields.len(),
        length: n,
        tolerance: TOLERANCE,
        residual: &|c, x| task.problem.residual(&task.fields[c], x),
        solve: &mut |right_hand_sides, iterations| {
            let mut solutions = vec![0.0; right_hand_sides.len()];
            let columns = right_hand_sides.chunks_exact(n).zip(solutions.chunks_exact_mut(n));
            for ((b, x), iterations) in columns.zip(iterations) {
                *iterations += match conjugate_gradient(&mut apply, preconditioner, b, x, &options) {
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
