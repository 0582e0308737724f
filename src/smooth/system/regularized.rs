//! (LᵀWL + εB) x = εBf on the active vertices.

use std::sync::Arc;

use nalgebra_sparse::CscMatrix;

use super::{COPIED, ENTRY, Solved, ensure_solving, on_mesh, solved};
use crate::error::{Result, SmoothError};
use crate::operators::{MassScale, lumped_mass_diagonal};
use crate::smooth::channels::Channel;
use crate::smooth::data_term::{DataTerm, Mass, Norm};
use crate::smooth::operators::Operators;
use crate::smooth::routes::{
    Accuracy, DataPart, FactorKey, Form, Problem, RightHandSide, Routes, Solutions, SolverSettings, Square, Symmetry,
    Task,
};
use crate::smooth::schedule::{Stages, Work};
use crate::smooth::{Operator, Precision, SolverChoice};
use crate::solve::{CholeskyFactor, submatrix};
use crate::support::memory;
use crate::support::watch::Watch;

/// Below this, εB loses digits to underflow, and at last the right-hand side is zero.
const SMALLEST_WEIGHT: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// Everything about such a system that outlives one ε.
///
/// A family of all ε solves this system for one ε after the other, with right-hand sides of its own, on one analysis.
#[derive(Debug)]
pub(in crate::smooth) struct RegularizedSystem {
    matrices: Arc<Matrices>,
    routes: Routes,
}

/// The matrices that the system is made from, shared with the families of its solutions.
#[derive(Debug)]
pub(in crate::smooth) struct Matrices {
    /// The vertices that are unknowns, ascending.
    unknowns: Arc<[u32]>,
    /// L on the unknowns.
    laplacian: Arc<CscMatrix<f64>>,
    /// The diagonal of W: the inverse lumped masses for the finite-element operator, nothing for the paper's.
    weights: Option<Arc<[f64]>>,
    is_symmetric: bool,
    /// The data term, and its matrix B.
    term: Arc<DataTerm>,
    mass: Mass,
}

impl RegularizedSystem {
    /// `unknowns`: ascending vertices that L ties to no others.
    pub(in crate::smooth) fn new(
        operators: &Operators,
        unknowns: &[u32],
        term: &Arc<DataTerm>,
        watch: &Watch<'_>,
    ) -> Result<Self> {
        // L, and B with the matrix that it is cut from.
        memory::ensure(4 * ENTRY * operators.laplacian.nnz() as u64)?;
        watch.tick(COPIED * operators.laplacian.nnz() as u64)?;
        let all = unknowns.len() == operators.laplacian.ncols();
        let laplacian = if all { operators.laplacian.clone() } else { submatrix(&operators.laplacian, unknowns) };
        let weights = match operators.options.operator {
            Operator::Paper => None,
            Operator::Fem => {
                let areas = lumped_mass_diagonal(&operators.mesh, MassScale::Raw)?;
                Some(unknowns.iter().map(|&v| areas[v as usize].recip()).collect::<Arc<[f64]>>())
            }
        };
        let matrices = Matrices {
            laplacian: Arc::new(laplacian),
            weights,
            is_symmetric: operators.is_symmetric(),
            mass: term.matrix(&operators.mesh, unknowns, watch)?,
            term: Arc::clone(term),
            unknowns: unknowns.into(),
        };
        Ok(Self { matrices: Arc::new(matrices), routes: Routes::default() })
    }

    pub(in crate::smooth) fn unknowns(&self) -> &Arc<[u32]> {
        &self.matrices.unknowns
    }

    /// B.
    pub(in crate::smooth) fn mass(&self) -> &Mass {
        &self.matrices.mass
    }

    pub(in crate::smooth) fn matrices(&self) -> &Arc<Matrices> {
        &self.matrices
    }

    /// Takes another data term; analyses stay.
    pub(in crate::smooth) fn set_term(
        &mut self,
        operators: &Operators,
        term: &Arc<DataTerm>,
        watch: &Watch<'_>,
    ) -> Result<()> {
        let matrices = &self.matrices;
        if matrices.term != *term {
            memory::ensure(3 * ENTRY * matrices.laplacian.nnz() as u64)?;
            self.matrices = Arc::new(Matrices {
                unknowns: Arc::clone(&matrices.unknowns),
                laplacian: Arc::clone(&matrices.laplacian),
                weights: matrices.weights.clone(),
                is_symmetric: matrices.is_symmetric,
                mass: term.matrix(&operators.mesh, &matrices.unknowns, watch)?,
                term: Arc::clone(term),
            });
        }
        Ok(())
    }

    /// Gives the memory of the last factor back.
    pub(in crate::smooth) fn drop_factor(&mut self) {
        self.routes.drop_factors();
    }

