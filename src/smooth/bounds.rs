//! How far a result can move when the input does: ‖x − x_e‖₂ ≤ factor · ‖e‖₂ \[Patane09, sections 4.2 and 4.3\].
//!
//! Every method here is linear in the values, so the factor is a bound of a matrix's norm. Smallest eigenvalues are bounded from
//! below, and norms of sparse matrices from above by their largest sums of rows and columns, so that the bounds are bounds.

use nalgebra_sparse::CscMatrix;

use super::data_term::Mass;

/// The factor of (LᵀWL + εB) x = εBf, given a lower bound λ of the smallest eigenvalue of the matrix A: √(ε‖B‖/λ), or √(‖B‖‖B⁻¹‖), since
/// ‖x − x_e‖_B ≤ ‖e‖_B, whichever is less. For B = I it is 1 and attained by constants.
///
/// The paper has ε‖B‖/λ. As A is at least εB, A^(−1/2) (εB)^(1/2) has a norm of at most 1, so that the root of it bounds
/// A⁻¹ εB = A^(−1/2) · A^(−1/2) (εB)^(1/2) · (εB)^(1/2), too.
pub(super) fn regularized(mass: &Mass, unknowns: usize, epsilon: f64, eigenvalue: Option<f64>) -> Option<f64> {
    let (masses, share) = match mass {
        Mass::Identity => return Some(1.0),
        Mass::Diagonal(masses) => (masses.clone(), 1.0),
        // Rows of the Galerkin matrix sum to the lumped masses, and a quarter of these is the least it can be: the matrix of
        // one triangle has the eigenvalues |t|/12 · {1, 1, 4}, the lumped one |t|/12 · {4, 4, 4}.
        Mass::Matrix(_) | Mass::Partial(_) => (mass.times(&vec![1.0; unknowns]), 0.25),
    };
    let largest = masses.iter().fold(0.0_f64, |largest, &m| largest.max(m));
    let smallest = share * masses.iter().fold(f64::INFINITY, |smallest, &m| smallest.min(m));
    let by_condition = largest / smallest;
    let by_eigenvalue = eigenvalue.map_or(f64::INFINITY, |eigenvalue| epsilon * largest / eigenvalue);
    finite(by_condition.min(by_eigenvalue).sqrt())
}

/// The factor of min ‖A_F g + A_I f_I‖ with the values f_I fixed: √(1 + (‖A_I‖/σ)²), where σ is the smallest singular value of A_F.
pub(super) fn interpolation(fixed: f64, singular_value: Option<f64>) -> Option<f64> {
    singular_value.and_then(|sigma| {
        let ratio = fixed / sigma;
        finite((1.0 + ratio * ratio).sqrt())
    })
}

