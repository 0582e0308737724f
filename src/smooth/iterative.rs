//! The routes without a factor of the system: conjugate gradients with the matrix in factored form.

use super::refine::{Iterate, Refinement, refine};
use super::routes::{Answer, Task};
use super::system::Mass;
use crate::error::SolveError;
use crate::solve::{CgOptions, Jacobi, Preconditioner, SquaredSum, conjugate_gradient};

/// Relative residual of each solution by conjugate gradients: within reach of double precision for every system that
/// refinement can solve; refinement makes up the rest.
const CG_TOLERANCE: f64 = 1e-6;
/// Corrections this small relative to the solution end the refinement of an iterative solution.
const TOLERANCE: f64 = 1e-13;

/// Solves with the best preconditioner that needs little memory.
pub(super) fn solve(task: &Task<'_>) -> Result<Answer, SolveError> {
    let answer = |iterates, route| Answer { iterates, route, precision: "double", factor_nonzeros: 0 };
    if task.problem.symmetric && task.problem.weights.is_none() {
        let shift = shift(task);
        let squared = SquaredSum::new(task.problem.laplacian, &shift, SquaredSum::TOLERANCE);
        // Where multigrid does not get on, the diagonal may.
        if let Ok(iterates) = squared.and_then(|squared| refined(task, &squared)) {
            return Ok(answer(iterates, "cgMultigrid"));
        }
    }
    let jacobi = Jacobi::new(&task.problem.diagonal())?;
    Ok(answer(refined(task, &jacobi)?, "cgJacobi"))
}

/// The diagonal of D in (L + D)² near LᵀL + εB: √(ε·m) with the lumped masses m.
pub(super) fn shift(task: &Task<'_>) -> Vec<f64> {
    let root = task.key.0.sqrt();
    let n = task.problem.unknowns();
    match task.problem.mass {
        Mass::Identity => vec![root; n],
        Mass::Diagonal(masses) => masses.iter().map(|m| root * m.sqrt()).collect(),
        // The rows of the Galerkin mass matrix sum to the lumped masses.
        mass @ Mass::Matrix(_) => mass.times(&vec![1.0; n]).iter().map(|m| root * m.sqrt()).collect(),
    }
}

/// Conjugate gradients with this preconditioner, refined.
pub(super) fn refined(task: &Task<'_>, preconditioner: &dyn Preconditioner) -> Result<Vec<Iterate>, SolveError> {
    let n = task.problem.unknowns();
    let options = CgOptions { tolerance: CG_TOLERANCE, ..CgOptions::default() };
    let mut apply = |x: &[f64]| task.problem.apply(x);
    refine(Refinement {
        count: task.fields.len(),
        length: n,
        wanted: 0..n,
        tolerance: TOLERANCE,
        residual: &|c, x| task.problem.residual(&task.fields[c], x),
        solve: &mut |right_hand_sides, iterations| {
            let mut solutions = vec![0.0; right_hand_sides.len()];
            let columns = right_hand_sides.chunks_exact(n).zip(solutions.chunks_exact_mut(n));
            for ((b, x), iterations) in columns.zip(iterations) {
                *iterations += conjugate_gradient(&mut apply, preconditioner, b, x, &options)?.iterations;
            }
            Ok(solutions)
        },
    })
}
