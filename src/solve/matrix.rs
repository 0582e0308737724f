//! Products and parts of compressed sparse columns. Not inlined, because the copies would only grow the wasm module.

use nalgebra_sparse::CscMatrix;

use crate::error::{Cancelled, SolveError};
use crate::support::csc::valid_csc;
use crate::support::memory;
use crate::{Phase, Watch};

/// What a 32-bit address space can give to one matrix or factor beside everything else.
pub(super) const ADDRESS_SPACE: u64 = if usize::BITS == 32 { 3_000_000_000 } else { 1 << 60 };

/// An entry of AᵀA and what becomes of it until it is factorised: value and row id, both once more in the new order, the place
/// in the old one, the ordering's graph, and the pattern while it grows.
const BYTES_PER_GRAM_ENTRY: u64 = 2 * 8 + 6 * size_of::<usize>() as u64;

/// An entry of a matrix: its value and its row id.
const BYTES_PER_ENTRY: usize = 8 + size_of::<usize>();

/// Two entries that share a row, met while AᵀA is counted or computed.
const TICKS_PER_PAIR: u64 = 8;
/// An entry that is put in its place in the transposed matrix.
const TICKS_PER_MOVE: u64 = 24;
/// Ids that are counted before the watch is told.
const CHUNK: usize = 1 << 18;

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

