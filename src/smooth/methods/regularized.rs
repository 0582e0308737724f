//! What eqs. (3), (5) and (7) of \[Patane09\] have in common: a data term ties the values to the input, and all vertices are free.

use std::sync::Arc;

use super::settings;
use crate::error::Result;
use crate::smooth::SmootherOptions;
use crate::smooth::bounds;
use crate::smooth::channels::Channel;
use crate::smooth::data_term::{DataTerm, Mass, Norm};
use crate::smooth::missing::Gaps;
use crate::smooth::report::{About, Measures, SolverReport};
use crate::smooth::run::{Found, Procedure, Solution};
use crate::smooth::schedule::Stages;
use crate::smooth::system::{RegularizedSystem, Solved};

/// What is solved, whatever ε is.
pub(in crate::smooth) struct Regularization {
    pub(in crate::smooth) about: About,
    /// The unknowns, ascending.
    pub(in crate::smooth) unknowns: Vec<u32>,
    pub(in crate::smooth) term: Arc<DataTerm>,
}

/// One of these systems with its ε.
pub(super) struct Regularized<'a> {
    pub(super) system: &'a mut RegularizedSystem,
    pub(super) epsilon: f64,
    pub(super) options: SmootherOptions,
    /// The vertices of the largest component whose values are one constrained one, and which is not solved for.
    pub(super) constant: usize,
}

/// The data term in a norm, over the vertices that have values.
pub(super) fn term(norm: Norm, gaps: Option<&Gaps<'_>>) -> Arc<DataTerm> {
    let missing = gaps.map_or_else(|| [].into(), |gaps| Arc::clone(&gaps.missing));
    Arc::new(DataTerm { norm, missing })
}

impl Procedure for Regularized<'_> {
    fn solve(&mut self, group: &[Channel], is_first: bool, stages: &mut Stages<'_, '_>) -> Result<Found> {
        let settings = settings(self.options, is_first);
        let solved = self.system.solve(group, self.epsilon, settings, stages)?;
        let perturbation_factor = match settings.bounds {
            true => perturbation_factor(self.system.mass(), &solved, self.epsilon),
            false => None,
        };
        let perturbation_factor = bounds::with_constants(perturbation_factor, self.constant);
        Ok(Found { solutions: solutions(self.system.unknowns(), solved), perturbation_factor })
    }

    fn measures(&mut self, x: &[f64], f: &[f64]) -> Measures {
        let unknowns = self.system.unknowns();
        let mut moved = Vec::with_capacity(unknowns.len());
        for &v in unknowns.iter() {
            moved.push(x[v as usize] - f[v as usize]);
        }
        Measures { metric_norm: Some(self.system.mass().norm(&moved)), ..Measures::default() }
    }
}

/// The channels of a solved system.
pub(super) fn solutions(unknowns: &Arc<[u32]>, mut solved: Solved) -> Vec<Solution> {
    let solutions = core::mem::take(&mut solved.solutions);
    let with_report = |solution: crate::smooth::system::Solution| Solution {
        vertices: Arc::clone(unknowns),
        solver: SolverReport::new(&solved, &solution),
        x: solution.x,
        values: None,
    };
    solutions.into_iter().map(with_report).collect()
}

fn perturbation_factor(mass: &Mass, solved: &Solved, epsilon: f64) -> Option<f64> {
    if solved.unknowns == 0 {
        return Some(1.0);
    }
    // The system was divided by this.
    let epsilon = epsilon / epsilon.max(1.0);
    bounds::regularized(mass, solved.unknowns, epsilon, solved.smallest_eigenvalue)
}
