//! The systems of interpolation, eq. (6) of \[Patane09\]: the values of some vertices are fixed, and the others are unknowns.

use std::sync::Arc;

use nalgebra_sparse::CscMatrix;

use super::{COPIED, ENTRY, Solved, ensure_solving, on_mesh, solved};
use crate::error::Result;
use crate::operators::{MassScale, lumped_mass_diagonal};
use crate::smooth::Operator;
use crate::smooth::channels::Channel;
use crate::smooth::operators::Operators;
use crate::smooth::routes::{FactorKey, Form, Problem, RightHandSide, Routes, SolverSettings, SymmetricPart, Task};
use crate::smooth::schedule::Stages;
use crate::solve::{columns, product, submatrix};
use crate::support::memory;
use crate::support::named::named;
use crate::support::watch::Watch;

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

named! { Energy { Harmonic = "harmonic", Biharmonic = "biharmonic" } }

/// Everything about the system of one set of fixed vertices.
#[derive(Debug)]
pub(in crate::smooth) struct ReducedSystem {
    /// The vertices that are unknowns, ascending.
    free: Arc<[u32]>,
    /// The matrix whose image is made small: L on the free vertices, or for the biharmonic energy the free columns with all rows.
    matrix: CscMatrix<f64>,
    equations: Equations,
    routes: Routes,
}

/// What kind of system it is.
#[derive(Debug)]
enum Equations {
    /// The harmonic energy with a symmetric L.
    Harmonic,
    /// The harmonic energy with another L, by normal equations.
    HarmonicSquared,
    /// The biharmonic energy.
    Biharmonic {
        /// The diagonal of W, for all vertices.
        weights: Option<Vec<f64>>,
        /// L on the free vertices, where it is symmetric, and W there.
        symmetric_part: Option<(CscMatrix<f64>, Option<Vec<f64>>)>,
    },
}

impl ReducedSystem {
    pub(in crate::smooth) fn new(
        operators: &Operators,
        energy: Energy,
        free: &[u32],
        watch: &Watch<'_>,
    ) -> Result<Self> {
        let laplacian = &operators.laplacian;
        // The matrix, and what is symmetric of it.
        memory::ensure(2 * ENTRY * laplacian.nnz() as u64)?;
        watch.tick(COPIED * laplacian.nnz() as u64)?;
        let equations = match (energy, operators.is_symmetric()) {
            (Energy::Harmonic, true) => Equations::Harmonic,
            (Energy::Harmonic, false) => Equations::HarmonicSquared,
            (Energy::Biharmonic, is_symmetric) => {
                let weights = weights(operators)?;
                let at_free = |w: &Vec<f64>| free.iter().map(|&v| w[v as usize]).collect();
                let symmetric_part = is_symmetric.then(|| (submatrix(laplacian, free), weights.as_ref().map(at_free)));
                Equations::Biharmonic { weights, symmetric_part }
            }
        };
        watch.tick(COPIED * laplacian.nnz() as u64)?;
        let matrix = match energy {
            Energy::Harmonic => submatrix(laplacian, free),
            Energy::Biharmonic => columns(laplacian, free),
        };
        Ok(Self { matrix, equations, free: free.into(), routes: Routes::default() })
    }

    /// Whether this is the system for these unknowns.
    pub(in crate::smooth) fn is_for(&self, energy: Energy, free: &[u32]) -> bool {
        self.energy() == energy && *self.free == *free
    }

    pub(in crate::smooth) fn energy(&self) -> Energy {
        match self.equations {
            Equations::Harmonic | Equations::HarmonicSquared => Energy::Harmonic,
            Equations::Biharmonic { .. } => Energy::Biharmonic,
        }
    }

    /// Whether the matrix of the system is the square of the one whose image is made small.
    pub(in crate::smooth) fn is_squared(&self) -> bool {
        !matches!(self.equations, Equations::Harmonic)
    }

    /// √W at the row of a vertex; 0 where the system has no such row.
    pub(in crate::smooth) fn row_scale(&self, vertex: usize) -> f64 {
        match &self.equations {
            Equations::Harmonic | Equations::HarmonicSquared => {
                f64::from(u8::from(self.free.binary_search(&(vertex as u32)).is_ok()))
            }
            Equations::Biharmonic { weights: Some(weights), .. } => weights[vertex].sqrt(),
            Equations::Biharmonic { weights: None, .. } => 1.0,
        }
    }

    /// Gives the memory of the last factor back.
    pub(in crate::smooth) fn drop_factor(&mut self) {
        self.routes.drop_factors();
    }

    pub(in crate::smooth) fn free(&self) -> &Arc<[u32]> {
        &self.free
    }

    /// Solves for every channel of normalised values, of which those at free vertices do not matter.
    pub(in crate::smooth) fn solve(
        &mut self,
        laplacian: &CscMatrix<f64>,
        channels: &[Channel],
        settings: SolverSettings,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Solved> {
        ensure_solving(self.matrix.nrows(), channels.len())?;
        let right_hand_sides: Vec<RightHandSide> =
            channels.iter().map(|channel| self.right_hand_side(laplacian, &channel.normalized)).collect();
        let problem = problem(&self.matrix, &self.equations);
        let task = Task { problem, key: &FactorKey::Plain, right_hand_sides: &right_hand_sides, settings };
        let answer = self.routes.solve(&task, stages).map_err(|error| on_mesh(&self.free, error))?;
        Ok(solved(&problem, &right_hand_sides, answer, settings.accuracy, stages.watch)?)
    }

    /// c: what L makes of the fixed values alone.
    fn right_hand_side(&self, laplacian: &CscMatrix<f64>, values: &[f64]) -> RightHandSide {
        let mut fixed = values.to_vec();
        for &v in &*self.free {
            fixed[v as usize] = 0.0;
        }
        let image = product(laplacian, &fixed);
        let offset = match self.energy() {
            Energy::Biharmonic => image,
            Energy::Harmonic => self.free.iter().map(|&v| image[v as usize]).collect(),
        };
        RightHandSide { field: Vec::new(), offset }
    }
}

/// The diagonal of W of the biharmonic energy, for all vertices: the inverse lumped masses for the finite-element operator.
fn weights(operators: &Operators) -> Result<Option<Vec<f64>>> {
    if operators.options.operator == Operator::Paper {
        return Ok(None);
    }
    let areas = lumped_mass_diagonal(&operators.mesh, MassScale::Raw)?;
    // Rows without a usable area belong to vertices that are not active.
    let inverse = |area: &f64| Some(area.recip()).filter(|x| x.is_finite()).unwrap_or(0.0);
    Ok(Some(areas.iter().map(inverse).collect()))
}

fn problem<'a>(matrix: &'a CscMatrix<f64>, equations: &'a Equations) -> Problem<'a> {
    let form = match equations {
        Equations::Harmonic => Form::Symmetric,
        Equations::HarmonicSquared => Form::Normal { weights: None, symmetric_part: None },
        Equations::Biharmonic { weights, symmetric_part } => {
            let part = symmetric_part.as_ref();
            let symmetric_part = part.map(|(matrix, weights)| SymmetricPart { matrix, weights: weights.as_deref() });
            Form::Normal { weights: weights.as_deref(), symmetric_part }
        }
    };
    Problem { matrix, form }
}
