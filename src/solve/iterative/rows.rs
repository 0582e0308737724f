//! Compressed rows with 32-bit ids: half the memory of `CscMatrix`, for what iterative solvers keep.

use nalgebra_sparse::CscMatrix;

use crate::Watch;
use crate::error::{Cancelled, SolveError};
use crate::support::memory;

/// An entry that is put in its place in the transposed matrix.
const TICKS_PER_MOVE: u64 = 24;
/// A pair of entries in a product of matrices.
const TICKS_PER_PAIR: u64 = 16;

/// A sparse matrix by rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    pub(super) offsets: Vec<u32>,
    pub(super) columns: Vec<u32>,
    pub(super) values: Vec<f64>,
    pub(super) width: usize,
}

/// A symmetric matrix by rows, its columns ascending and its diagonal stored and positive.
#[derive(Debug, Clone)]
pub(super) struct SymmetricRows {
    pub(super) rows: Rows,
    /// Where each row's diagonal entry is.
    pub(super) middles: Vec<u32>,
}

impl Rows {
    pub(super) fn height(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }

    pub(super) fn range(&self, row: usize) -> core::ops::Range<usize> {
        self.offsets[row] as usize..self.offsets[row + 1] as usize
    }

    /// (column, value) of a row.
    pub(super) fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        entries(self, self.range(row))
    }

    /// Σ of the row's entries in `range` times x.
    #[inline]
    pub(super) fn gather(&self, range: core::ops::Range<usize>, x: &[f64]) -> f64 {
        entries(self, range).map(|(j, value)| value * x[j]).sum()
    }

    /// The transposed matrix; its columns ascend.
    #[inline(never)]
    pub(super) fn transposed(&self, watch: &Watch<'_>) -> Result<Self, Cancelled> {
        let mut offsets = vec![0_u32; self.width + 1];
        for &j in &self.columns {
            offsets[j as usize + 1] += 1;
        }
        for j in 0..self.width {
            offsets[j + 1] += offsets[j];
        }
        let mut next = offsets.clone();
        let (mut columns, mut values) = (vec![0; self.columns.len()], vec![0.0; self.columns.len()]);
        for i in 0..self.height() {
            for (j, value) in self.row(i) {
                let place = next[j] as usize;
                next[j] += 1;
                columns[place] = i as u32;
                values[place] = value;
            }
            watch.tick(TICKS_PER_MOVE * self.range(i).len() as u64)?;
        }
        Ok(Self { offsets, columns, values, width: self.height() })
    }

    /// The product with `right`; its columns come in no order.
    #[inline(never)]
    pub(super) fn times(&self, right: &Self, watch: &Watch<'_>) -> Result<Self, SolveError> {
        let mut product = Self { offsets: vec![0], width: right.width, ..Self::default() };
        let mut places = vec![0_u32; right.width];
        for i in 0..self.height() {
            let (start, mut pairs) = (product.columns.len(), 0);
            for (k, scale) in self.row(i) {
                let others = right.range(k).len();
                pairs += others;
                memory::make_room(&mut product.columns, others)?;
                memory::make_room(&mut product.values, others)?;
                for (j, value) in right.row(k) {
                    let place = places[j] as usize;
                    // A place counts where it is of this row and holds this column: nothing needs clearing between rows.
                    if place >= start && product.columns.get(place) == Some(&(j as u32)) {
                        product.values[place] += scale * value;
                    } else {
                        places[j] = product.columns.len() as u32;
                        product.columns.push(j as u32);
                        product.values.push(scale * value);
                    }
                }
            }
            product.offsets.push(product.columns.len() as u32);
            watch.tick(TICKS_PER_PAIR * pairs as u64)?;
        }
        Ok(product)
    }
}

#[inline]
fn entries(rows: &Rows, range: core::ops::Range<usize>) -> impl Iterator<Item = (usize, f64)> {
    rows.columns[range.clone()].iter().zip(&rows.values[range]).map(|(&j, &value)| (j as usize, value))
}

