//! Products and parts of compressed sparse columns. Not inlined, because the copies would only grow the wasm module.

use nalgebra_sparse::CscMatrix;

/// A x.
///
/// # Panics
/// Where `x` has not one entry per column.
#[must_use]
#[inline(never)]
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
#[inline(never)]
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
#[must_use]
pub fn gram(matrix: &CscMatrix<f64>) -> CscMatrix<f64> {
    let columns = matrix.ncols();
    let by_rows = Rows::new(matrix);
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
    CscMatrix::try_from_csc_data(columns, columns, sorted.offsets, sorted.columns, sorted.values)
        .unwrap_or_else(|_| CscMatrix::zeros(columns, columns))
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
