//! (LᵀWL + εB) x = εBf on the vertices that the operators reach.

use nalgebra_sparse::CscMatrix;

use super::{Solved, by_vertex, solved};
use crate::error::{Result, SolveError};
use crate::mesh::TriMesh;
use crate::operators::{MassScale, galerkin_mass, lumped_mass_diagonal};
use crate::smooth::channels::Channel;
use crate::smooth::routes::{Inner, Load, Manner, Mass, Order, Problem, Pull, Routes, Task};
use crate::smooth::{Metric, Operator, Progress};
use crate::solve::submatrix;

/// Below this, εB loses digits to underflow, and at last the right-hand side is zero.
const SMALLEST_WEIGHT: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// Everything about such a system that outlives one ε.
#[derive(Debug)]
pub(in crate::smooth) struct FullSystem {
    /// The vertices that are unknowns, ascending.
    unknowns: Vec<u32>,
    /// L on the unknowns.
    laplacian: CscMatrix<f64>,
    /// The diagonal of W: the inverse lumped masses for the finite-element operator, nothing for the paper's.
    weights: Option<Vec<f64>>,
    mass: Option<(Attraction, Mass)>,
    /// Counts the matrices B that there were: factors of the last one are of no use.
    revision: u32,
    routes: Routes,
}

/// What the values are pulled by: B.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::smooth) enum Attraction {
    /// All of them alike, or by the area around them.
    Metric(Metric, MassScale),
    /// Some vertices, each with its weight: the Δ of eq. (7).
    Constraints { vertices: Vec<u32>, weights: Vec<f64> },
}

impl FullSystem {
    /// `unknowns`: ascending vertices that L ties to no others.
    pub(in crate::smooth) fn new(
        mesh: &TriMesh,
        laplacian: &CscMatrix<f64>,
        operator: Operator,
        unknowns: Vec<u32>,
    ) -> Result<Self> {
        let all = unknowns.len() == laplacian.ncols();
        let laplacian = if all { laplacian.clone() } else { submatrix(laplacian, &unknowns) };
        let weights = match operator {
            Operator::Paper => None,
            Operator::Fem => {
                let areas = lumped_mass_diagonal(mesh, MassScale::Raw)?;
                Some(unknowns.iter().map(|&v| areas[v as usize].recip()).collect())
            }
        };
        Ok(Self { unknowns, laplacian, weights, mass: None, revision: 0, routes: Routes::default() })
    }

    pub(in crate::smooth) fn unknowns(&self) -> &[u32] {
        &self.unknowns
    }

    /// B, once it has been solved with.
    pub(in crate::smooth) fn mass(&self) -> Option<&Mass> {
        self.mass.as_ref().map(|(_, mass)| mass)
    }

    /// Gives the memory of the last factor back.
    pub(in crate::smooth) fn drop_factor(&mut self) {
        self.routes.drop_factors();
    }

    /// Solves for every channel of normalised values.
    pub(in crate::smooth) fn solve(
        &mut self,
        mesh: &TriMesh,
        channels: &[Channel],
        epsilon: f64,
        attraction: &Attraction,
        manner: Manner,
        progress: Progress<'_>,
    ) -> Result<Solved> {
        self.prepare_mass(mesh, attraction)?;
        let Some((_, mass)) = &self.mass else { return Err(SolveError::PatternMismatch {}.into()) };
        let restrict = |channel: &Channel| Load {
            field: self.unknowns.iter().map(|&v| channel.normalized[v as usize]).collect(),
            offset: Vec::new(),
        };
        let loads: Vec<Load> = channels.iter().map(restrict).collect();
        let scale = epsilon.max(1.0);
        let problem = Problem {
            matrix: &self.laplacian,
            order: Order::Squared,
            weights: self.weights.as_deref(),
            pull: Some(Pull { mass, epsilon: epsilon / scale }),
            scale,
            inner: manner.symmetric.then_some(Inner { matrix: &self.laplacian, weights: self.weights.as_deref() }),
            splits: manner.symmetric
                && match attraction {
                    Attraction::Metric(metric, _) => self.weights.is_some() || *metric == Metric::Identity,
                    Attraction::Constraints { .. } => false,
                },
        };
        let heaviest = (0..self.unknowns.len()).map(|i| mass.diagonal(i)).fold(0.0, f64::max);
        if let Some(&column) = self.unknowns.first()
            && problem.epsilon() * heaviest < SMALLEST_WEIGHT
        {
            return Err(SolveError::NotPositiveDefinite { column: column as usize }.into());
        }
        let task = Task { problem, key: (epsilon, self.revision), loads: &loads, manner };
        let answer = self.routes.solve(&task, progress).map_err(|error| by_vertex(&self.unknowns, error))?;
        Ok(solved(&problem, &loads, answer))
    }

    fn prepare_mass(&mut self, mesh: &TriMesh, attraction: &Attraction) -> Result<()> {
        if self.mass.as_ref().is_some_and(|(known, _)| known.is_the_same(attraction)) {
            return Ok(());
        }
        let mass = match attraction {
            Attraction::Metric(Metric::Identity, _) => Mass::Identity,
            Attraction::Metric(Metric::Mass, scale) => {
                Mass::Matrix(submatrix(&galerkin_mass(mesh, *scale)?, &self.unknowns))
            }
            Attraction::Metric(Metric::Lumped, scale) => {
                let diagonal = lumped_mass_diagonal(mesh, *scale)?;
                Mass::Diagonal(self.unknowns.iter().map(|&v| diagonal[v as usize]).collect())
            }
            Attraction::Constraints { vertices, weights } => {
                let mut diagonal = vec![0.0; self.unknowns.len()];
                for (vertex, &weight) in vertices.iter().zip(weights) {
                    if let Ok(place) = self.unknowns.binary_search(vertex) {
                        diagonal[place] = weight;
                    }
                }
                Mass::Diagonal(diagonal)
            }
        };
        self.mass = Some((attraction.clone(), mass));
        self.revision = self.revision.wrapping_add(1);
        Ok(())
    }
}

impl Attraction {
    fn is_the_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Metric(Metric::Identity, _), Self::Metric(Metric::Identity, _)) => true,
            _ => self == other,
        }
    }
}
