//! nalgebra-sparse's left-looking Cholesky factorisation.

use nalgebra::DMatrix;
use nalgebra_sparse::factorization::{CscCholesky, CscSymbolicCholesky};
use nalgebra_sparse::pattern::SparsityPattern;
use nalgebra_sparse::{CooMatrix, CscMatrix};

pub(crate) struct Csc {
    new_to_old: Vec<u32>,
    values: Vec<f64>,
    symbolic: Option<CscSymbolicCholesky>,
    factor: Option<CscCholesky<f64>>,
}

/// The matrix in its new order, which the crate leaves to its callers.
pub(crate) fn permuted(pattern: &SparsityPattern, values: &[f64], new_to_old: &[u32]) -> CscMatrix<f64> {
    let n = new_to_old.len();
    let mut old_to_new = vec![0; n];
    new_to_old.iter().enumerate().for_each(|(new, &old)| old_to_new[old as usize] = new);
    let mut triplets = CooMatrix::new(n, n);
    for ((column, row), &value) in pattern.entries().zip(values) {
        triplets.push(old_to_new[row], old_to_new[column], value);
    }
    CscMatrix::from(&triplets)
}

impl Csc {
    pub(crate) fn new(permuted: CscMatrix<f64>, new_to_old: &[u32]) -> Self {
        let (pattern, values) = permuted.into_pattern_and_values();
        let symbolic = Some(CscSymbolicCholesky::factor(pattern));
        Self { new_to_old: new_to_old.to_vec(), values, symbolic, factor: None }
    }

    pub(crate) fn factor(&mut self) {
        match (&mut self.factor, self.symbolic.take()) {
            (Some(factor), _) => factor.refactor(&self.values).expect("positive definite"),
            (empty, Some(symbolic)) => {
                *empty = Some(CscCholesky::factor_numerical(symbolic, &self.values).expect("positive definite"));
            }
            (None, None) => unreachable!("one of the two is there"),
        }
    }

    pub(crate) fn nonzeros(&self) -> f64 {
        self.factor.as_ref().map_or(0.0, |factor| factor.l().nnz() as f64)
    }

    pub(crate) fn solve(&self, right_hand_sides: &[f64]) -> Vec<f64> {
        let n = self.new_to_old.len();
        let columns = right_hand_sides.len() / n;
        let permuted = DMatrix::from_fn(n, columns, |i, j| right_hand_sides[j * n + self.new_to_old[i] as usize]);
        let solved = self.factor.as_ref().expect("factorised").solve(&permuted);
        let mut x = vec![0.0; right_hand_sides.len()];
        for j in 0..columns {
            for (i, &old) in self.new_to_old.iter().enumerate() {
                x[j * n + old as usize] = solved[(i, j)];
            }
        }
        x
    }
}
