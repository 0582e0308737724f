//! Fill-reducing orderings.

mod bisection;
mod dissection;
mod edge_cut;
mod flow;
mod graph;
mod ids;
mod leaf;
mod minimum_degree;
mod permutation;
mod queue;
mod refine;

pub use dissection::nested_dissection;
pub use minimum_degree::minimum_degree;
pub use permutation::Permutation;
