//! The matrix LᵀL + εB on the vertices that the operators reach, and its solution.

use nalgebra_sparse::CscMatrix;

use super::tikhonov::{Metric, TikhonovOptions};
use super::{Phase, Progress, SolverChoice};
use crate::error::{Result, SolveError};
use crate::mesh::{LinkKind, TriMesh};
use crate::operators::{LaplacianWeights, MassScale, galerkin_mass, lumped_mass_diagonal};
use crate::solve::{
    CgOptions, CholeskyAnalysis, CholeskyFactor, Jacobi, Preconditioner, SquaredSum, conjugate_gradient, gram, norm,
    product, submatrix, transposed_product,
};

/// A correction below this fraction of the solution ends the refinement: where refinement contracts at all, the error
/// that is left is about the square of the relative correction.
const SMALL_CORRECTION: f64 = 1e-8;
const MOST_REFINEMENTS: usize = 12;

/// Relative residual of each solution by conjugate gradients: within reach of double precision for every system that
/// refinement can solve; refinement makes up the rest.
const CG_TOLERANCE: f64 = 1e-6;
/// Relative residual that is taken for converged where rounding allows no less.
const ROUGH_RESIDUAL: f64 = 0.5;
/// Ten to twenty iterations do with [`SquaredSum`]; past this many, rounding prevails.
const MOST_SQUARED: usize = 200;
/// The inner tolerance of a second attempt.
const TIGHT: f64 = 1e-8;
/// Below this, εB loses digits to underflow, and at last the right-hand side is zero.
const SMALLEST_WEIGHT: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// Solves for right-hand sides stored one after the other, and adds to their counts of iterations.
type SolveColumns<'a> = &'a mut dyn FnMut(&[f64], &mut [usize]) -> Result<Vec<f64>, SolveError>;

/// Everything about a Tikhonov system that outlives one ε.
#[derive(Debug)]
pub(super) struct TikhonovSystem {
    /// The vertices that are unknowns, ascending.
    active: Vec<u32>,
    /// L on the unknowns.
    laplacian: CscMatrix<f64>,
    symmetric: bool,
    /// LᵀL on the unknowns, and its analysis: made by the first direct solve.
    direct: Option<Direct>,
    mass: Option<(Metric, MassScale, Mass)>,
}

#[derive(Debug)]
struct Direct {
    gram: CscMatrix<f64>,
    analysis: CholeskyAnalysis,
    factor: Option<(f64, Metric, MassScale, CholeskyFactor)>,
}

/// B on the unknowns.
#[derive(Debug)]
enum Mass {
    Identity,
    Diagonal(Vec<f64>),
    Matrix(CscMatrix<f64>),
}

/// One solved channel.
pub(super) struct Solution {
    /// Per vertex; none where the vertex is no unknown and keeps its value.
    pub(super) values: Vec<Option<f64>>,
    /// ‖x − f‖_B.
    pub(super) metric_norm: f64,
    /// ‖εBf − (LᵀL + εB)x‖₂ / ‖εBf‖₂ in factored form.
    pub(super) relative_residual: f64,
    pub(super) refinement_steps: usize,
    pub(super) iterations: usize,
}

/// All channels, and what the solver was.
pub(super) struct Solved {
    pub(super) solutions: Vec<Solution>,
    pub(super) route: &'static str,
    pub(super) unknowns: usize,
    pub(super) factor_nonzeros: u64,
}

impl TikhonovSystem {
    pub(super) fn new(mesh: &TriMesh, laplacian: &CscMatrix<f64>, weights: LaplacianWeights) -> Result<Self> {
        let areas = lumped_mass_diagonal(mesh, MassScale::Raw)?;
        let kinds = mesh.connectivity().link_kinds();
        // Without area and without a weight in L nothing ties a vertex to the others: its row of the system is zero.
        let active: Vec<u32> = laplacian
            .col_iter()
            .enumerate()
            .filter(|(v, column)| {
                kinds[*v] != LinkKind::Isolated && (areas[*v] > 0.0 || column.values().iter().any(|&x| x != 0.0))
            })
            .map(|(v, _)| v as u32)
            .collect();
        let laplacian =
            if active.len() == laplacian.ncols() { laplacian.clone() } else { submatrix(laplacian, &active) };
        Ok(Self { active, laplacian, symmetric: weights.is_symmetric(), direct: None, mass: None })
    }

