//! Sparse symmetric positive definite systems. Knows matrices only, no mesh.

mod cg;
mod cholesky;
mod front;
mod matrix;
mod multifrontal;
mod ordering;
mod scalar;
mod supernodes;
mod symbolic;
mod tree;
mod triangular;

pub use cg::{CgInfo, CgOptions, conjugate_gradient};
pub use cholesky::{CholeskyAnalysis, CholeskyFactor};
pub use matrix::{gram, norm, product, quadratic_form, relative_residual, submatrix, transposed_product};
pub use ordering::{Permutation, minimum_degree, nested_dissection};
pub use scalar::{Scalar, Unit};
pub use symbolic::FactorSize;
