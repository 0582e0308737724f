//! Conjugate gradients and what preconditions them.

mod aggregation;
mod cg;
mod elimination;
mod multigrid;
mod nearby;
mod preconditioner;
mod rows;
mod squared;

pub use cg::{CgInfo, CgOptions, conjugate_gradient};
pub use multigrid::Multigrid;
pub(crate) use nearby::conjugate_steps;
pub use preconditioner::{IncompleteCholesky, Jacobi, Preconditioner};
pub use squared::SquaredSum;