    /// Solves for every channel of normalised values.
    pub(super) fn solve(
        &mut self,
        mesh: &TriMesh,
        fields: &[Vec<f64>],
        options: &TikhonovOptions,
        solver: SolverChoice,
        progress: Progress<'_>,
    ) -> Result<Solved> {
        self.prepare_mass(mesh, options)?;
        let fields: Vec<Vec<f64>> =
            fields.iter().map(|f| self.active.iter().map(|&v| f[v as usize]).collect()).collect();
        // The system is divided by this, so that neither a huge nor a tiny ε leaves the range of double precision.
        let scale = options.epsilon.max(1.0);
        let epsilon = options.epsilon / scale;
        let heaviest = (0..self.active.len()).map(|i| self.mass().diagonal(i)).fold(0.0, f64::max);
        if !self.active.is_empty() && epsilon * heaviest < SMALLEST_WEIGHT {
            return Err(SolveError::NotPositiveDefinite { column: 0 }.into());
        }
        let (solutions, route, factor_nonzeros) = match solver {
            _ if self.active.is_empty() => (fields.iter().map(|_| Iterate::default()).collect(), "none", 0),
            SolverChoice::ConjugateGradient => {
                progress(Phase::Solve, 0.1);
                (self.iterative(&fields, epsilon, scale)?, "cg", 0)
            }
            SolverChoice::Auto | SolverChoice::Cholesky => {
                self.factorize(options, epsilon, scale, progress)?;
                progress(Phase::Solve, 0.9);
                let nonzeros = self.direct.as_ref().map_or(0, |direct| direct.analysis.size().nonzeros);
                (self.direct(&fields, epsilon, scale)?, "cholesky", nonzeros)
            }
        };
        let solutions = solutions
            .into_iter()
            .zip(&fields)
            .map(|(iterate, f)| self.finish(&iterate, f, mesh.vertex_count(), epsilon, scale))
            .collect();
        Ok(Solved { solutions, route, unknowns: self.active.len(), factor_nonzeros })
    }

    fn prepare_mass(&mut self, mesh: &TriMesh, options: &TikhonovOptions) -> Result<()> {
        if let Some((metric, scale, _)) = self.mass
            && metric == options.metric
            && (metric == Metric::Identity || scale == options.mass_scale)
        {
            return Ok(());
        }
        let mass = match options.metric {
            Metric::Identity => Mass::Identity,
            Metric::Mass => Mass::Matrix(submatrix(&galerkin_mass(mesh, options.mass_scale)?, &self.active)),
            Metric::Lumped => {
                let diagonal = lumped_mass_diagonal(mesh, options.mass_scale)?;
                Mass::Diagonal(self.active.iter().map(|&v| diagonal[v as usize]).collect())
            }
        };
        self.mass = Some((options.metric, options.mass_scale, mass));
        Ok(())
    }

    fn mass(&self) -> &Mass {
        self.mass.as_ref().map_or(&Mass::Identity, |(_, _, mass)| mass)
    }

    fn factorize(
        &mut self,
        options: &TikhonovOptions,
        epsilon: f64,
        scale: f64,
        progress: Progress<'_>,
    ) -> Result<(), SolveError> {
        let mut direct = match self.direct.take() {
            Some(direct) => direct,
            None => {
                progress(Phase::Analysis, 0.0);
                let gram = gram(&self.laplacian)?;
                let analysis = CholeskyAnalysis::new(gram.pattern())?;
                Direct { gram, analysis, factor: None }
            }
        };
        let wanted = (options.epsilon, options.metric, options.mass_scale);
        let factor = match direct.factor.take() {
            Some((epsilon, metric, mass_scale, factor)) if (epsilon, metric, mass_scale) == wanted => Ok(factor),
            previous => {
                progress(Phase::Factorization, 0.2);
                let values = combine(&direct.gram, self.mass(), epsilon, scale);
                match previous {
                    Some((_, _, _, mut factor)) => factor.refactor(&values).map(|()| factor),
                    None => direct.analysis.factor(&values),
                }
            }
        };
        let outcome = factor.map(|factor| direct.factor = Some((wanted.0, wanted.1, wanted.2, factor)));
        self.direct = Some(direct);
        outcome
    }

    /// A⁻¹εBf by the factor.
    fn direct(&self, fields: &[Vec<f64>], epsilon: f64, scale: f64) -> Result<Vec<Iterate>, SolveError> {
        let Some((_, _, _, factor)) = self.direct.as_ref().and_then(|direct| direct.factor.as_ref()) else {
            return Err(SolveError::PatternMismatch {});
        };
        self.refine(fields, epsilon, scale, &mut |right_hand_sides, _| factor.solve(right_hand_sides))
    }

