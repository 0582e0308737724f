//! A preconditioner for squared operators.

use nalgebra_sparse::CscMatrix;

use super::multigrid::Multigrid;
use super::preconditioner::Preconditioner;
use super::rows::SymmetricRows;
use crate::Watch;
use crate::error::SolveError;

/// Most inner iterations; multigrid takes a handful, but for rows of needle triangles.
const MOST_INNER: usize = 500;

/// P = (L + D) W (L + D), a preconditioner for A = LWL + DWD with a symmetric positive semi-definite L and positive
/// diagonals D and W, the latter the identity unless [`SquaredSum::between`] says something else.
///
/// # Definition
/// P⁻¹ r = (L + D)⁻¹ W⁻¹ (L + D)⁻¹ r up to a multiple, both solves by conjugate gradients with [`Multigrid`] to a loose
/// relative tolerance.
///
/// # Properties
/// P − A = LD + DL. For D = √ε·I both have the eigenvectors of L, and the ratio (λ² + ε)/(λ + √ε)² of their eigenvalues is
/// between 1/2 and 1: the condition number is at most 2 for every mesh and every ε. For any D the ratio is at least 1/2.
#[derive(Debug, Clone)]
pub struct SquaredSum {
    multigrid: Multigrid,
    tolerance: f64,
    /// The largest diagonal entry of L + D.
    largest: f64,
    /// The diagonal of W⁻¹, divided by its largest entry.
    between: Option<Vec<f64>>,
}

impl SquaredSum {
    /// What each of the two solves leaves of its right-hand side, in the norm: less pays off in outer iterations only.
    pub const TOLERANCE: f64 = 2e-2;

    /// For a symmetric matrix L that stores both triangles, and the diagonal of D.
    ///
    /// # Errors
    /// `DimensionMismatch`; `NonFiniteEntry`; else as [`Multigrid::new`] for L + D.
    pub fn new(
        matrix: &CscMatrix<f64>,
        diagonal: &[f64],
        tolerance: f64,
        watch: &Watch<'_>,
    ) -> Result<Self, SolveError> {
        if matrix.ncols() != diagonal.len() {
            return Err(SolveError::DimensionMismatch { expected: matrix.ncols(), actual: diagonal.len() });
        }
        if let Some(row) = diagonal.iter().position(|d| !d.is_finite()) {
            return Err(SolveError::NonFiniteEntry { row });
        }
        let sum = SymmetricRows::shifted(matrix, diagonal)?;
        let largest = (0..sum.size()).map(|i| sum.diagonal(i)).fold(0.0, f64::max);
        Ok(Self { multigrid: Multigrid::from_rows(sum, watch)?, tolerance, largest, between: None })
    }

    /// Sets another tolerance for both solves.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.tolerance = tolerance;
    }

    /// Sets a W that is not the identity, by its inverse.
    #[must_use]
    pub fn between(mut self, inverse: &[f64]) -> Self {
        let largest = inverse.iter().fold(0.0_f64, |largest, &w| largest.max(w));
        self.between = Some(inverse.iter().map(|w| w / largest).collect());
        self
    }

    fn scaled(&self, r: &[f64]) -> Vec<f64> {
        r.iter().map(|r| r * self.largest).collect()
    }
}

impl Preconditioner for SquaredSum {
    fn size(&self) -> usize {
        self.multigrid.size()
    }

    fn apply(&self, r: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        // The scaling keeps numbers within range where D is tiny or huge, and changes nothing else.
        let mut half = self.multigrid.solve(self.scaled(r), self.tolerance, MOST_INNER, watch)?;
        if let Some(between) = &self.between {
            half.iter_mut().zip(between).for_each(|(h, w)| *h *= w);
        }
        self.multigrid.solve(self.scaled(&half), self.tolerance, MOST_INNER, watch)
    }
}
