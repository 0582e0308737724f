//! The direct solver: order and analyse a pattern once, factorise it for any values, solve for any right-hand sides.
//!
//! Behind this interface stands nalgebra-sparse's left-looking `CscCholesky`; callers see neither it nor its types.

use std::sync::Arc;

use nalgebra::DMatrixViewMut;
use nalgebra_sparse::CscMatrix;
use nalgebra_sparse::factorization::{CscCholesky, CscSymbolicCholesky};
use nalgebra_sparse::pattern::SparsityPattern;

use super::matrix::{ADDRESS_SPACE, norm, product};
use super::ordering::{Permutation, minimum_degree};
use super::symbolic::FactorSize;
use crate::error::SolveError;

/// The ordering and symbolic analysis of a symmetric pattern. Cheap to clone.
#[derive(Debug, Clone)]
pub struct CholeskyAnalysis {
    shared: Arc<Analysis>,
}

#[derive(Debug)]
struct Analysis {
    permutation: Permutation,
    symbolic: CscSymbolicCholesky,
    /// For every entry of the permuted matrix its place among the values of the original one.
    sources: Vec<usize>,
    /// Where the rows of the original matrix start, to name them in errors; as it is symmetric, so do its columns.
    offsets: Vec<usize>,
    size: FactorSize,
}

impl CholeskyAnalysis {
    /// Orders the unknowns by [`minimum_degree`] and analyses the pattern of a symmetric matrix, both triangles stored.
    ///
    /// # Errors
    /// `DimensionMismatch` where the pattern is not square; `NotSymmetric`; `OutOfMemory` with the number of bytes where
    /// the factor would not fit the address space.
    pub fn new(pattern: &SparsityPattern) -> Result<Self, SolveError> {
        check_symmetric(pattern)?;
        Self::analyze(pattern, Permutation::new(minimum_degree(pattern))?)
    }

    /// As [`CholeskyAnalysis::new`], with an ordering of the caller's.
    ///
    /// # Errors
    /// As [`CholeskyAnalysis::new`]; `DimensionMismatch` where the permutation has another size.
    pub fn with_permutation(pattern: &SparsityPattern, permutation: Permutation) -> Result<Self, SolveError> {
        check_symmetric(pattern)?;
        let (expected, actual) = (pattern.major_dim(), permutation.new_to_old().len());
        if expected != actual {
            return Err(SolveError::DimensionMismatch { expected, actual });
        }
        Self::analyze(pattern, permutation)
    }

    fn analyze(pattern: &SparsityPattern, permutation: Permutation) -> Result<Self, SolveError> {
        let size = FactorSize::count(pattern, &permutation);
        // Values and row ids of the factor, the ids again by rows, and once more while they are built.
        let bytes = size.nonzeros.saturating_mul(8 + 4 * size_of::<usize>() as u64);
        if bytes > ADDRESS_SPACE {
            return Err(SolveError::OutOfMemory { bytes });
        }
        let (permuted, sources) = permute(pattern, &permutation);
        let symbolic = CscSymbolicCholesky::factor(permuted);
        let offsets = pattern.major_offsets().to_vec();
        Ok(Self { shared: Arc::new(Analysis { permutation, symbolic, sources, offsets, size }) })
    }

    /// Number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.shared.permutation.new_to_old().len()
    }

    /// What the factor holds.
    #[must_use]
    pub fn size(&self) -> FactorSize {
        self.shared.size
    }

    /// Factorises the matrix with the analysed pattern and the given values, in the order of the pattern.
    ///
    /// # Errors
    /// `PatternMismatch`, `NonFiniteEntry`, `NotPositiveDefinite`.
    pub fn factor(&self, values: &[f64]) -> Result<CholeskyFactor, SolveError> {
        let permuted = self.permuted(values)?;
        let factor = CscCholesky::factor_numerical(self.shared.symbolic.clone(), &permuted)
            .map_err(|_| SolveError::NotPositiveDefinite { column: 0 })?;
        Ok(CholeskyFactor { analysis: self.clone(), factor })
    }

    fn permuted(&self, values: &[f64]) -> Result<Vec<f64>, SolveError> {
        if values.len() != self.shared.sources.len() {
            return Err(SolveError::PatternMismatch {});
        }
        if let Some(place) = values.iter().position(|value| !value.is_finite()) {
            let row = self.shared.offsets.partition_point(|&start| start <= place) - 1;
            return Err(SolveError::NonFiniteEntry { row });
        }
        Ok(self.shared.sources.iter().map(|&source| values[source]).collect())
    }
}

/// A numeric factor P A Pᵀ = L Lᵀ.
#[derive(Debug, Clone)]
pub struct CholeskyFactor {
    analysis: CholeskyAnalysis,
    factor: CscCholesky<f64>,
}