    /// A⁻¹εBf by conjugate gradients with the matrix in factored form.
    fn iterative(&self, fields: &[Vec<f64>], epsilon: f64, scale: f64) -> Result<Vec<Iterate>, SolveError> {
        if self.symmetric {
            // Only ratios matter to a preconditioner, so this is √scale times what is in the system.
            let root = (epsilon * scale).sqrt();
            let diagonal: Vec<f64> = (0..self.active.len()).map(|i| root * self.mass().lumped(i).sqrt()).collect();
            if let Ok(mut squared) = SquaredSum::new(&self.laplacian, &diagonal, SquaredSum::TOLERANCE) {
                let outcome = self.iterate(fields, epsilon, scale, &squared, MOST_SQUARED);
                let Err(SolveError::IndefinitePreconditioner { .. } | SolveError::NotConverged { .. }) = outcome else {
                    return outcome;
                };
                // Rows of needle triangles: a small residual of the inner systems is not yet a solution.
                squared.set_tolerance(TIGHT);
                return self.iterate(fields, epsilon, scale, &squared, MOST_SQUARED);
            }
        }
        let jacobi = Jacobi::new(&self.diagonal(epsilon, scale))?;
        self.iterate(fields, epsilon, scale, &jacobi, CgOptions::default().max_iterations)
    }

    /// The diagonal of LᵀL/scale + εB.
    fn diagonal(&self, epsilon: f64, scale: f64) -> Vec<f64> {
        let columns = self.laplacian.col_iter().enumerate();
        columns
            .map(|(i, column)| {
                let square: f64 = column.values().iter().map(|v| v * v).sum();
                square / scale + epsilon * self.mass().diagonal(i)
            })
            .collect()
    }

    fn iterate(
        &self,
        fields: &[Vec<f64>],
        epsilon: f64,
        scale: f64,
        preconditioner: &dyn Preconditioner,
        max_iterations: usize,
    ) -> Result<Vec<Iterate>, SolveError> {
        let mut apply = |x: &[f64]| {
            let smooth = transposed_product(&self.laplacian, &product(&self.laplacian, x));
            self.mass().times(x).iter().zip(smooth).map(|(b, l)| epsilon * b + l / scale).collect()
        };
        let options = CgOptions { tolerance: CG_TOLERANCE, max_iterations, ..CgOptions::default() };
        self.refine(fields, epsilon, scale, &mut |right_hand_sides, iterations| {
            let mut solutions = vec![0.0; right_hand_sides.len()];
            let n = self.active.len();
            let columns = right_hand_sides.chunks_exact(n).zip(solutions.chunks_exact_mut(n));
            for ((b, x), iterations) in columns.zip(iterations) {
                *iterations += match conjugate_gradient(&mut apply, preconditioner, b, x, &options) {
                    Ok(info) => info.iterations,
                    // What rounding leaves in the residual of small ε is rough, and A⁻¹ hardly feels it: whether the
                    // solution is one is seen by its corrections.
                    Err(SolveError::NotConverged { iterations, residual })
                        if residual < ROUGH_RESIDUAL && iterations < max_iterations =>
                    {
                        iterations
                    }
                    Err(error) => return Err(error),
                };
            }
            Ok(solutions)
        })
    }

    /// Starts from zero and adds A⁻¹ of the residual until what is added is small, every channel for as long as it needs.
    /// `solve` gets the residuals of the open channels one after the other, and their counts of iterations to add to.
    fn refine(
        &self,
        fields: &[Vec<f64>],
        epsilon: f64,
        scale: f64,
        solve: SolveColumns<'_>,
    ) -> Result<Vec<Iterate>, SolveError> {
        let n = self.active.len();
        let mut iterates: Vec<Iterate> =
            fields.iter().map(|_| Iterate { x: vec![0.0; n], ..Iterate::default() }).collect();
        let mut open: Vec<usize> = (0..fields.len()).collect();
        let mut previous = vec![f64::INFINITY; fields.len()];
        for step in 0..=MOST_REFINEMENTS {
            let residuals: Vec<f64> =
                open.iter().flat_map(|&c| self.residual(&fields[c], &iterates[c].x, epsilon, scale)).collect();
            let mut iterations = vec![0; open.len()];
            let corrections = solve(&residuals, &mut iterations)?;
            let mut still_open = Vec::new();
            for ((&c, correction), iterations) in open.iter().zip(corrections.chunks_exact(n)).zip(iterations) {
                let iterate = &mut iterates[c];
                iterate.iterations += iterations;
                iterate.refinement_steps = step;
                let size = norm(correction) / norm(&iterate.x).max(f64::MIN_POSITIVE);
                iterate.x.iter_mut().zip(correction).for_each(|(x, d)| *x += d);
                // The first solution is no correction: what it is corrected by tells how good it was.
                if step > 0 {
                    if !(size.is_finite() && size < 0.5 * previous[c] && size < 0.5) {
                        return Err(SolveError::NotConverged { iterations: step, residual: size });
                    }
                    previous[c] = size;
                }
                if step == 0 || size > SMALL_CORRECTION {
                    still_open.push(c);
                }
            }
            open = still_open;
            if open.is_empty() {
                return Ok(iterates);
            }
        }
        let residual = open.iter().map(|&c| previous[c]).fold(0.0, f64::max);
        Err(SolveError::NotConverged { iterations: MOST_REFINEMENTS, residual })
    }