impl SymmetricRows {
    /// Checks that the matrix is square, finite, symmetric in its pattern, and positive on its diagonal.
    pub(super) fn new(matrix: &CscMatrix<f64>, watch: &Watch<'_>) -> Result<Self, SolveError> {
        Self::shifted(matrix, &[], watch)
    }

    /// Checks the matrix like [`SymmetricRows::new`], with `shift` added to the diagonal first; no shift at all is none.
    pub(super) fn shifted(matrix: &CscMatrix<f64>, shift: &[f64], watch: &Watch<'_>) -> Result<Self, SolveError> {
        let n = matrix.nrows();
        if matrix.ncols() != n {
            return Err(SolveError::DimensionMismatch { expected: n, actual: matrix.ncols() });
        }
        let count = matrix.nnz();
        if count.max(n) >= u32::MAX as usize {
            return Err(SolveError::OutOfMemory { bytes: 12 * count as u64 });
        }
        let (offsets, ids) = (matrix.col_offsets(), matrix.row_indices());
        // The matrix in 32-bit ids, and places of diagonal entries; where the columns are read.
        memory::ensure((12 * count + (8 + size_of::<usize>()) * n) as u64)?;
        // Going through the columns in order, the mirror images of a row's entries come in order too.
        let mut next = offsets[..n].to_vec();
        for j in 0..n {
            for &i in &ids[offsets[j]..offsets[j + 1]] {
                if next[i] < offsets[i + 1] && ids[next[i]] == j {
                    next[i] += 1;
                } else if next[i] < offsets[i + 1] && ids[next[i]] < j {
                    return Err(SolveError::NotSymmetric { row: ids[next[i]], column: i });
                } else {
                    return Err(SolveError::NotSymmetric { row: i, column: j });
                }
            }
            watch.tick(TICKS_PER_MOVE * (offsets[j + 1] - offsets[j]) as u64)?;
        }
        if let Some(i) = (0..n).find(|&i| next[i] < offsets[i + 1]) {
            return Err(SolveError::NotSymmetric { row: ids[next[i]], column: i });
        }
        if let Some(place) = matrix.values().iter().position(|value| !value.is_finite()) {
            return Err(SolveError::NonFiniteEntry { row: ids[place] });
        }
        let mut values = matrix.values().to_vec();
        for (j, shift) in shift.iter().enumerate() {
            if let Ok(place) = ids[offsets[j]..offsets[j + 1]].binary_search(&j) {
                values[offsets[j] + place] += shift;
            }
        }
        Self::from_rows(Rows {
            offsets: offsets.iter().map(|&offset| offset as u32).collect(),
            columns: ids.iter().map(|&id| id as u32).collect(),
            values,
            width: n,
        })
    }

    /// From rows with ascending columns. An error names the row whose diagonal is not positive.
    pub(super) fn from_rows(rows: Rows) -> Result<Self, SolveError> {
        let mut middles = Vec::with_capacity(rows.height());
        for i in 0..rows.height() {
            let range = rows.range(i);
            let middle = range.start + rows.columns[range.clone()].partition_point(|&j| (j as usize) < i);
            let stored = middle < range.end && rows.columns[middle] as usize == i;
            if !(stored && rows.values[middle] > 0.0) {
                return Err(SolveError::NotPositiveDefinite { column: i });
            }
            middles.push(middle as u32);
        }
        Ok(Self { rows, middles })
    }

    pub(super) fn size(&self) -> usize {
        self.middles.len()
    }

    pub(super) fn diagonal(&self, i: usize) -> f64 {
        self.rows.values[self.middles[i] as usize]
    }

    /// Places of the entries left of the diagonal.
    pub(super) fn lower(&self, i: usize) -> core::ops::Range<usize> {
        self.rows.offsets[i] as usize..self.middles[i] as usize
    }

    /// Places of the entries right of the diagonal.
    pub(super) fn upper(&self, i: usize) -> core::ops::Range<usize> {
        self.middles[i] as usize + 1..self.rows.offsets[i + 1] as usize
    }

    #[inline(never)]
    pub(super) fn product(&self, x: &[f64]) -> Vec<f64> {
        (0..self.size()).map(|i| self.rows.gather(self.rows.range(i), x)).collect()
    }
}
