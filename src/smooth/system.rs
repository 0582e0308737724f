//! The matrix LᵀWL + εB on the vertices that the operators reach.

use nalgebra_sparse::CscMatrix;

use super::routes::{Routes, Task};
use super::tikhonov::{Channel, Metric, TikhonovOptions};
use super::{Operator, Progress, SmootherOptions};
use crate::error::{Error, Result, SolveError};
use crate::mesh::{LinkKind, TriMesh};
use crate::operators::{MassScale, galerkin_mass, lumped_mass_diagonal};
use crate::solve::{norm, product, submatrix, transposed_product};

/// Below this, εB loses digits to underflow, and at last the right-hand side is zero.
const SMALLEST_WEIGHT: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// Everything about a Tikhonov system that outlives one ε.
#[derive(Debug)]
pub(super) struct TikhonovSystem {
    /// The vertices that are unknowns, ascending.
    active: Vec<u32>,
    /// L on the unknowns.
    laplacian: CscMatrix<f64>,
    mass: Option<(Metric, MassScale, Mass)>,
    /// The diagonal of W: the inverse lumped masses for the finite-element operator, nothing for the paper's.
    weights: Option<Vec<f64>>,
    routes: Routes,
}

/// B on the unknowns.
#[derive(Debug)]
pub(super) enum Mass {
    Identity,
    Diagonal(Vec<f64>),
    Matrix(CscMatrix<f64>),
}

/// (LᵀWL/scale + εB) x = εBf
#[derive(Clone, Copy)]
pub(super) struct Problem<'a> {
    pub(super) laplacian: &'a CscMatrix<f64>,
    pub(super) weights: Option<&'a [f64]>,
    pub(super) mass: &'a Mass,
    /// ε/scale.
    pub(super) epsilon: f64,
    /// The system is divided by this, so that neither a huge nor a tiny ε leaves the range of double precision.
    pub(super) scale: f64,
    /// Whether L is symmetric.
    pub(super) symmetric: bool,
}

/// One solved channel.
pub(super) struct Solution {
    /// Per vertex; none where the vertex is no unknown and keeps its value.
    pub(super) values: Vec<Option<f64>>,
    /// ‖x − f‖_B.
    pub(super) metric_norm: f64,
    /// ‖εBf − (LᵀWL + εB)x‖₂ / ‖εBf‖₂ in factored form.
    pub(super) relative_residual: f64,
    pub(super) refinement_steps: usize,
    pub(super) iterations: usize,
}

/// All channels, and what the solver was.
pub(super) struct Solved {
    pub(super) solutions: Vec<Solution>,
    pub(super) route: &'static str,
    pub(super) precision: &'static str,
    pub(super) unknowns: usize,
    pub(super) factor_nonzeros: u64,
}

impl TikhonovSystem {
    pub(super) fn new(mesh: &TriMesh, laplacian: &CscMatrix<f64>, operator: Operator) -> Result<Self> {
        let areas = lumped_mass_diagonal(mesh, MassScale::Raw)?;
        let kinds = mesh.connectivity().link_kinds();
        // Without area and without a weight in L nothing ties a vertex to the others: its row of the system is zero.
        let active: Vec<u32> = laplacian
            .col_iter()
            .enumerate()
            .filter(|(v, column)| {
                let tied = areas[*v] > 0.0 || column.values().iter().any(|&x| x != 0.0);
                // The finite-element operator divides by areas.
                kinds[*v] != LinkKind::Isolated
                    && tied
                    && (operator == Operator::Paper || areas[*v].recip().is_finite())
            })
            .map(|(v, _)| v as u32)
            .collect();
        let laplacian =
            if active.len() == laplacian.ncols() { laplacian.clone() } else { submatrix(laplacian, &active) };
        let weights = (operator == Operator::Fem).then(|| active.iter().map(|&v| areas[v as usize].recip()).collect());
        Ok(Self { active, laplacian, mass: None, weights, routes: Routes::default() })
    }

    /// Solves for every channel of normalised values.
    pub(super) fn solve(
        &mut self,
        mesh: &TriMesh,
        channels: &[Channel],
        options: &TikhonovOptions,
        smoother: &SmootherOptions,
        progress: Progress<'_>,
    ) -> Result<Solved> {
        self.prepare_mass(mesh, options, smoother.operator)?;
        let Some((metric, mass_scale, mass)) = &self.mass else { return Err(SolveError::PatternMismatch {}.into()) };
        let fields: Vec<Vec<f64>> =
            channels.iter().map(|c| self.active.iter().map(|&v| c.normalized[v as usize]).collect()).collect();
        let scale = options.epsilon.max(1.0);
        let problem = Problem {
            laplacian: &self.laplacian,
            weights: self.weights.as_deref(),
            mass,
            epsilon: options.epsilon / scale,
            scale,
            symmetric: smoother.weights.is_symmetric(),
        };
        let heaviest = (0..self.active.len()).map(|i| mass.diagonal(i)).fold(0.0, f64::max);
        if let Some(&column) = self.active.first()
            && problem.epsilon * heaviest < SMALLEST_WEIGHT
        {
            return Err(SolveError::NotPositiveDefinite { column: column as usize }.into());
        }
        let task = Task {
            problem,
            key: (options.epsilon, *metric, *mass_scale),
            fields: &fields,
            choice: smoother.solver,
            precision: smoother.precision,
        };
        let answer = self.routes.solve(&task, progress).map_err(|error| self.by_vertex(error))?;
        let solutions = answer
            .iterates
            .into_iter()
            .zip(&fields)
            .map(|(iterate, f)| {
                let mut values = vec![None; mesh.vertex_count()];
                for (&v, &x) in self.active.iter().zip(&iterate.x) {
                    values[v as usize] = Some(x);
                }
                Solution {
                    values,
                    metric_norm: mass.norm(&difference(&iterate.x, f)),
                    relative_residual: problem.relative_residual(f, &iterate.x),
                    refinement_steps: iterate.refinement_steps,
                    iterations: iterate.iterations,
                }
            })
            .collect();
        Ok(Solved {
            solutions,
            route: answer.route,
            precision: answer.precision,
            unknowns: self.active.len(),
            factor_nonzeros: answer.factor_nonzeros,
        })
    }

