//! The elimination tree and the column counts of a factor.

use nalgebra_sparse::pattern::SparsityPattern;

use crate::Watch;
use crate::error::Cancelled;
use crate::solve::ordering::Permutation;

pub(super) const NONE: u32 = u32::MAX;

/// An entry of the matrix that is looked at.
const TICKS_PER_ENTRY: u64 = 12;

/// For every unknown, in the order of elimination, its neighbours that come later.
pub(super) struct Later {
    offsets: Vec<u32>,
    neighbours: Vec<u32>,
}

impl Later {
    pub(super) fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    pub(super) fn of(&self, v: usize) -> &[u32] {
        &self.neighbours[self.offsets[v] as usize..self.offsets[v + 1] as usize]
    }
}

/// The elimination tree: the parent of a column is the row of its first entry below the diagonal of the factor
/// (\[Liu90\]).
pub(super) struct EliminationTree {
    /// [`NONE`] for roots.
    pub(super) parents: Vec<u32>,
    /// The unknowns with every subtree together, children before parents.
    pub(super) postorder: Vec<u32>,
}

impl EliminationTree {
    /// The tree, and the graph that it and everything after is made from, in one pass over the pattern.
    pub(super) fn new(
        pattern: &SparsityPattern,
        permutation: &Permutation,
        watch: &Watch<'_>,
    ) -> Result<(Self, Later), Cancelled> {
        let n = pattern.major_dim();
        let old_to_new = permutation.old_to_new();
        let mut offsets = Vec::with_capacity(n + 1);
        let mut neighbours = Vec::with_capacity(pattern.nnz() / 2);
        offsets.push(0);
        let mut parents = vec![NONE; n];
        // Short cuts towards the root of the tree as far as it is known.
        let mut ancestors = vec![NONE; n];
        for (v, &old) in permutation.new_to_old().iter().enumerate() {
            let v = v as u32;
            for &other in pattern.lane(old as usize) {
                let other = old_to_new[other];
                if other > v {
                    neighbours.push(other);
                }
                let mut u = other;
                while u < v {
                    let next = core::mem::replace(&mut ancestors[u as usize], v);
                    if next == NONE {
                        parents[u as usize] = v;
                    }
                    // Ends the walk at a root, and where this row has been already.
                    u = next;
                }
            }
            offsets.push(neighbours.len() as u32);
            watch.tick(TICKS_PER_ENTRY * (2 + pattern.lane(old as usize).len() as u64))?;
        }
        let postorder = postorder(&parents);
        Ok((Self { parents, postorder }, Later { offsets, neighbours }))
    }

    /// How many entries each column of the factor has, the diagonal included, in time almost linear in the entries of the
    /// matrix (\[Gilbert94\]).
    ///
    /// The rows of the factor are subtrees of the elimination tree; a column's count is the number of row subtrees that
    /// contain it. Each of them is added where its leaves are and taken away where paths from two leaves meet.
    pub(super) fn counts(&self, later: &Later, watch: &Watch<'_>) -> Result<Vec<u32>, Cancelled> {
        let n = later.len();
        // Positions in the postorder of each unknown's first descendant; sums that may pass below zero wrap around.
        let mut first = vec![NONE; n];
        let mut counts = vec![0_u32; n];
        for (position, &v) in self.postorder.iter().enumerate() {
            let mut u = v;
            counts[u as usize] = u32::from(first[u as usize] == NONE);
            while u != NONE && first[u as usize] == NONE {
                first[u as usize] = position as u32;
                u = self.parents[u as usize];
            }
        }
        // The largest `first` met in a row, its last leaf, and sets of unknowns whose paths have met.
        let (mut furthest, mut last_leaf) = (vec![NONE; n], vec![NONE; n]);
        let mut sets: Vec<u32> = (0..n as u32).collect();
        for &v in &self.postorder {
            let parent = self.parents[v as usize];
            if parent != NONE {
                counts[parent as usize] = counts[parent as usize].wrapping_sub(1);
            }
            for &row in later.of(v as usize) {
                let row = row as usize;
                if furthest[row] != NONE && first[v as usize] <= furthest[row] {
                    continue;
                }
                furthest[row] = first[v as usize];
                counts[v as usize] = counts[v as usize].wrapping_add(1);
                let previous = core::mem::replace(&mut last_leaf[row], v);
                if previous != NONE {
                    let meeting = find(&mut sets, previous);
                    counts[meeting as usize] = counts[meeting as usize].wrapping_sub(1);
                }
            }
            if parent != NONE {
                sets[v as usize] = parent;
            }
            watch.tick(TICKS_PER_ENTRY * (8 + later.of(v as usize).len() as u64))?;
        }
        for v in 0..n {
            if self.parents[v] != NONE {
                let parent = self.parents[v] as usize;
                counts[parent] = counts[parent].wrapping_add(counts[v]);
            }
        }
        Ok(counts)
    }
}

/// The representative of a set, with all paths shortened on the way.
fn find(sets: &mut [u32], start: u32) -> u32 {
    let mut root = start;
    while sets[root as usize] != root {
        root = sets[root as usize];
    }
    let mut v = start;
    while v != root {
        v = core::mem::replace(&mut sets[v as usize], root);
    }
    root
}

/// Every subtree together, children before parents, children ascending; parents come after their children in the numbering
/// already.
fn postorder(parents: &[u32]) -> Vec<u32> {
    let n = parents.len();
    let (mut first_child, mut next_sibling) = (vec![NONE; n], vec![NONE; n]);
    let mut roots = NONE;
    for v in (0..n).rev() {
        let head = if parents[v] == NONE { &mut roots } else { &mut first_child[parents[v] as usize] };
        next_sibling[v] = *head;
        *head = v as u32;
    }
    let mut order = Vec::with_capacity(n);
    let mut stack = Vec::new();
    let mut next = roots;
    loop {
        while next != NONE {
            stack.push(next);
            next = first_child[next as usize];
        }
        let Some(v) = stack.pop() else { return order };
        order.push(v);
        next = next_sibling[v as usize];
    }
}
