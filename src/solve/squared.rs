//! A preconditioner for squared operators.

use nalgebra_sparse::CscMatrix;

use super::multigrid::Multigrid;
use super::preconditioner::Preconditioner;
use super::rows::SymmetricRows;
use crate::error::SolveError;

/// Most inner iterations; multigrid takes a handful.
const MOST_INNER: usize = 100;

/// P = (L + D)², a preconditioner for A = L² + D² with a symmetric positive semi-definite L and a positive diagonal D.
///
/// # Definition
/// P⁻¹ r = (L + D)⁻¹ (L + D)⁻¹ r, both by conjugate gradients with [`Multigrid`] to a loose relative tolerance.
///
/// # Properties
/// P − A = LD + DL. For D = √ε·I both have the eigenvectors of L, and the ratio (λ² + ε)/(λ + √ε)² of their eigenvalues is
/// between 1/2 and 1: the condition number is at most 2 for every mesh and every ε. For any D the ratio is at least 1/2.
#[derive(Debug, Clone)]
pub struct SquaredSum {
    multigrid: Multigrid,
    tolerance: f64,
}

impl SquaredSum {
    /// What each of the two solves leaves of its right-hand side, in the norm: less pays off in outer iterations only.
    pub const TOLERANCE: f64 = 1e-2;

    /// For a symmetric matrix L that stores both triangles, and the diagonal of D.
    ///
    /// # Errors
    /// `DimensionMismatch`; `NonFiniteEntry`; else as [`Multigrid::new`] for L + D.
    pub fn new(matrix: &CscMatrix<f64>, diagonal: &[f64], tolerance: f64) -> Result<Self, SolveError> {
        if matrix.ncols() != diagonal.len() {
            return Err(SolveError::DimensionMismatch { expected: matrix.ncols(), actual: diagonal.len() });
        }
        if let Some(row) = diagonal.iter().position(|d| !d.is_finite()) {
            return Err(SolveError::NonFiniteEntry { row });
        }
        let multigrid = Multigrid::from_rows(SymmetricRows::shifted(matrix, diagonal)?)?;
        Ok(Self { multigrid, tolerance })
    }
}

impl Preconditioner for SquaredSum {
    fn size(&self) -> usize {
        self.multigrid.size()
    }

    fn apply(&self, r: &[f64]) -> Result<Vec<f64>, SolveError> {
        let half = self.multigrid.solve(r.to_vec(), self.tolerance, MOST_INNER)?;
        self.multigrid.solve(half, self.tolerance, MOST_INNER)
    }
}
