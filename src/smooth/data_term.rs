//! The data term ‖x − f‖²_B of eqs. (3), (5) and (7) of \[Patane09\]: what it is made from, and its matrix B.

use std::sync::Arc;

use nalgebra_sparse::CscMatrix;

use super::Metric;
use crate::error::Result;
use crate::mesh::TriMesh;
use crate::operators::{MassKind, MassOptions, MassScale, lumped_mass_diagonal, mass};
use crate::solve::{Twofold, submatrix, transposed_product, transposed_product_twofold};
use crate::support::watch::Watch;

/// The work with an entry of a matrix that is copied.
const COPIED: u64 = 10;

/// What B is made from. Equal ones have equal matrices, so that this says what a factor belongs to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DataTerm {
    pub(super) norm: Norm,
    /// The vertices whose values are missing, ascending: B is zero there, PBP with the projection P to the others.
    pub(super) missing: Arc<[u32]>,
}

/// The norm that a data term is measured in.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Norm {
    /// All vertices count alike.
    Identity,
    /// The Galerkin mass matrix.
    Galerkin(MassScale),
    /// The lumped mass matrix.
    Lumped(MassScale),
    /// The Δ of eq. (7): some vertices count, each with its weight.
    Weights { vertices: Vec<u32>, weights: Vec<f64> },
}

impl Norm {
    pub(super) fn new(metric: Metric, scale: MassScale) -> Self {
        match metric {
            Metric::Identity => Self::Identity,
            Metric::Mass => Self::Galerkin(scale),
            Metric::Lumped => Self::Lumped(scale),
        }
    }
}

impl DataTerm {
    /// B on the unknowns, which ascend.
    pub(super) fn matrix(&self, mesh: &TriMesh, unknowns: &[u32], watch: &Watch<'_>) -> Result<Mass> {
        let is_missing = |v: &u32| self.missing.binary_search(v).is_ok();
        let mut diagonal = match &self.norm {
            Norm::Identity if self.missing.is_empty() => return Ok(Mass::Identity),
            Norm::Identity => vec![1.0; unknowns.len()],
            Norm::Galerkin(scale) => {
                let whole = mass(mesh, &MassOptions { kind: MassKind::Galerkin, scale: *scale }, watch)?;
                watch.tick(COPIED * whole.nnz() as u64)?;
                let mut matrix = submatrix(&whole, unknowns);
                drop(whole);
                if self.missing.is_empty() {
                    return Ok(Mass::Matrix(matrix));
                }
                let missing: Vec<bool> = unknowns.iter().map(is_missing).collect();
                for (row, column, value) in matrix.triplet_iter_mut() {
                    *value = if missing[row] || missing[column] { 0.0 } else { *value };
                }
                return Ok(Mass::Partial(matrix));
            }
            Norm::Lumped(scale) => {
                let diagonal = lumped_mass_diagonal(mesh, *scale)?;
                unknowns.iter().map(|&v| diagonal[v as usize]).collect()
            }
            Norm::Weights { vertices, weights } => {
                let mut diagonal = vec![0.0; unknowns.len()];
                for (vertex, &weight) in vertices.iter().zip(weights) {
                    if let Ok(place) = unknowns.binary_search(vertex) {
                        diagonal[place] = weight;
                    }
                }
                diagonal
            }
        };
        if !self.missing.is_empty() {
            for (v, entry) in unknowns.iter().zip(&mut diagonal) {
                *entry = if is_missing(v) { 0.0 } else { *entry };
            }
        }
        Ok(Mass::Diagonal(diagonal))
    }
}

/// B on the unknowns.
#[derive(Debug)]
pub(super) enum Mass {
    Identity,
    /// Zeros where the data term does not reach.
    Diagonal(Vec<f64>),
    /// The Galerkin mass matrix.
    Matrix(CscMatrix<f64>),
    /// The Galerkin mass matrix with zeros in the rows and columns of vertices whose values are missing.
    Partial(CscMatrix<f64>),
}

impl Mass {
    #[inline(never)]
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        match self {
            Self::Identity => x.to_vec(),
            Self::Diagonal(diagonal) => diagonal.iter().zip(x).map(|(d, x)| d * x).collect(),
            // Symmetric, so the product that gathers serves.
            Self::Matrix(matrix) | Self::Partial(matrix) => transposed_product(matrix, x),
        }
    }

    /// B times x, in twice the precision.
    pub(super) fn times_twofold(&self, x: &[Twofold]) -> Vec<Twofold> {
        match self {
            Self::Identity => x.to_vec(),
            Self::Diagonal(diagonal) => diagonal.iter().zip(x).map(|(&d, x)| x.times(d)).collect(),
            Self::Matrix(matrix) | Self::Partial(matrix) => transposed_product_twofold(matrix, x),
        }
    }

    pub(super) fn diagonal(&self, i: usize) -> f64 {
        match self {
            Self::Identity => 1.0,
            Self::Diagonal(diagonal) => diagonal[i],
            Self::Matrix(matrix) | Self::Partial(matrix) => {
                matrix.get_entry(i, i).map_or(0.0, |entry| entry.into_value())
            }
        }
    }

    /// Whether some unknowns are beyond the data term: what is made from it alone then is a rough preconditioner.
    pub(super) fn has_gaps(&self) -> bool {
        match self {
            Self::Identity | Self::Matrix(_) => false,
            Self::Diagonal(diagonal) => diagonal.contains(&0.0),
            Self::Partial(_) => true,
        }
    }

    /// ‖x‖_B
    pub(super) fn norm(&self, x: &[f64]) -> f64 {
        let square: f64 = self.times(x).iter().zip(x).map(|(a, b)| a * b).sum();
        square.max(0.0).sqrt()
    }
}