    /// εB(f − x) − Lᵀ(Lx): never with the assembled LᵀL, whose rounding the refinement is there to remove.
    #[inline(never)]
    fn residual(&self, f: &[f64], x: &[f64], epsilon: f64, scale: f64) -> Vec<f64> {
        let difference: Vec<f64> = f.iter().zip(x).map(|(f, x)| f - x).collect();
        let smooth = transposed_product(&self.laplacian, &product(&self.laplacian, x));
        self.mass().times(&difference).iter().zip(smooth).map(|(b, l)| epsilon * b - l / scale).collect()
    }

    fn finish(&self, iterate: &Iterate, f: &[f64], vertices: usize, epsilon: f64, scale: f64) -> Solution {
        let mut values = vec![None; vertices];
        for (&v, &x) in self.active.iter().zip(&iterate.x) {
            values[v as usize] = Some(x);
        }
        let (relative_residual, metric_norm) = if iterate.x.is_empty() {
            (0.0, 0.0)
        } else {
            let right_hand_side = epsilon * norm(&self.mass().times(f));
            let residual = norm(&self.residual(f, &iterate.x, epsilon, scale));
            let difference: Vec<f64> = iterate.x.iter().zip(f).map(|(x, f)| x - f).collect();
            let image = self.mass().times(&difference);
            let square: f64 = image.iter().zip(&difference).map(|(a, b)| a * b).sum();
            (if residual == 0.0 { 0.0 } else { residual / right_hand_side }, square.max(0.0).sqrt())
        };
        Solution {
            values,
            metric_norm,
            relative_residual,
            refinement_steps: iterate.refinement_steps,
            iterations: iterate.iterations,
        }
    }
}

#[derive(Default)]
struct Iterate {
    x: Vec<f64>,
    refinement_steps: usize,
    iterations: usize,
}

impl Mass {
    #[inline(never)]
    fn times(&self, x: &[f64]) -> Vec<f64> {
        match self {
            Self::Identity => x.to_vec(),
            Self::Diagonal(diagonal) => diagonal.iter().zip(x).map(|(d, x)| d * x).collect(),
            // Symmetric, so the product that gathers serves.
            Self::Matrix(matrix) => transposed_product(matrix, x),
        }
    }

    /// The sum of a row.
    fn lumped(&self, i: usize) -> f64 {
        match self {
            Self::Matrix(matrix) => matrix.col(i).values().iter().sum(),
            _ => self.diagonal(i),
        }
    }

    fn diagonal(&self, i: usize) -> f64 {
        match self {
            Self::Identity => 1.0,
            Self::Diagonal(diagonal) => diagonal[i],
            Self::Matrix(matrix) => matrix.get_entry(i, i).map_or(0.0, |entry| entry.into_value()),
        }
    }
}

/// The values of (LᵀL)/scale + εB on the pattern of LᵀL, which holds that of B.
fn combine(gram: &CscMatrix<f64>, mass: &Mass, epsilon: f64, scale: f64) -> Vec<f64> {
    let mut values: Vec<f64> = gram.values().iter().map(|value| value / scale).collect();
    for j in 0..gram.ncols() {
        let start = gram.col_offsets()[j];
        let column = gram.col(j);
        let rows = column.row_indices();
        match mass {
            Mass::Matrix(matrix) => {
                let mass_column = matrix.col(j);
                let mut place = 0;
                for (&row, &value) in mass_column.row_indices().iter().zip(mass_column.values()) {
                    while rows[place] < row {
                        place += 1;
                    }
                    values[start + place] += epsilon * value;
                }
            }
            Mass::Identity | Mass::Diagonal(_) => {
                if let Ok(place) = rows.binary_search(&j) {
                    values[start + place] += epsilon * mass.diagonal(j);
                }
            }
        }
    }
    values
}