/// AᵀA, with an entry wherever two columns of A share a row, even where it cancels.
///
/// # Errors
/// `Cancelled`; `OutOfMemory`, also where rows of A are so full that AᵀA would not fit the address space: one vertex with
/// 20,000 neighbours makes 400 million entries.
pub fn gram(matrix: &CscMatrix<f64>, watch: &Watch<'_>) -> Result<CscMatrix<f64>, SolveError> {
    let columns = matrix.ncols();
    let mut plan = watch.plan(&[(Phase::Analysis, 1.0)]);
    plan.begin(expected_pairs(matrix) * (2 * TICKS_PER_PAIR + TICKS_PER_MOVE / 2))?;
    // A once more by rows, with counters, and three numbers for every column.
    let before = BYTES_PER_ENTRY * matrix.nnz() + size_of::<usize>() * (2 * matrix.nrows() + 3 * columns);
    memory::ensure(before as u64)?;
    let by_rows = transposed(matrix.nrows(), matrix.csc_data(), watch)?;
    let entries = count_gram(matrix, &by_rows, watch)?;
    // The product as it is found, and in order.
    memory::ensure((2 * BYTES_PER_ENTRY * entries + size_of::<usize>() * 6 * columns) as u64)?;
    // Column j of the product gathers the columns that share a row with column j, in the order they are met …
    let mut ends = Vec::with_capacity(columns + 1);
    let (mut met, mut sums) = (Vec::with_capacity(entries), Vec::with_capacity(entries));
    let (mut owner, mut place) = (vec![usize::MAX; columns], vec![0; columns]);
    ends.push(0);
    for (j, column) in matrix.col_iter().enumerate() {
        let mut pairs = 0;
        for (&row, &value) in column.row_indices().iter().zip(column.values()) {
            let others = entries_of(&by_rows, row);
            pairs += others.len();
            for (&i, &other) in others {
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
        watch.tick(TICKS_PER_PAIR * pairs as u64)?;
    }
    drop(by_rows);
    // … and, because the product is symmetric, reading the columns as rows sorts them.
    let product = transposed(columns, (&ends, &met, &sums), watch)?;
    plan.finish()?;
    Ok(product)
}

/// The pairs of entries that share a row, were all rows alike.
fn expected_pairs(matrix: &CscMatrix<f64>) -> u64 {
    let entries = matrix.nnz() as u64;
    entries * (entries / (matrix.nrows() as u64).max(1)).min(64)
}

/// Counts the entries of AᵀA. Fails where they would not fit the address space, before any of them is computed.
fn count_gram(matrix: &CscMatrix<f64>, by_rows: &CscMatrix<f64>, watch: &Watch<'_>) -> Result<usize, SolveError> {
    let most = ADDRESS_SPACE / BYTES_PER_GRAM_ENTRY;
    let mut owner = vec![usize::MAX; matrix.ncols()];
    let mut entries = 0_u64;
    for (j, column) in matrix.col_iter().enumerate() {
        let mut pairs = 0;
        for &row in column.row_indices() {
            let others = entries_of(by_rows, row);
            pairs += others.len();
            for (&i, _) in others {
                entries += u64::from(core::mem::replace(&mut owner[i], j) != j);
            }
        }
        if entries > most {
            // The rest is not counted: this much is too much already.
            return Err(SolveError::OutOfMemory { bytes: entries * BYTES_PER_GRAM_ENTRY });
        }
        watch.tick(TICKS_PER_PAIR * pairs as u64)?;
    }
    Ok(entries as usize)
}

/// The ids and values of one column.
fn entries_of(
    matrix: &CscMatrix<f64>,
    column: usize,
) -> core::iter::Zip<core::slice::Iter<'_, usize>, core::slice::Iter<'_, f64>> {
    let (offsets, ids, values) = matrix.csc_data();
    let range = offsets[column]..offsets[column + 1];
    ids[range.clone()].iter().zip(&values[range])
}

/// The transposed matrix of columns (offsets, row ids below `rows`, values), whose row ids need not ascend.
#[inline(never)]
fn transposed(
    rows: usize,
    (offsets, ids, values): (&[usize], &[usize], &[f64]),
    watch: &Watch<'_>,
) -> Result<CscMatrix<f64>, Cancelled> {
    let mut starts = vec![0; rows + 1];
    for ids in ids.chunks(CHUNK) {
        ids.iter().for_each(|&row| starts[row + 1] += 1);
        watch.tick(TICKS_PER_MOVE / 4 * ids.len() as u64)?;
    }
    for row in 0..rows {
        starts[row + 1] += starts[row];
    }
    let mut next = starts.clone();
    let (mut columns, mut moved) = (vec![0; ids.len()], vec![0.0; ids.len()]);
    for (j, range) in offsets.windows(2).enumerate() {
        for k in range[0]..range[1] {
            let place = &mut next[ids[k]];
            columns[*place] = j;
            moved[*place] = values[k];
            *place += 1;
        }
        watch.tick(TICKS_PER_MOVE * (range[1] - range[0]) as u64)?;
    }
    drop(next);
    Ok(valid_csc(offsets.len() - 1, rows, starts, columns, moved))
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

/// The columns that `kept` lists, with all their rows.
///
/// # Panics
/// Where an id in `kept` is not below the number of columns.
#[must_use]
#[inline(never)]
pub fn columns(matrix: &CscMatrix<f64>, kept: &[u32]) -> CscMatrix<f64> {
    let entries = kept.iter().map(|&j| matrix.col(j as usize).nnz()).sum();
    let mut offsets = Vec::with_capacity(kept.len() + 1);
    let (mut rows, mut values) = (Vec::with_capacity(entries), Vec::with_capacity(entries));
    offsets.push(0);
    for &j in kept {
        let column = matrix.col(j as usize);
        rows.extend_from_slice(column.row_indices());
        values.extend_from_slice(column.values());
        offsets.push(rows.len());
    }
    // The columns are valid as they were.
    valid_csc(matrix.nrows(), kept.len(), offsets, rows, values)
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
    // At least as many as there will be.
    let entries = kept.iter().map(|&old| matrix.col(old as usize).nnz()).sum();
    let mut offsets = Vec::with_capacity(kept.len() + 1);
    let (mut rows, mut values) = (Vec::with_capacity(entries), Vec::with_capacity(entries));
    offsets.push(0);
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
    valid_csc(kept.len(), kept.len(), offsets, rows, values)
}
