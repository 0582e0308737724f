//! Linear systems.

use super::detail::Detail;
use super::stage::stage_error;

stage_error! {
    /// A linear system could not be solved.
    SolveError {
        /// The matrix is not square, or a vector does not fit it.
        DimensionMismatch {
            /// Size that fits.
            expected: usize,
            /// Size that came.
            actual: usize,
        } => "the system has {expected} unknowns, but {actual} were given",
        /// An entry whose mirror image is not stored.
        NotSymmetric {
            /// Its row.
            row: usize,
            /// Its column.
            column: usize,
        } => "the matrix has an entry at ({row}, {column}), but none at ({column}, {row})",
        /// Another sparsity pattern than the one analysed.
        PatternMismatch {} => "the matrix has another pattern than the one that was analysed",
        /// A matrix entry or right-hand side is NaN or infinite.
        NonFiniteEntry {
            /// Its row.
            row: usize,
        } => "row {row} of the system holds a number that is not finite",
        /// A pivot, a diagonal entry or a curvature is not positive.
        NotPositiveDefinite {
            /// The column, hence the unknown.
            column: usize,
        } => "the matrix is not numerically positive definite at unknown {column}",
        /// A preconditioner turned a residual by a right angle or more.
        IndefinitePreconditioner {
            /// Iterations done.
            iterations: usize,
        } => "the preconditioner is not positive definite: found after {iterations} iterations",
        /// An iteration or refinement stopped before its tolerance.
        NotConverged {
            /// Iterations done.
            iterations: usize,
            /// Relative residual or correction reached.
            residual: f64,
        } => "not converged after {iterations} iterations: {residual:e} reached",
        /// The memory needed is more than there is.
        OutOfMemory {
            /// Bytes needed.
            bytes: u64,
        } => "{bytes} bytes of memory are needed, more than can be had here",
        /// The work was stopped by its watcher.
        Cancelled {} => "stopped, as asked; everything is as it was before the call",
    }
}