/// The factor of ((I − μK)(I − λK))^N with K = D⁻¹L, for the diagonal D of L and the steps [λ, μ]. Rows without a positive diagonal keep
/// their values.
///
/// Where L is symmetric, K is similar to D^(−½)LD^(−½), which is so too, and its eigenvalues lie between 0 and ‖K‖_∞: the
/// factor is √(max d/min d) times the N-th power of the largest |(1 − μk)(1 − λk)|. Otherwise, or where that is less, it comes
/// from powers of ‖·‖₁ and ‖·‖_∞ of both steps, by ‖P‖₂ ≤ √(‖P‖₁‖P‖_∞) and ‖P‖₂ ≤ √n·min(‖P‖₁, ‖P‖_∞).
pub(super) fn low_pass(
    laplacian: &CscMatrix<f64>,
    diagonal: &[f64],
    is_symmetric: bool,
    steps: [f64; 2],
    iterations: usize,
) -> Option<f64> {
    let n = diagonal.len();
    let (mut rows, mut columns) = (vec![0.0_f64; n], vec![0.0_f64; n]);
    // A row that keeps its value though others depend on it is a row of no symmetric matrix.
    let mut is_similar = is_symmetric;
    for (i, j, &value) in laplacian.triplet_iter() {
        if i != j && diagonal[i] > 0.0 {
            let size = value.abs() / diagonal[i];
            rows[i] += size;
            columns[j] += size;
        } else if i != j && value != 0.0 {
            is_similar = false;
        }
    }
    let (mut by_rows, mut by_columns) = (1.0, 1.0);
    for step in steps {
        let (mut row, mut column) = (0.0_f64, 0.0_f64);
        for i in 0..n {
            let own = if diagonal[i] > 0.0 { (1.0 - step).abs() } else { 1.0 };
            row = row.max(own + step.abs() * rows[i]);
            column = column.max(own + step.abs() * columns[i]);
        }
        by_rows *= row;
        by_columns *= column;
    }
    let root = (n as f64).sqrt();
    let mut factor = power((by_rows * by_columns).sqrt(), iterations);
    factor = factor.min(root * power(by_rows, iterations)).min(root * power(by_columns, iterations));
    // Weights that overflowed bound nothing.
    if is_similar && by_rows.is_finite() {
        let (mut least, mut most, mut largest) = (f64::INFINITY, 0.0_f64, 0.0_f64);
        for (&d, &row) in diagonal.iter().zip(&rows).filter(|(d, _)| **d > 0.0) {
            least = least.min(d);
            most = most.max(d);
            largest = largest.max(1.0 + row);
        }
        factor = factor.min((most / least).sqrt() * power(largest_response(steps, largest), iterations));
    }
    finite(factor)
}

/// The largest |(1 − μk)(1 − λk)| for k from 0 to `largest`: at an end, or where the derivative is zero.
fn largest_response([lambda, mu]: [f64; 2], largest: f64) -> f64 {
    let response = |k: f64| ((1.0 - mu * k) * (1.0 - lambda * k)).abs();
    let turn = 0.5 * (1.0 / lambda + 1.0 / mu);
    let between = if turn > 0.0 && turn < largest { response(turn) } else { 0.0 };
    response(largest).max(between).max(1.0)
}

/// A power by squaring, in an order of its own: that of `powi` depends on the platform.
fn power(base: f64, exponent: usize) -> f64 {
    let (mut result, mut square, mut left) = (1.0, base, exponent);
    while left > 0 {
        if left & 1 == 1 {
            result *= square;
        }
        square *= square;
        left >>= 1;
    }
    result
}

/// A bound of the norm of some columns, with a factor for each row: the root of the largest sum of a row times that of a column.
pub(super) fn norm_of_columns(
    matrix: &CscMatrix<f64>,
    takes_column: &dyn Fn(usize) -> bool,
    row_scale: &dyn Fn(usize) -> f64,
) -> f64 {
    let mut rows = vec![0.0_f64; matrix.nrows()];
    let mut largest_column = 0.0_f64;
    for (_, column) in matrix.col_iter().enumerate().filter(|(j, _)| takes_column(*j)) {
        let mut sum = 0.0;
        for (&row, value) in column.row_indices().iter().zip(column.values()) {
            let size = value.abs() * row_scale(row);
            rows[row] += size;
            sum += size;
        }
        largest_column = largest_column.max(sum);
    }
    let largest_row = rows.iter().fold(0.0_f64, |largest, &sum| largest.max(sum));
    (largest_row * largest_column).sqrt()
}

/// Vertices that are not active keep their values, or go to a mean: no factor is less than one.
fn finite(factor: f64) -> Option<f64> {
    factor.is_finite().then(|| factor.max(1.0))
}

/// What rounding adds to how far values move that are moved exactly.
const ROUNDING: f64 = 1e-6;

/// The bound of the whole, where besides what it is for, `constant` vertices take the value of one: these are moved as one is, √`constant`
/// times as far in all.
pub(super) fn with_constants(bound: Option<f64>, constant: usize) -> Option<f64> {
    bound.map(|bound| bound.max((constant as f64).sqrt() * (1.0 + ROUNDING)))
}
