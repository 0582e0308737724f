//! The systems of interpolation, eq. (6) of \[Patane09\]: the values of some vertices are fixed, and the others are unknowns.

use nalgebra_sparse::CscMatrix;

use super::{Solved, by_vertex, solved};
use crate::error::Result;
use crate::mesh::TriMesh;
use crate::operators::{MassScale, lumped_mass_diagonal};
use crate::smooth::routes::{Inner, Load, Manner, Order, Problem, Routes, Task};
use crate::smooth::{Operator, Progress};
use crate::solve::{columns, product, submatrix};

/// What interpolation makes least.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Energy {
    /// The reduced system of \[Patane09, section 4.3.1\]: Lx = 0 at the free vertices, with the least xᵀLx where L is symmetric.
    /// Has no extremum at a free vertex where no weight is negative. The default.
    #[default]
    Harmonic,
    /// ‖Lx‖ (xᵀLM⁻¹Lx for the finite-element operator), as \[Patane09, eq. 6\] is stated: smoother, but may overshoot.
    Biharmonic,
}

/// Everything about the system of one set of fixed vertices.
#[derive(Debug)]
pub(in crate::smooth) struct ReducedSystem {
    energy: Energy,
    /// The vertices that are unknowns, ascending.
    free: Vec<u32>,
    /// The matrix whose image is made small: L on the free vertices, or for the biharmonic energy the free columns with all rows.
    matrix: CscMatrix<f64>,
    /// L on the free vertices beside it, where that is symmetric.
    inner: Option<CscMatrix<f64>>,
    /// The diagonal of W, for all vertices and for the free ones.
    weights: Option<Vec<f64>>,
    inner_weights: Option<Vec<f64>>,
    routes: Routes,
}

impl ReducedSystem {
    pub(in crate::smooth) fn new(
        mesh: &TriMesh,
        laplacian: &CscMatrix<f64>,
        operator: Operator,
        symmetric: bool,
        energy: Energy,
        free: Vec<u32>,
    ) -> Result<Self> {
        let harmonic = energy == Energy::Harmonic;
        let weights: Option<Vec<f64>> = match operator {
            Operator::Fem if !harmonic => {
                let areas = lumped_mass_diagonal(mesh, MassScale::Raw)?;
                // Rows without a usable area belong to vertices that are not reached.
                let inverse = |area: &f64| Some(area.recip()).filter(|x| x.is_finite()).unwrap_or(0.0);
                Some(areas.iter().map(inverse).collect())
            }
            _ => None,
        };
        Ok(Self {
            energy,
            matrix: if harmonic { submatrix(laplacian, &free) } else { columns(laplacian, &free) },
            inner: (symmetric && !harmonic).then(|| submatrix(laplacian, &free)),
            inner_weights: weights.as_ref().map(|w| free.iter().map(|&v| w[v as usize]).collect()),
            free,
            weights,
            routes: Routes::default(),
        })
    }

    /// Whether this is the system for these unknowns.
    pub(in crate::smooth) fn is_for(&self, energy: Energy, free: &[u32]) -> bool {
        self.energy == energy && self.free == free
    }

    pub(in crate::smooth) fn energy(&self) -> Energy {
        self.energy
    }

    /// √W at the row of a vertex; 0 where the system has no such row.
    pub(in crate::smooth) fn row_scale(&self, vertex: usize) -> f64 {
        match (self.energy, &self.weights) {
            (Energy::Harmonic, _) => f64::from(u8::from(self.free.binary_search(&(vertex as u32)).is_ok())),
            (Energy::Biharmonic, Some(weights)) => weights[vertex].sqrt(),
            (Energy::Biharmonic, None) => 1.0,
        }
    }

    /// Gives the memory of the last factor back.
    pub(in crate::smooth) fn drop_factor(&mut self) {
        self.routes.drop_factors();
    }

    pub(in crate::smooth) fn free(&self) -> &[u32] {
        &self.free
    }

    /// Solves for every channel of normalised values, of which those at free vertices do not matter.
    pub(in crate::smooth) fn solve(
        &mut self,
        laplacian: &CscMatrix<f64>,
        channels: &[&[f64]],
        manner: Manner,
        progress: Progress<'_>,
    ) -> Result<Solved> {
        let loads: Vec<Load> = channels.iter().map(|values| self.load(laplacian, values)).collect();
        let harmonic = self.energy == Energy::Harmonic;
        let inner = if harmonic { Some(&self.matrix) } else { self.inner.as_ref() };
        let problem = Problem {
            matrix: &self.matrix,
            order: if harmonic && manner.symmetric { Order::First } else { Order::Squared },
            weights: self.weights.as_deref(),
            pull: None,
            scale: 1.0,
            inner: inner
                .filter(|_| manner.symmetric)
                .map(|matrix| Inner { matrix, weights: self.inner_weights.as_deref() }),
            splits: false,
        };
        let task = Task { problem, key: (0.0, 0), loads: &loads, manner };
        let answer = self.routes.solve(&task, progress).map_err(|error| by_vertex(&self.free, error))?;
        Ok(solved(&problem, &loads, answer))
    }

    /// c: what L makes of the fixed values alone.
    fn load(&self, laplacian: &CscMatrix<f64>, values: &[f64]) -> Load {
        let mut fixed = values.to_vec();
        for &v in &self.free {
            fixed[v as usize] = 0.0;
        }
        let image = product(laplacian, &fixed);
        let offset = match self.energy {
            Energy::Biharmonic => image,
            Energy::Harmonic => self.free.iter().map(|&v| image[v as usize]).collect(),
        };
        Load { field: Vec::new(), offset }
    }
}
