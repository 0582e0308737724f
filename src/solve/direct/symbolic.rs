//! What a factor will hold, and the fronts it is computed in, before anything is allocated for it.

use nalgebra_sparse::pattern::SparsityPattern;

use super::supernodes::Supernodes;
use super::tree::{EliminationTree, NONE};
use crate::solve::ordering::Permutation;

/// The size of a Cholesky factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FactorSize {
    /// Entries of the lower triangle with the diagonal, without the zeros that are stored to keep columns together.
    pub nonzeros: u64,
    /// Multiplications and additions: the sum of the squares of the entries per column.
    pub flops: u64,
}

impl FactorSize {
    fn of(counts: &[u32]) -> Self {
        let sum = |each: fn(u64) -> u64| counts.iter().map(|&count| each(count.into())).fold(0, u64::saturating_add);
        Self { nonzeros: sum(|count| count), flops: sum(|count| count * count) }
    }
}

/// The analysis of a pattern: the order of elimination, and the fronts.
///
/// The fronts are the supernodes of the elimination tree, children before parents. Front `s` eliminates the columns
/// `starts[s]..starts[s + 1]`; below them it has the rows `rows_of(s)`, ascending, all of them columns of its ancestors.
#[derive(Debug)]
pub(super) struct Symbolic {
    /// The order of elimination: the ordering given, with every front's columns brought together.
    pub(super) permutation: Permutation,
    pub(super) starts: Vec<u32>,
    row_starts: Vec<usize>,
    rows: Vec<u32>,
    /// How many children hand an update over.
    pub(super) children: Vec<u32>,
    /// Whether the distance from the root is odd: fronts keep their updates at one end of the stack and find those of
    /// their children at the other.
    pub(super) odd: Vec<bool>,
    pub(super) size: FactorSize,
}

impl Symbolic {
    pub(super) fn new(pattern: &SparsityPattern, permutation: &Permutation) -> Self {
        let (tree, later) = EliminationTree::new(pattern, permutation);
        let counts = tree.counts(&later);
        let size = FactorSize::of(&counts);
        let supernodes = Supernodes::new(&tree, &counts);
        drop(tree);
        let (row_starts, rows) = supernodes.rows(&later);
        let new_to_old: Vec<u32> = supernodes.order.iter().map(|&v| permutation.new_to_old()[v as usize]).collect();
        let fronts = supernodes.parents.len();
        let (mut children, mut odd) = (vec![0; fronts], vec![false; fronts]);
        for s in (0..fronts).rev() {
            if let Some(&parent) = Some(&supernodes.parents[s]).filter(|&&parent| parent != NONE) {
                children[parent as usize] += 1;
                odd[s] = !odd[parent as usize];
            }
        }
        Self {
            permutation: Permutation::from_valid(new_to_old),
            starts: supernodes.starts,
            row_starts,
            rows,
            children,
            odd,
            size,
        }
    }

    /// Number of fronts.
    pub(super) fn fronts(&self) -> usize {
        self.children.len()
    }

    /// The columns that front `s` eliminates.
    pub(super) fn columns(&self, s: usize) -> core::ops::Range<usize> {
        self.starts[s] as usize..self.starts[s + 1] as usize
    }

    /// The rows below the columns of front `s`.
    pub(super) fn rows_of(&self, s: usize) -> &[u32] {
        &self.rows[self.row_starts[s]..self.row_starts[s + 1]]
    }
}
