//! What a factor will hold, before anything is allocated for it.

use nalgebra_sparse::pattern::SparsityPattern;

use super::ordering::Permutation;

/// The size of a Cholesky factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FactorSize {
    /// Entries of the lower triangle with the diagonal.
    pub nonzeros: u64,
}

impl FactorSize {
    /// Counts the entries of the factor of the permuted pattern: row by row, every entry once, along the elimination tree
    /// (\[Liu90\]).
    pub(super) fn count(pattern: &SparsityPattern, permutation: &Permutation) -> Self {
        let n = pattern.major_dim();
        let (mut parent, mut mark) = (vec![u32::MAX; n], vec![u32::MAX; n]);
        let mut nonzeros = 0_u64;
        for new in 0..n as u32 {
            mark[new as usize] = new;
            nonzeros += 1;
            for &old in pattern.lane(permutation.new_to_old()[new as usize] as usize) {
                let mut v = permutation.old_to_new()[old];
                if v > new {
                    continue;
                }
                while mark[v as usize] != new {
                    if parent[v as usize] == u32::MAX {
                        parent[v as usize] = new;
                    }
                    mark[v as usize] = new;
                    nonzeros += 1;
                    v = parent[v as usize];
                }
            }
        }
        Self { nonzeros }
    }
}
