//! What a route is asked, and what it answers.

use std::sync::Arc;

use super::problem::{Problem, RightHandSide};
use super::refine::Iterate;
use crate::smooth::data_term::{DataTerm, Mass};
use crate::smooth::names::{Route, UsedPrecision};
use crate::smooth::{Precision, SolverChoice};

/// Relative errors that refinement stops at: far below every use of the result, and above what a step could still mend.
const DOUBLE: f64 = 1e-16;
const SINGLE: f64 = 1e-13;

/// The least eigenvalue of the squared Laplacian of a grid on points that are held, over the square of their share in all. Between 5 and 20
/// iterations are fewest, for one held vertex in 20 and in 200.
const PLATE: f64 = 10.0;

/// How to solve, whatever the system.
#[derive(Debug, Clone, Copy)]
pub(in crate::smooth) struct SolverSettings {
    pub(in crate::smooth) choice: SolverChoice,
    pub(in crate::smooth) precision: Precision,
    /// Whether the smallest eigenvalue is wanted, too.
    pub(in crate::smooth) bounds: bool,
    pub(in crate::smooth) accuracy: Accuracy,
    pub(in crate::smooth) solutions: Solutions,
}

/// How many solutions are wanted of one factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::smooth) enum Solutions {
    /// Those of one call.
    Few,
    /// So many that a costly factor which solves at once is cheaper than one that only preconditions iterations.
    Many,
}

/// How good solutions have to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::smooth) enum Accuracy {
    /// Refined to rounding.
    Full,
    /// As a solver in double precision gives them, unrefined: good enough where only the space that they span matters.
    Rough,
}

/// What a factor belongs to, within one system. A method that factors for many ε in turn, or for steps of an interior-point
/// iteration, says by such a value which of them it is.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::smooth) enum FactorKey {
    /// The system has no data term, and so one factor.
    Plain,
    /// The system with εB.
    Regularized { epsilon: f64, term: Arc<DataTerm> },
}

/// One call.
pub(in crate::smooth) struct Task<'a> {
    pub(in crate::smooth) problem: Problem<'a>,
    pub(in crate::smooth) key: &'a FactorKey,
    /// One per channel.
    pub(in crate::smooth) right_hand_sides: &'a [RightHandSide],
    pub(in crate::smooth) settings: SolverSettings,
}

/// Solutions, one per channel, and where they come from.
pub(in crate::smooth) struct Answer {
    pub(in crate::smooth) iterates: Vec<Iterate>,
    pub(in crate::smooth) route: Route,
    pub(in crate::smooth) precision: UsedPrecision,
    pub(in crate::smooth) factor_nonzeros: u64,
    /// A lower bound of the smallest eigenvalue of the system's matrix, where it was asked for and could be found.
    pub(in crate::smooth) smallest_eigenvalue: Option<f64>,
}

impl Task<'_> {
    /// The diagonal D of the second-order operator that the routes for a symmetric A are made from, DWD ≈ εB: √ε·B where the
    /// system is a product, else √(ε·b/w) with the row sums b of B. Where only some vertices are held, by values or by the data, these hold
    /// the others, too, by bending: as a plate on points, as if they were spread evenly over all.
    pub(super) fn shift(&self) -> Vec<f64> {
        let n = self.problem.unknowns();
        let stiffness = |held: usize, all: usize| PLATE * (held as f64 / all as f64) * (held as f64 / all as f64);
        let Some(data) = self.problem.data() else {
            let rows = self.problem.matrix.nrows();
            return vec![stiffness(rows - n, rows).sqrt(); n];
        };
        let root = data.epsilon.sqrt();
        let sums = match data.mass {
            Mass::Identity => return vec![root; n],
            Mass::Diagonal(masses) if self.problem.is_product() => return masses.iter().map(|m| root * m).collect(),
            Mass::Diagonal(masses) => masses.clone(),
            // The rows of the Galerkin mass matrix sum to the lumped masses.
            Mass::Matrix(_) | Mass::Partial(_) => data.mass.times(&vec![1.0; n]),
        };
        let weights = self.problem.weights();
        let weight = |i: usize| weights.map_or(1.0, |weights| weights[i]);
        let pulled = sums.iter().enumerate().map(|(i, b)| root * (b / weight(i)).sqrt());
        if !data.mass.has_gaps() {
            return pulled.collect();
        }
        // The pull of the data, were it the same everywhere, and what bending passes on of it.
        let held = sums.iter().filter(|b| **b > 0.0).count();
        let mean = data.epsilon * sums.iter().sum::<f64>() / n as f64;
        let passed = |i: usize| (weight(i) / mean + stiffness(held, n).recip()).recip();
        pulled.enumerate().map(|(i, pull)| pull.max(passed(i).sqrt())).collect()
    }

    /// Refines to the accuracy of the precision.
    pub(super) fn tolerance(&self, precision: Precision) -> f64 {
        match (precision, self.settings.accuracy) {
            (Precision::Double, Accuracy::Rough) => f64::INFINITY,
            (Precision::Double, Accuracy::Full) => DOUBLE,
            (Precision::Single, _) => SINGLE,
        }
    }
}