impl CholeskyFactor {
    /// Factorises other values on the same pattern, in the memory of this factor.
    ///
    /// # Errors
    /// `PatternMismatch`, `NonFiniteEntry`, `NotPositiveDefinite`; after the last the factor must not be used to solve.
    pub fn refactor(&mut self, values: &[f64]) -> Result<(), SolveError> {
        let permuted = self.analysis.permuted(values)?;
        self.factor.refactor(&permuted).map_err(|_| SolveError::NotPositiveDefinite { column: 0 })
    }

    /// Solves A X = B for right-hand sides stored one after the other.
    ///
    /// # Errors
    /// `DimensionMismatch` where the length is no multiple of the number of unknowns; `NonFiniteEntry`.
    pub fn solve(&self, right_hand_sides: &[f64]) -> Result<Vec<f64>, SolveError> {
        let n = self.analysis.unknowns();
        if n == 0 || !right_hand_sides.len().is_multiple_of(n) {
            return Err(SolveError::DimensionMismatch { expected: n, actual: right_hand_sides.len() });
        }
        if let Some(place) = right_hand_sides.iter().position(|value| !value.is_finite()) {
            return Err(SolveError::NonFiniteEntry { row: place % n });
        }
        let new_to_old = self.analysis.shared.permutation.new_to_old();
        let mut permuted: Vec<f64> = right_hand_sides
            .chunks_exact(n)
            .flat_map(|column| new_to_old.iter().map(|&old| column[old as usize]))
            .collect();
        self.factor.solve_mut(DMatrixViewMut::from_slice(&mut permuted, n, right_hand_sides.len() / n));
        let mut solution = vec![0.0; permuted.len()];
        for (from, to) in permuted.chunks_exact(n).zip(solution.chunks_exact_mut(n)) {
            for (&value, &old) in from.iter().zip(new_to_old) {
                to[old as usize] = value;
            }
        }
        Ok(solution)
    }

    /// The analysis this factor was made with.
    #[must_use]
    pub fn analysis(&self) -> &CholeskyAnalysis {
        &self.analysis
    }

    /// ‖b − A x‖₂ / ‖b‖₂ for one right-hand side; 0 where b is zero and x solves exactly.
    ///
    /// # Panics
    /// Where the sizes do not fit.
    #[must_use]
    pub fn relative_residual(matrix: &CscMatrix<f64>, x: &[f64], b: &[f64]) -> f64 {
        let residual: Vec<f64> = product(matrix, x).iter().zip(b).map(|(ax, b)| b - ax).collect();
        match (norm(&residual), norm(b)) {
            (0.0, _) => 0.0,
            (r, b) => r / b,
        }
    }
}

fn check_symmetric(pattern: &SparsityPattern) -> Result<(), SolveError> {
    let (expected, actual) = (pattern.major_dim(), pattern.minor_dim());
    if expected != actual {
        return Err(SolveError::DimensionMismatch { expected, actual });
    }
    let one_sided = (0..expected).find_map(|column| {
        let row = pattern.lane(column).iter().find(|&&row| pattern.lane(row).binary_search(&column).is_err());
        row.map(|&row| SolveError::NotSymmetric { row, column })
    });
    one_sided.map_or(Ok(()), Err)
}

/// The pattern in the new order, and for every entry a place in the old one that holds the same value.
fn permute(pattern: &SparsityPattern, permutation: &Permutation) -> (SparsityPattern, Vec<usize>) {
    let n = pattern.major_dim();
    let old_to_new = permutation.old_to_new();
    let mut offsets = Vec::with_capacity(n + 1);
    let mut end = 0;
    offsets.push(end);
    for &old in permutation.new_to_old() {
        end += pattern.lane(old as usize).len();
        offsets.push(end);
    }
    let mut next = offsets.clone();
    let (mut rows, mut sources) = (vec![0; end], vec![0; end]);
    // By symmetry an old column is a row as well: reading the columns as rows in the new order fills every new column in
    // the order of its rows.
    for (new, &old) in permutation.new_to_old().iter().enumerate() {
        let start = pattern.major_offsets()[old as usize];
        for (k, &other) in pattern.lane(old as usize).iter().enumerate() {
            let place = &mut next[old_to_new[other] as usize];
            rows[*place] = new;
            sources[*place] = start + k;
            *place += 1;
        }
    }
    // Symmetry keeps the lengths of the columns, so the data is valid.
    let permuted = SparsityPattern::try_from_offsets_and_indices(n, n, offsets, rows)
        .unwrap_or_else(|_| SparsityPattern::zeros(n, n));
    (permuted, sources)
}
