//! Sparse symmetric positive definite systems. Knows matrices only, no mesh.

mod direct;
mod iterative;
mod lanes;
mod matrix;
mod ordering;
mod vectors;

pub use direct::{CholeskyAnalysis, CholeskyFactor, FactorSize, LaneBlock, Scalar};
pub use iterative::{
    CgInfo, CgOptions, IncompleteCholesky, Jacobi, Multigrid, Preconditioner, SquaredSum, conjugate_gradient,
};
pub use matrix::{columns, gram, norm, product, submatrix, transposed_product};
pub use ordering::{Permutation, minimum_degree, nested_dissection};
pub(crate) use vectors::{Rows, dot_products};
