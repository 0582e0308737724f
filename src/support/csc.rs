//! Compressed sparse columns that are known to be valid.

use nalgebra_sparse::CscMatrix;

/// A matrix of columns whose row ids ascend.
///
/// # Panics
/// Where they do not, or the lengths do not fit: the code that made them is wrong then, and no matrix at all is better than
/// a wrong one.
#[allow(
    clippy::expect_used,
    reason = "only a defect of this crate can make invalid columns, and that must not go unnoticed"
)]
#[inline(never)]
pub(crate) fn valid_csc(
    rows: usize,
    columns: usize,
    offsets: Vec<usize>,
    row_ids: Vec<usize>,
    values: Vec<f64>,
) -> CscMatrix<f64> {
    CscMatrix::try_from_csc_data(rows, columns, offsets, row_ids, values).expect("the columns of a matrix are valid")
}
