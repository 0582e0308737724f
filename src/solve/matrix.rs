//! Products and parts of compressed sparse columns. Not inlined, because the copies would only grow the wasm module.

use nalgebra_sparse::CscMatrix;

use crate::Watch;
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
#[inline(never)]
pub fn product(matrix: &CscMatrix<f64>, x: &[f64]) -> Vec<f64> {
    assert_eq!(x.len(), matrix.ncols(), "one entry per column");
    let (offsets, rows, values) = matrix.csc_data();
    let mut y = vec![0.0; matrix.nrows()];
    for (j, &scale) in x.iter().enumerate() {
        for k in offsets[j]..offsets[j + 1] {
            y[rows[k]] += values[k] * scale;
        }
    }
    y
}

/// Aᵀ x.
///
/// # Panics
/// Where `x` has not one entry per row.
#[must_use]
#[inline(never)]
pub fn transposed_product(matrix: &CscMatrix<f64>, x: &[f64]) -> Vec<f64> {
    assert_eq!(x.len(), matrix.nrows(), "one entry per row");
    let (offsets, rows, values) = matrix.csc_data();
    let mut y = Vec::with_capacity(matrix.ncols());
    for j in 0..matrix.ncols() {
        let mut sum = 0.0;
        for k in offsets[j]..offsets[j + 1] {
            sum += values[k] * x[rows[k]];
        }
        y.push(sum);
    }
    y
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
/// `OutOfMemory` where rows of A are so full that AᵀA would not fit the address space: one vertex with 20,000 neighbours
/// makes 400 million entries.
pub fn gram(matrix: &CscMatrix<f64>, _watch: &Watch<'_>) -> Result<CscMatrix<f64>, SolveError> {
    let columns = matrix.ncols();
    let by_rows = Rows::new(matrix);
    check_gram(matrix, &by_rows)?;
    // Column j of the product gathers the columns that share a row with column j, in the order they are met …
    let mut ends = Vec::with_capacity(columns + 1);
    let (mut met, mut sums) = (Vec::new(), Vec::new());
    let (mut owner, mut place) = (vec![usize::MAX; columns], vec![0; columns]);
    ends.push(0);
    for (j, column) in matrix.col_iter().enumerate() {
        for (&row, &value) in column.row_indices().iter().zip(column.values()) {
            for (&i, &other) in by_rows.row(row) {
                if owner[i] != j {
                    owner[i] = j;
                    place[i] = met.len();
                    met.push(i);
                    sums.push(0.0);
                }
                sums[place[i]] += value * other;
            }
        }
        ends.push(met.len());
    }
    // … and, because the product is symmetric, reading the columns as rows sorts them.
    let unsorted = (0..columns).flat_map(|j| (ends[j]..ends[j + 1]).map(move |k| (j, k)));
    let sorted = Rows::gather(columns, unsorted.map(|(j, k)| (met[k], j, sums[k])));
    Ok(CscMatrix::try_from_csc_data(columns, columns, sorted.offsets, sorted.columns, sorted.values)
        .unwrap_or_else(|_| CscMatrix::zeros(columns, columns)))
}

/// Fails where AᵀA would not fit the address space, before it is begun.
fn check_gram(matrix: &CscMatrix<f64>, by_rows: &Rows) -> Result<(), SolveError> {
    // Every row makes a pair of each two of its columns; where rows overlap, this counts some entries several times.
    let pairs: u64 = by_rows.offsets.windows(2).map(|row| (row[1] - row[0]) as u64).map(|length| length * length).sum();
    let most = ADDRESS_SPACE / BYTES_PER_GRAM_ENTRY;
    if pairs <= most {
        return Ok(());
    }
    let mut owner = vec![usize::MAX; matrix.ncols()];
    let mut entries = 0_u64;
    for (j, column) in matrix.col_iter().enumerate() {
        for (&i, _) in column.row_indices().iter().flat_map(|&row| by_rows.row(row)) {
            entries += u64::from(core::mem::replace(&mut owner[i], j) != j);
        }
        if entries > most {
            // The rest is not counted: this much is too much already.
            return Err(SolveError::OutOfMemory { bytes: entries * BYTES_PER_GRAM_ENTRY });
        }
    }
    Ok(())
}

/// Compressed rows.
struct Rows {
    offsets: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl Rows {
    fn new(matrix: &CscMatrix<f64>) -> Self {
        Self::gather(matrix.nrows(), matrix.triplet_iter().map(|(row, column, &value)| (row, column, value)))
    }

    /// From (row, column, value): a counting sort by rows that keeps the order within a row.
    fn gather(rows: usize, entries: impl Iterator<Item = (usize, usize, f64)> + Clone) -> Self {
        let mut offsets = vec![0; rows + 1];
        for (row, ..) in entries.clone() {
            offsets[row + 1] += 1;
        }
        for row in 0..rows {
            offsets[row + 1] += offsets[row];
        }
        let mut next = offsets.clone();
        let (mut columns, mut values) = (vec![0; offsets[rows]], vec![0.0; offsets[rows]]);
        for (row, column, value) in entries {
            columns[next[row]] = column;
            values[next[row]] = value;
            next[row] += 1;
        }
        Self { offsets, columns, values }
    }

    fn row(&self, row: usize) -> impl Iterator<Item = (&usize, &f64)> {
        let range = self.offsets[row]..self.offsets[row + 1];
        self.columns[range.clone()].iter().zip(&self.values[range])
    }
}

/// ‖x‖₂, also where the squares leave the range of double precision.
#[must_use]
#[inline(never)]
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

/// The columns that `kept` lists, with all their rows.
///
/// # Panics
/// Where an id in `kept` is not below the number of columns.
#[must_use]
#[inline(never)]
pub fn columns(matrix: &CscMatrix<f64>, kept: &[u32]) -> CscMatrix<f64> {
    let mut offsets = vec![0];
    let (mut rows, mut values) = (Vec::new(), Vec::new());
    for &j in kept {
        let column = matrix.col(j as usize);
        rows.extend_from_slice(column.row_indices());
        values.extend_from_slice(column.values());
        offsets.push(rows.len());
    }
    // The columns are valid as they were.
    CscMatrix::try_from_csc_data(matrix.nrows(), kept.len(), offsets, rows, values)
        .unwrap_or_else(|_| CscMatrix::zeros(matrix.nrows(), kept.len()))
}

/// The rows and columns of a square matrix that `kept` lists, ascending.
///
/// # Panics
/// Where an id in `kept` is not below the size of the matrix.
#[must_use]
#[inline(never)]
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
