//! The direct solver: analysis of a pattern, multifrontal Cholesky factorisation, and solves with the factor.

mod cholesky;
mod front;
mod lane_block;
mod multifrontal;
mod numbers;
mod scalar;
mod supernodes;
mod symbolic;
mod tree;
mod triangular;

pub use cholesky::{CholeskyAnalysis, CholeskyFactor};
pub use scalar::{LaneBlock, Scalar};
pub use symbolic::FactorSize;