    /// Unknowns are vertices to the user.
    fn by_vertex(&self, error: SolveError) -> Error {
        match error {
            SolveError::NotPositiveDefinite { column } => {
                let column = self.active.get(column).map_or(column, |&v| v as usize);
                SolveError::NotPositiveDefinite { column }.into()
            }
            SolveError::NonFiniteEntry { row } => {
                let row = self.active.get(row).map_or(row, |&v| v as usize);
                SolveError::NonFiniteEntry { row }.into()
            }
            other => other.into(),
        }
    }

    fn prepare_mass(&mut self, mesh: &TriMesh, options: &TikhonovOptions, operator: Operator) -> Result<()> {
        let (metric, mass_scale) = match operator {
            Operator::Paper => (options.metric, options.mass_scale),
            Operator::Fem => (Metric::Lumped, MassScale::Raw),
        };
        if let Some((known_metric, known_scale, _)) = self.mass
            && metric == known_metric
            && (metric == Metric::Identity || mass_scale == known_scale)
        {
            return Ok(());
        }
        let mass = match metric {
            Metric::Identity => Mass::Identity,
            Metric::Mass => Mass::Matrix(submatrix(&galerkin_mass(mesh, mass_scale)?, &self.active)),
            Metric::Lumped => {
                let diagonal = lumped_mass_diagonal(mesh, mass_scale)?;
                Mass::Diagonal(self.active.iter().map(|&v| diagonal[v as usize]).collect())
            }
        };
        self.mass = Some((metric, mass_scale, mass));
        Ok(())
    }
}

fn difference(x: &[f64], f: &[f64]) -> Vec<f64> {
    x.iter().zip(f).map(|(x, f)| x - f).collect()
}

impl Problem<'_> {
    pub(super) fn unknowns(&self) -> usize {
        self.laplacian.ncols()
    }

    /// LᵀWLx/scale: never with an assembled LᵀWL, whose rounding the refinement is there to remove.
    #[inline(never)]
    pub(super) fn smoothing(&self, x: &[f64]) -> Vec<f64> {
        // A symmetric L is its own transpose, and the product with the transpose gathers, which is faster.
        let mut image = if self.symmetric { transposed_product(self.laplacian, x) } else { product(self.laplacian, x) };
        match self.weights {
            Some(weights) => image.iter_mut().zip(weights).for_each(|(y, w)| *y *= w / self.scale),
            None => image.iter_mut().for_each(|y| *y /= self.scale),
        }
        transposed_product(self.laplacian, &image)
    }

    /// εB(f − x) − LᵀWLx/scale
    pub(super) fn residual(&self, f: &[f64], x: &[f64]) -> Vec<f64> {
        let pull = self.mass.times(&difference(f, x));
        pull.iter().zip(self.smoothing(x)).map(|(b, l)| self.epsilon * b - l).collect()
    }

    /// (LᵀWL/scale + εB) x
    pub(super) fn apply(&self, x: &[f64]) -> Vec<f64> {
        self.mass.times(x).iter().zip(self.smoothing(x)).map(|(b, l)| self.epsilon * b + l).collect()
    }

    /// The diagonal of LᵀWL/scale + εB.
    pub(super) fn diagonal(&self) -> Vec<f64> {
        let weight = |row: usize| self.weights.map_or(1.0, |weights| weights[row]);
        let squares = self.laplacian.col_iter().map(|column| {
            let entries = column.row_indices().iter().zip(column.values());
            entries.map(|(&row, v)| v * v * weight(row)).sum::<f64>()
        });
        squares.enumerate().map(|(i, d)| d / self.scale + self.epsilon * self.mass.diagonal(i)).collect()
    }

    fn relative_residual(&self, f: &[f64], x: &[f64]) -> f64 {
        let residual = norm(&self.residual(f, x));
        if residual == 0.0 { 0.0 } else { residual / (self.epsilon * norm(&self.mass.times(f))) }
    }
}

impl Mass {
    #[inline(never)]
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        match self {
            Self::Identity => x.to_vec(),
            Self::Diagonal(diagonal) => diagonal.iter().zip(x).map(|(d, x)| d * x).collect(),
            // Symmetric, so the product that gathers serves.
            Self::Matrix(matrix) => transposed_product(matrix, x),
        }
    }

    pub(super) fn diagonal(&self, i: usize) -> f64 {
        match self {
            Self::Identity => 1.0,
            Self::Diagonal(diagonal) => diagonal[i],
            Self::Matrix(matrix) => matrix.get_entry(i, i).map_or(0.0, |entry| entry.into_value()),
        }
    }

    /// ‖x‖_B
    fn norm(&self, x: &[f64]) -> f64 {
        let square: f64 = self.times(x).iter().zip(x).map(|(a, b)| a * b).sum();
        square.max(0.0).sqrt()
    }
}
