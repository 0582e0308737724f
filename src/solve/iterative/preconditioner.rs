//! Approximate inverses for conjugate gradients, and the simplest of them.

use nalgebra_sparse::CscMatrix;

use super::rows::SymmetricRows;
use crate::Watch;
use crate::error::SolveError;

/// An approximation M⁻¹ of the inverse of a symmetric positive definite matrix.
pub trait Preconditioner {
    /// Number of unknowns.
    fn size(&self) -> usize;

    /// z = M⁻¹ r, for an `r` of [`Preconditioner::size`] entries. Conjugate gradients need M⁻¹ symmetric and positive
    /// definite; what an inner iteration varies does no harm.
    ///
    /// # Errors
    /// `Cancelled`, and those of an inner iteration.
    fn apply(&self, r: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, SolveError>;
}

/// M = diag(A) \[Hestenes52\].
#[derive(Debug, Clone)]
pub struct Jacobi {
    inverse: Vec<f64>,
}

impl Jacobi {
    /// For a matrix with this diagonal.
    ///
    /// # Errors
    /// `NonFiniteEntry`; `NotPositiveDefinite` where an entry is not positive.
    pub fn new(diagonal: &[f64]) -> Result<Self, SolveError> {
        for (i, &d) in diagonal.iter().enumerate() {
            if !d.is_finite() {
                return Err(SolveError::NonFiniteEntry { row: i });
            }
            // The reciprocal of a number below the normal ones would not be finite.
            if !(d > 0.0 && (1.0 / d).is_finite()) {
                return Err(SolveError::NotPositiveDefinite { column: i });
            }
        }
        Ok(Self { inverse: diagonal.iter().map(|d| 1.0 / d).collect() })
    }
}

impl Preconditioner for Jacobi {
    fn size(&self) -> usize {
        self.inverse.len()
    }

    fn apply(&self, r: &[f64], _watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        Ok(r.iter().zip(&self.inverse).map(|(r, inverse)| r * inverse).collect())
    }
}

/// Shifts α tried one after the other. Past the last, M is hardly better than the diagonal.
const SHIFTS: [f64; 7] = [0.0, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0];
/// Pivots below this fraction of their diagonal entry are rounding or make the factor useless.
const SMALLEST_PIVOT: f64 = 1e-12;

/// Incomplete Cholesky factorisation without fill: M = G Gᵀ with G on the lower triangle of A's pattern and (G Gᵀ)_ij = a_ij
/// there \[Meijerink77\].
///
/// It breaks down where positive off-diagonal entries are large, as in needle triangles. Then A + α diag(A) is factorised
/// with growing α \[Manteuffel80\].
///
/// It is for matrices that [`Multigrid`](super::Multigrid) is not meant for, in a program that uses this crate's solver for
/// others than Laplacians: the crate itself has none.
#[derive(Debug, Clone)]
pub struct IncompleteCholesky {
    /// A's pattern; G in its lower triangle, with the reciprocals of G's diagonal on the diagonal. The upper triangle
    /// keeps A.
    factor: SymmetricRows,
    shift: f64,
}

impl IncompleteCholesky {
    /// Factorises a symmetric matrix that stores both triangles.
    ///
    /// # Errors
    /// `DimensionMismatch` where it is not square; `NotSymmetric`, by the pattern; `NonFiniteEntry`; `NotPositiveDefinite`
    /// where a diagonal entry is not positive or no shift helps; `OutOfMemory` past 2³² entries.
    pub fn new(matrix: &CscMatrix<f64>) -> Result<Self, SolveError> {
        let mut factor = SymmetricRows::new(matrix)?;
        let mut column = 0;
        for shift in SHIFTS {
            if shift > 0.0 {
                factor.rows.values.copy_from_slice(matrix.values());
            }
            match factorize(&mut factor, shift) {
                Ok(()) => return Ok(Self { factor, shift }),
                Err(failed) => column = failed,
            }
        }
        Err(SolveError::NotPositiveDefinite { column })
    }

    /// The α that was needed; mostly 0.
    #[must_use]
    pub fn shift(&self) -> f64 {
        self.shift
    }
}

/// Row by row in place; fails with the row of a pivot that is too small.
fn factorize(factor: &mut SymmetricRows, shift: f64) -> Result<(), usize> {
    let n = factor.size();
    // The row at work, by columns.
    let mut dense = vec![0.0; n];
    for i in 0..n {
        let row = factor.lower(i);
        for place in row.clone() {
            let j = factor.rows.columns[place] as usize;
            let other = factor.lower(j);
            let mut sum = factor.rows.values[place];
            if other.len() > 8 * row.len() {
                // A short row against that of a vertex with very many neighbours: looked up entry by entry, as otherwise
                // each of these neighbours would go through all of them.
                for before in row.start..place {
                    if let Ok(k) = factor.rows.columns[other.clone()].binary_search(&factor.rows.columns[before]) {
                        sum -= factor.rows.values[before] * factor.rows.values[other.start + k];
                    }
                }
            } else {
                sum -= factor.rows.gather(other, &dense);
            }
            sum *= factor.rows.values[factor.middles[j] as usize];
            factor.rows.values[place] = sum;
            dense[j] = sum;
        }
        let middle = factor.middles[i] as usize;
        let diagonal = factor.rows.values[middle] * (1.0 + shift);
        let pivot =
            row.clone().fold(diagonal, |pivot, place| pivot - factor.rows.values[place] * factor.rows.values[place]);
        if !(pivot > SMALLEST_PIVOT * diagonal && pivot.is_finite()) {
            return Err(i);
        }
        factor.rows.values[middle] = 1.0 / pivot.sqrt();
        for place in row {
            dense[factor.rows.columns[place] as usize] = 0.0;
        }
    }
    Ok(())
}

impl Preconditioner for IncompleteCholesky {
    fn size(&self) -> usize {
        self.factor.size()
    }

    fn apply(&self, r: &[f64], _watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        let (factor, mut z) = (&self.factor, r.to_vec());
        for i in 0..z.len() {
            z[i] = (z[i] - factor.rows.gather(factor.lower(i), &z)) * factor.diagonal(i);
        }
        for i in (0..z.len()).rev() {
            z[i] *= factor.diagonal(i);
            for place in factor.lower(i) {
                z[factor.rows.columns[place] as usize] -= factor.rows.values[place] * z[i];
            }
        }
        Ok(z)
    }
}
