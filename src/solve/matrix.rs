//! Products and parts of compressed sparse columns.

use nalgebra_sparse::CscMatrix;

use crate::error::SolveError;

/// What a 32-bit address space can give to one matrix or factor beside everything else.
pub(super) const ADDRESS_SPACE: u64 = if usize::BITS == 32 { 3_000_000_000 } else { 1 << 60 };

/// An entry of AᵀA and what becomes of it until it is factorised: value and row id, both once more in the new order, the place
/// in the old one, the ordering's graph, and the pattern while it grows.
const BYTES_PER_GRAM_ENTRY: u64 = 2 * 8 + 6 * size_of::<usize>() as u64;

/// A x.
///
/// # Panics
/// Where `x` has not one entry per column.
#[must_use]
pub fn product(matrix: &CscMatrix<f64>, x: &[f64]) -> Vec<f64> {
    assert_eq!(x.len(), matrix.ncols(), "one entry per column");
    let mut y = vec![0.0; matrix.nrows()];
    for (column, &scale) in matrix.col_iter().zip(x) {
        for (&row, &value) in column.row_indices().iter().zip(column.values()) {
            y[row] += value * scale;
        }
    }
    y
}

/// Aᵀ x.
///
/// # Panics
/// Where `x` has not one entry per row.
#[must_use]
pub fn transposed_product(matrix: &CscMatrix<f64>, x: &[f64]) -> Vec<f64> {
    assert_eq!(x.len(), matrix.nrows(), "one entry per row");
    matrix
        .col_iter()
        .map(|column| column.row_indices().iter().zip(column.values()).map(|(&row, &value)| value * x[row]).sum())
        .collect()
}

/// xᵀ A x.
///
/// # Panics
/// Where the matrix is not square of the size of `x`.
#[must_use]
pub fn quadratic_form(matrix: &CscMatrix<f64>, x: &[f64]) -> f64 {
    transposed_product(matrix, x).iter().zip(x).map(|(a, b)| a * b).sum()
}

/// AᵀA, with an entry wherever two columns of A share a row, even where it cancels.
///
/// # Errors
/// `OutOfMemory` where rows of A are so full that AᵀA would not fit the address space: one vertex with 20,000 neighbours makes
/// 400 million entries.
pub fn gram(matrix: &CscMatrix<f64>) -> Result<CscMatrix<f64>, SolveError> {
    let mut lengths = vec![0_u64; matrix.nrows()];
    for &row in matrix.row_indices() {
        lengths[row] += 1;
    }
    // Every row makes a pair of each two of its columns; where rows overlap, this counts some entries several times.
    let entries = lengths.iter().map(|length| length * length).sum::<u64>();
    let bytes = entries.saturating_mul(BYTES_PER_GRAM_ENTRY);
    if bytes > ADDRESS_SPACE {
        return Err(SolveError::OutOfMemory { bytes });
    }
    Ok(&matrix.transpose() * matrix)
}

/// ‖x‖₂, also where the squares leave the range of double precision.
#[must_use]
pub fn norm(x: &[f64]) -> f64 {
    let square: f64 = x.iter().map(|v| v * v).sum();
    // Below this, squares lost digits to underflow.
    if square.is_finite() && square > f64::MIN_POSITIVE / f64::EPSILON {
        return square.sqrt();
    }
    let largest = x.iter().fold(0.0_f64, |largest, v| if v.abs() > largest { v.abs() } else { largest });
    if largest == 0.0 || largest == f64::INFINITY {
        return if square.is_nan() { square } else { largest };
    }
    largest * x.iter().map(|v| (v / largest) * (v / largest)).sum::<f64>().sqrt()
}

/// The rows and columns of a square matrix that `kept` lists, ascending.
///
/// # Panics
/// Where an id in `kept` is not below the size of the matrix.
#[must_use]
pub fn submatrix(matrix: &CscMatrix<f64>, kept: &[u32]) -> CscMatrix<f64> {
    let mut place = vec![usize::MAX; matrix.nrows()];
    for (new, &old) in kept.iter().enumerate() {
        place[old as usize] = new;
    }
    let mut offsets = vec![0];
    let (mut rows, mut values) = (Vec::new(), Vec::new());
    for &old in kept {
        let column = matrix.col(old as usize);
        for (&row, &value) in column.row_indices().iter().zip(column.values()) {
            if place[row] != usize::MAX {
                rows.push(place[row]);
                values.push(value);
            }
        }
        offsets.push(rows.len());
    }
    // Ascending ids keep the rows of every column ascending, so the data is valid by construction.
    CscMatrix::try_from_csc_data(kept.len(), kept.len(), offsets, rows, values)
        .unwrap_or_else(|_| CscMatrix::zeros(kept.len(), kept.len()))
}
