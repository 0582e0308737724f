//! faer's supernodal Cholesky factorisation, on one thread.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::Perm;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};
use nalgebra_sparse::pattern::SparsityPattern;

pub(crate) struct Faer {
    /// The lower triangle, which is what faer reads.
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
}

/// The lower triangle of a symmetric matrix.
pub(crate) struct Lower {
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
}

impl Lower {
    pub(crate) fn new(pattern: &SparsityPattern, values: &[f64]) -> Self {
        let n = pattern.major_dim();
        let (mut offsets, mut rows, mut kept) = (vec![0], Vec::new(), Vec::new());
        for ((column, row), &value) in pattern.entries().zip(values) {
            if row >= column {
                rows.push(row);
                kept.push(value);
                offsets.resize(column + 1, rows.len() - 1);
            }
        }
        offsets.push(rows.len());
        Self { pattern: SymbolicSparseColMat::new_checked(n, n, offsets, None, rows), values: kept }
    }
}

impl Faer {
    /// Orders by the given permutation, or by faer's minimum degree, and analyses.
    pub(crate) fn new(lower: Lower, order: Option<&[u32]>) -> Self {
        let Lower { pattern, values } = lower;
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let permutation = order.map(|order| {
            let new_to_old: Vec<usize> = order.iter().map(|&old| old as usize).collect();
            let mut old_to_new = vec![0; new_to_old.len()];
            new_to_old.iter().enumerate().for_each(|(new, &old)| old_to_new[old] = new);
            Perm::new_checked(new_to_old.into(), old_to_new.into(), order.len())
        });
        let ordering = match &permutation {
            Some(permutation) => SymmetricOrdering::Custom(permutation.as_ref()),
            None => SymmetricOrdering::Amd,
        };
        let symbolic =
            factorize_symbolic_cholesky(pattern.as_ref(), Side::Lower, ordering, parameters).expect("enough memory");
        Self { pattern, values, symbolic, factor: Vec::new() }
    }

    /// Numbers stored for the factor, with the zeros that its supernodes hold.
    pub(crate) fn nonzeros(&self) -> f64 {
        self.symbolic.len_val() as f64
    }

    pub(crate) fn factor(&mut self) {
        self.factor.resize(self.symbolic.len_val(), 0.0);
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                SparseColMatRef::new(self.pattern.as_ref(), &self.values),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Default::default(),
            )
            .expect("positive definite");
    }

    pub(crate) fn solve(&self, right_hand_sides: &[f64]) -> Vec<f64> {
        let n = self.symbolic.nrows();
        let columns = right_hand_sides.len() / n;
        let mut x = right_hand_sides.to_vec();
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq);
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut x, n, columns),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
        x
    }
}
