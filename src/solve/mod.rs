//! Sparse symmetric positive definite systems. Knows matrices only, no mesh.

mod cg;
mod cholesky;
mod matrix;
mod ordering;
mod symbolic;

pub use cg::{CgInfo, CgOptions, conjugate_gradient};
pub use cholesky::{CholeskyAnalysis, CholeskyFactor};
pub use matrix::{gram, norm, product, quadratic_form, submatrix, transposed_product};
pub use ordering::{Permutation, minimum_degree, nested_dissection};
pub use symbolic::FactorSize;
