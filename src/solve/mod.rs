//! Sparse symmetric positive definite systems. Knows matrices only, no mesh.

mod aggregation;
mod cg;
mod cholesky;
mod elimination;
mod matrix;
mod multigrid;
mod ordering;
mod preconditioner;
mod rows;
mod squared;
mod symbolic;

pub use cg::{CgInfo, CgOptions, conjugate_gradient};
pub use cholesky::{CholeskyAnalysis, CholeskyFactor};
pub use matrix::{gram, norm, product, quadratic_form, submatrix, transposed_product};
pub use multigrid::Multigrid;
pub use ordering::{Permutation, minimum_degree};
pub use preconditioner::{IncompleteCholesky, Jacobi, Preconditioner};
pub use squared::SquaredSum;
pub use symbolic::FactorSize;
