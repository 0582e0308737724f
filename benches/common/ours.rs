//! The solver of morse-smooth: the only file here that knows its interface.

use morse_smooth::Watch;
use morse_smooth::error::SolveError;
use morse_smooth::solve::{CholeskyAnalysis, CholeskyFactor, Permutation, nested_dissection};
use nalgebra::Complex;
use nalgebra_sparse::pattern::SparsityPattern;

use super::systems::Values;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Precision {
    Double,
    Single,
}

/// The old ids in the new order.
pub(crate) fn order(pattern: &SparsityPattern) -> Vec<u32> {
    nested_dissection(pattern, &Watch::none()).expect("nobody stops it")
}

pub(crate) struct Analysis(CholeskyAnalysis);

impl Analysis {
    pub(crate) fn new(pattern: SparsityPattern, order: &[u32]) -> Self {
        let permutation = Permutation::new(order.to_vec()).expect("a permutation");
        Self(CholeskyAnalysis::with_permutation(pattern, &permutation, &Watch::none()).expect("a symmetric pattern"))
    }

    pub(crate) fn pattern(&self) -> &SparsityPattern {
        self.0.pattern()
    }

    /// Entries of the factor, without zeros that a method stores for its convenience.
    pub(crate) fn nonzeros(&self) -> f64 {
        self.0.size().nonzeros as f64
    }

    /// None where the matrix is not positive definite to that precision.
    pub(crate) fn factor(&self, values: &Values, precision: Precision) -> Option<Factor> {
        let factor = match (values, precision) {
            (Values::Real(values), Precision::Double) => self.0.factor(values, &Watch::none()).map(Factor::Real),
            (Values::Real(values), Precision::Single) => self.0.factor(values, &Watch::none()).map(Factor::RealSingle),
            (Values::Complex(values), Precision::Double) => self.0.factor(values, &Watch::none()).map(Factor::Complex),
            (Values::Complex(values), Precision::Single) => {
                self.0.factor(values, &Watch::none()).map(Factor::ComplexSingle)
            }
        };
        match factor {
            Ok(factor) => Some(factor),
            Err(SolveError::NotPositiveDefinite { .. }) => None,
            Err(error) => panic!("{error}"),
        }
    }
}

pub(crate) enum Factor {
    Real(CholeskyFactor<f64>),
    RealSingle(CholeskyFactor<f32>),
    Complex(CholeskyFactor<Complex<f64>>),
    ComplexSingle(CholeskyFactor<Complex<f32>>),
}

impl Factor {
    pub(crate) fn refactor(&mut self, values: &Values) {
        let outcome = match (self, values) {
            (Self::Real(factor), Values::Real(values)) => factor.refactor(values, &Watch::none()),
            (Self::RealSingle(factor), Values::Real(values)) => factor.refactor(values, &Watch::none()),
            (Self::Complex(factor), Values::Complex(values)) => factor.refactor(values, &Watch::none()),
            (Self::ComplexSingle(factor), Values::Complex(values)) => factor.refactor(values, &Watch::none()),
            _ => panic!("values of the factor's kind"),
        };
        outcome.expect("positive definite");
    }

    /// For right-hand sides one after the other.
    pub(crate) fn solve(&self, right_hand_sides: &Values) -> Values {
        let solution = match (self, right_hand_sides) {
            (Self::Real(factor), Values::Real(b)) => factor.solve(b, &Watch::none()).map(Values::Real),
            (Self::RealSingle(factor), Values::Real(b)) => factor.solve(b, &Watch::none()).map(Values::Real),
            (Self::Complex(factor), Values::Complex(b)) => factor.solve(b, &Watch::none()).map(Values::Complex),
            (Self::ComplexSingle(factor), Values::Complex(b)) => factor.solve(b, &Watch::none()).map(Values::Complex),
            _ => panic!("right-hand sides of the factor's kind"),
        };
        solution.expect("right-hand sides that fit")
    }
}
