//! Sparse symmetric positive definite systems. Knows matrices only, no mesh.

mod direct;
mod iterative;
mod lanes;
mod matrix;
mod ordering;
mod twofold;
mod vectors;

pub use direct::{CholeskyAnalysis, CholeskyFactor, FactorSize, LaneBlock, Scalar};
pub(crate) use iterative::conjugate_steps;
pub use iterative::{
    CgInfo, CgOptions, IncompleteCholesky, Jacobi, Multigrid, Preconditioner, SquaredSum, conjugate_gradient,
};
pub use matrix::{columns, gram, norm, product, submatrix, transposed_product};
pub use ordering::{Permutation, minimum_degree, nested_dissection};
pub(crate) use twofold::{Twofold, product_twofold, transposed_product_twofold};
pub(crate) use vectors::{Rows, dot_products};
