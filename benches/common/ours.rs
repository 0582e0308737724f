//! The solver of morse-smooth: the only file here that knows its interface.

use morse_smooth::solve::{CholeskyAnalysis, CholeskyFactor, Permutation, minimum_degree};
use nalgebra_sparse::pattern::SparsityPattern;

use super::systems::Values;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Precision {
    Double,
    Single,
}

/// The old ids in the new order.
pub(crate) fn order(pattern: &SparsityPattern, _positions: &[f64]) -> Vec<u32> {
    minimum_degree(pattern)
}

pub(crate) struct Analysis(CholeskyAnalysis);

impl Analysis {
    pub(crate) fn new(pattern: &SparsityPattern, order: &[u32]) -> Self {
        let permutation = Permutation::new(order.to_vec()).expect("a permutation");
        Self(CholeskyAnalysis::with_permutation(pattern, permutation).expect("a symmetric pattern"))
    }

    /// Entries of the factor, without zeros that a method stores for its convenience.
    pub(crate) fn nonzeros(&self) -> f64 {
        self.0.size().nonzeros as f64
    }

    /// None where there is no such factorisation.
    pub(crate) fn factor(&self, values: &Values, precision: Precision) -> Option<Factor> {
        match (values, precision) {
            (Values::Real(values), Precision::Double) => {
                Some(Factor(self.0.factor(values).expect("positive definite")))
            }
            _ => None,
        }
    }
}

pub(crate) struct Factor(CholeskyFactor);

impl Factor {
    pub(crate) fn refactor(&mut self, values: &Values) {
        self.0.refactor(values.real()).expect("positive definite");
    }

    /// For right-hand sides one after the other.
    pub(crate) fn solve(&self, right_hand_sides: &Values) -> Values {
        Values::Real(self.0.solve(right_hand_sides.real()).expect("right-hand sides that fit"))
    }
}
