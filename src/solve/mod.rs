//! Sparse symmetric positive definite systems. Knows matrices only, no mesh.

mod aggregation;
mod cg;
mod cholesky;
mod elimination;
mod front;
mod lanes;
mod matrix;
mod multifrontal;
mod multigrid;
mod ordering;
mod preconditioner;
mod rows;
mod scalar;
mod squared;
mod supernodes;
mod symbolic;
mod tree;
mod triangular;
mod unit;

pub use cg::{CgInfo, CgOptions, conjugate_gradient};
pub use cholesky::{CholeskyAnalysis, CholeskyFactor};
pub use matrix::{columns, gram, norm, product, quadratic_form, relative_residual, submatrix, transposed_product};
pub use multigrid::Multigrid;
pub use ordering::{Permutation, minimum_degree, nested_dissection};
pub use preconditioner::{IncompleteCholesky, Jacobi, Preconditioner};
pub use scalar::Scalar;
pub use squared::SquaredSum;
pub use symbolic::FactorSize;
pub use unit::Unit;