    /// See [`Routes::forecast`].
    pub(in crate::smooth) fn forecast(&self, epsilon: f64, settings: SolverSettings) -> (Work, bool, bool) {
        self.routes.forecast(&self.matrices.problem(epsilon), &self.matrices.key(epsilon), settings)
    }

    /// The matrix for an ε with its analysis, for a method that adds to it and factors it itself.
    pub(in crate::smooth) fn square(&mut self, epsilon: f64, watch: &Watch<'_>) -> Result<Square> {
        let Self { matrices, routes } = self;
        let settings = SolverSettings {
            choice: SolverChoice::Cholesky,
            precision: Precision::Double,
            bounds: false,
            accuracy: Accuracy::Full,
            solutions: Solutions::Few,
        };
        let problem = matrices.problem(epsilon);
        let task = Task { problem, key: &matrices.key(epsilon), right_hand_sides: &[], settings };
        routes.square(&task, watch).map_err(|error| on_mesh(&matrices.unknowns, error))
    }

    /// Takes back the factor of that matrix, for the next call.
    pub(in crate::smooth) fn keep_factor(&mut self, epsilon: f64, factor: CholeskyFactor<f64>) {
        self.routes.keep(&self.matrices.key(epsilon), factor);
    }

    /// Solves for every channel of normalised values.
    pub(in crate::smooth) fn solve(
        &mut self,
        channels: &[Channel],
        epsilon: f64,
        settings: SolverSettings,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Solved> {
        let fields = channels.iter().map(|channel| self.matrices.restrict(&channel.normalized)).collect();
        self.solve_fields(fields, epsilon, settings, stages)
    }

    /// Solves for fields at the unknowns.
    pub(in crate::smooth) fn solve_fields(
        &mut self,
        fields: Vec<Vec<f64>>,
        epsilon: f64,
        settings: SolverSettings,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Solved> {
        let Self { matrices, routes } = self;
        ensure_solving(matrices.unknowns.len(), fields.len())?;
        let unknowns = &matrices.unknowns;
        let right_hand_sides: Vec<RightHandSide> =
            fields.into_iter().map(|field| RightHandSide { field, offset: Vec::new() }).collect();
        let problem = matrices.problem(epsilon);
        let heaviest = (0..unknowns.len()).map(|i| matrices.mass.diagonal(i)).fold(0.0, f64::max);
        let scaled = problem.data().map_or(0.0, |data| data.scaled_epsilon());
        if let Some(&column) = unknowns.first()
            && scaled * heaviest < SMALLEST_WEIGHT
        {
            return Err(SmoothError::NotPositiveDefinite { column: column as usize }.into());
        }
        let task = Task { problem, key: &matrices.key(epsilon), right_hand_sides: &right_hand_sides, settings };
        let answer = routes.solve(&task, stages).map_err(|error| on_mesh(unknowns, error))?;
        Ok(solved(&problem, &right_hand_sides, answer, settings.accuracy, stages.watch)?)
    }
}

impl Matrices {
    /// A field's values at the unknowns.
    pub(in crate::smooth) fn restrict(&self, field: &[f64]) -> Vec<f64> {
        self.unknowns.iter().map(|&v| field[v as usize]).collect()
    }

    pub(in crate::smooth) fn unknowns(&self) -> &Arc<[u32]> {
        &self.unknowns
    }

    pub(in crate::smooth) fn is_symmetric(&self) -> bool {
        self.is_symmetric
    }

    pub(in crate::smooth) fn term(&self) -> &Arc<DataTerm> {
        &self.term
    }

    /// L on the unknowns.
    pub(in crate::smooth) fn laplacian(&self) -> &CscMatrix<f64> {
        &self.laplacian
    }

    /// The diagonal of W; nothing for the identity.
    pub(in crate::smooth) fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// B.
    pub(in crate::smooth) fn mass(&self) -> &Mass {
        &self.mass
    }

    fn key(&self, epsilon: f64) -> FactorKey {
        FactorKey::Regularized { epsilon, term: Arc::clone(&self.term) }
    }

    /// The system for an ε.
    pub(in crate::smooth) fn problem(&self, epsilon: f64) -> Problem<'_> {
        let DataTerm { norm, missing } = &*self.term;
        let is_inverse = match (&self.weights, norm) {
            (None, Norm::Identity) | (Some(_), Norm::Lumped(MassScale::Raw)) => missing.is_empty(),
            _ => false,
        };
        let symmetry = match (self.is_symmetric, is_inverse) {
            (false, _) => Symmetry::Unsymmetric,
            (true, false) => Symmetry::Symmetric,
            (true, true) => Symmetry::Product,
        };
        let data = DataPart { mass: &self.mass, epsilon };
        let form = Form::Regularized { weights: self.weights.as_deref(), data, symmetry };
        Problem { matrix: &self.laplacian, form }
    }
}
