//! Supernodes: columns with nearly the same rows, eliminated together in one dense front.

use super::tree::{EliminationTree, Later, NONE};
use crate::Watch;
use crate::error::SolveError;
use crate::support::counting_sort::{Buckets, grouped};
use crate::support::memory;

/// A row of a front that is gathered from the matrix or a child, and sorted.
const TICKS_PER_ROW: u64 = 60;

/// The fronts in the order of their elimination, and the columns renumbered so that each front's are together.
pub(super) struct Supernodes {
    /// The column (as the tree numbers them) at every place.
    pub(super) order: Vec<u32>,
    /// First place of every front's columns, and the end.
    pub(super) starts: Vec<u32>,
    /// Parent fronts; [`NONE`] for roots.
    pub(super) parents: Vec<u32>,
    /// Rows below the columns of all fronts.
    row_count: usize,
}

/// A set of columns while sets are merged.
#[derive(Clone, Copy)]
struct Group {
    columns: u32,
    /// Rows below the columns.
    rows: u32,
    /// Zeros stored in the columns for the sake of merging.
    zeros: u64,
    parent: u32,
    /// A later group that this one was merged into; itself before that.
    into: u32,
    /// Linked lists of children.
    first_child: u32,
    next_sibling: u32,
}

impl Supernodes {
    pub(super) fn new(tree: &EliminationTree, counts: &[u32]) -> Self {
        let (groups, group_starts) = fundamental(tree, counts);
        let groups = merge(groups);
        arrange(&groups, &group_starts, &tree.postorder)
    }

    /// Where each front's rows below its columns start, and the rows: ascending places.
    pub(super) fn rows(&self, later: &Later, watch: &Watch<'_>) -> Result<(Vec<usize>, Vec<u32>), SolveError> {
        let n = self.order.len();
        let fronts = self.parents.len();
        // The rows before and after sorting, and the fronts of each; what is kept for every unknown, and for every front.
        memory::ensure(
            (12 * self.row_count + (8 + size_of::<usize>()) * n + (8 + 2 * size_of::<usize>()) * fronts) as u64,
        )?;
        let mut place_of = vec![0; n];
        for (place, &column) in self.order.iter().enumerate() {
            place_of[column as usize] = place as u32;
        }
        let (mut row_starts, mut unsorted) =
            (Vec::with_capacity(fronts + 1), Vec::<u32>::with_capacity(self.row_count));
        row_starts.push(0);
        let (mut first_child, mut next_sibling) = (vec![NONE; fronts], vec![NONE; fronts]);
        let mut marks = vec![NONE; n];
        for s in 0..fronts {
            let end = self.starts[s + 1];
            let mut add = |row: u32, rows: &mut Vec<u32>| {
                if row >= end && marks[row as usize] != s as u32 {
                    marks[row as usize] = s as u32;
                    rows.push(row);
                }
            };
            for place in self.starts[s]..end {
                for &row in later.of(self.order[place as usize] as usize) {
                    add(place_of[row as usize], &mut unsorted);
                }
            }
            let mut child = first_child[s];
            while child != NONE {
                for k in row_starts[child as usize]..row_starts[child as usize + 1] {
                    let row = unsorted[k];
                    add(row, &mut unsorted);
                }
                child = next_sibling[child as usize];
            }
            if self.parents[s] != NONE {
                let parent = self.parents[s] as usize;
                next_sibling[s] = first_child[parent];
                first_child[parent] = s as u32;
            }
            watch.tick(TICKS_PER_ROW * (4 + unsorted.len() - row_starts[s]) as u64)?;
            row_starts.push(unsorted.len());
        }
        drop((place_of, marks, first_child, next_sibling));
        let rows = sort_rows(n, &row_starts, &unsorted);
        Ok((row_starts, rows))
    }
}

/// Sorts the rows of all fronts together, in linear time: gathers for every row its fronts, and hands the rows out
/// ascending.
fn sort_rows(n: usize, row_starts: &[usize], unsorted: &[u32]) -> Vec<u32> {
    let mut offsets = vec![0_usize; n + 1];
    for &row in unsorted {
        offsets[row as usize + 1] += 1;
    }
    for row in 0..n {
        offsets[row + 1] += offsets[row];
    }
    let mut fronts = vec![0_u32; unsorted.len()];
    for (s, bounds) in row_starts.windows(2).enumerate() {
        for &row in &unsorted[bounds[0]..bounds[1]] {
            let place = &mut offsets[row as usize];
            fronts[*place] = s as u32;
            *place += 1;
        }
    }
    // The offsets have moved on by one row.
    let mut next = row_starts.to_vec();
    let mut rows = vec![0; unsorted.len()];
    let mut start = 0;
    for (row, &end) in offsets[..n].iter().enumerate() {
        for &s in &fronts[start..end] {
            let place = &mut next[s as usize];
            rows[*place] = row as u32;
            *place += 1;
        }
        start = end;
    }
    rows
}

/// Chains of columns, each the parent of the one before, whose rows differ by that column alone. Also the position in the
/// postorder at which each begins, and the end.
fn fundamental(tree: &EliminationTree, counts: &[u32]) -> (Vec<Group>, Vec<u32>) {
    let n = counts.len();
    let mut group_of = vec![0_u32; n];
    let mut starts = Vec::new();
    let mut groups: Vec<Group> = Vec::new();
    let mut previous = None::<u32>;
    for (position, &v) in tree.postorder.iter().enumerate() {
        let continues =
            previous.is_some_and(|u| tree.parents[u as usize] == v && counts[u as usize] == counts[v as usize] + 1);
        if !continues {
            starts.push(position as u32);
            let into = groups.len() as u32;
            groups.push(Group {
                columns: 0,
                rows: 0,
                zeros: 0,
                parent: NONE,
                into,
                first_child: NONE,
                next_sibling: NONE,
            });
        }
        let last = groups.len() - 1;
        group_of[v as usize] = last as u32;
        groups[last].columns += 1;
        groups[last].rows = counts[v as usize] - 1;
        previous = Some(v);
    }
    starts.push(n as u32);
    // The parent of a group is that of its last column.
    for g in 0..groups.len() {
        let last = tree.postorder[starts[g + 1] as usize - 1];
        let parent = tree.parents[last as usize];
        if parent != NONE {
            groups[g].parent = group_of[parent as usize];
        }
    }
    (groups, starts)
}

/// Whether a front of `columns` columns may store `zeros` zeros among its `entries`.
///
/// Larger fronts run faster until zeros outweigh that: measured on meshes of 10,000 to 1,000,000 vertices.
fn worth_merging(columns: u64, zeros: u64, entries: u64) -> bool {
    let share = zeros as f64 / entries as f64;
    match columns {
        0..=4 => true,
        5..=16 => share < 0.6,
        17..=48 => share < 0.12,
        _ => share < 0.04,
    }
}

/// Merges children into parents where [`worth_merging`]; children come before parents.
fn merge(mut groups: Vec<Group>) -> Vec<Group> {
    for s in 0..groups.len() {
        let mut child = groups[s].first_child;
        while child != NONE {
            let c = groups[child as usize];
            let p = groups[s];
            let columns = u64::from(c.columns) + u64::from(p.columns);
            let new_zeros = u64::from(c.columns) * (u64::from(p.columns) + u64::from(p.rows) - u64::from(c.rows));
            let zeros = c.zeros + p.zeros + new_zeros;
            let entries = columns * (columns + 1) / 2 + columns * u64::from(p.rows);
            if worth_merging(columns, zeros, entries) {
                groups[s].columns = columns as u32;
                groups[s].zeros = zeros;
                groups[child as usize].into = s as u32;
            }
            child = c.next_sibling;
        }
        if groups[s].parent != NONE {
            let parent = groups[s].parent as usize;
            groups[s].next_sibling = groups[parent].first_child;
            groups[parent].first_child = s as u32;
        }
    }
    groups
}

/// Puts the merged groups into an order of elimination that keeps the stack of updates small (\[Liu86\]), and their columns
/// after each other.
fn arrange(groups: &[Group], group_starts: &[u32], postorder: &[u32]) -> Supernodes {
    let count = groups.len();
    // The groups that remain, with the representatives of all others: those they were merged into come later.
    let mut representative: Vec<u32> = (0..count as u32).collect();
    for g in (0..count).rev() {
        if groups[g].into != g as u32 {
            representative[g] = representative[groups[g].into as usize];
        }
    }
    let parent_of = |g: usize| match groups[g].parent {
        NONE => NONE,
        parent => representative[parent as usize],
    };
    let is_front = |g: usize| representative[g] == g as u32;
    let children = Children::new(count, |g| if is_front(g) { parent_of(g) } else { NONE });
    let members = Children::new(count, |g| if is_front(g) { NONE } else { representative[g] });
    let order = children.in_order_of_least_stack(groups);

    let mut supernodes =
        Supernodes { order: Vec::with_capacity(postorder.len()), starts: vec![0], parents: Vec::new(), row_count: 0 };
    let mut front_of = vec![NONE; count];
    let mut groups_in_order = Vec::new();
    let mut visit = |g: usize, supernodes: &mut Supernodes| {
        for &member in members.of(g).iter().chain(&[g as u32]) {
            let columns = group_starts[member as usize] as usize..group_starts[member as usize + 1] as usize;
            supernodes.order.extend_from_slice(&postorder[columns]);
        }
        supernodes.starts.push(supernodes.order.len() as u32);
        supernodes.row_count += groups[g].rows as usize;
        front_of[g] = groups_in_order.len() as u32;
        groups_in_order.push(g);
    };
    for &g in order.iter().filter(|&&g| is_front(g as usize)) {
        visit(g as usize, &mut supernodes);
    }
    supernodes.parents = groups_in_order
        .iter()
        .map(|&g| match parent_of(g) {
            NONE => NONE,
            parent => front_of[parent as usize],
        })
        .collect();
    supernodes
}

/// Children of every node of a forest, ascending.
struct Children {
    offsets: Vec<u32>,
    children: Vec<u32>,
    roots: Vec<u32>,
}

impl Children {
    fn new(count: usize, parent: impl Fn(usize) -> u32) -> Self {
        // Roots are the children of one more node behind the others.
        let parents: Vec<u32> = (0..count).map(|g| parent(g).min(count as u32)).collect();
        let Buckets { offsets, items: mut children } = grouped(&parents, count + 1);
        let roots = children.split_off(offsets[count] as usize);
        Self { offsets, children, roots }
    }

    fn of(&self, g: usize) -> &[u32] {
        &self.children[self.offsets[g] as usize..self.offsets[g + 1] as usize]
    }

    /// All nodes, children before parents, every subtree together; of the children of one node those first that need much
    /// more room on the stack while they are computed than they leave there.
    fn in_order_of_least_stack(mut self, groups: &[Group]) -> Vec<u32> {
        let update = |g: u32| u64::from(groups[g as usize].rows) * (u64::from(groups[g as usize].rows) + 1) / 2;
        let mut peaks = vec![0_u64; groups.len()];
        let mut keys = Vec::new();
        for g in 0..groups.len() {
            let range = self.offsets[g] as usize..self.offsets[g + 1] as usize;
            keys.clear();
            // Smallest key first: the complement of what is freed, saturated, above the child's id.
            keys.extend(self.children[range.clone()].iter().map(|&c| {
                let freed = (peaks[c as usize] - update(c)).min(u64::from(u32::MAX));
                (u64::from(u32::MAX) - freed) << 32 | u64::from(c)
            }));
            keys.sort_unstable();
            let (mut held, mut peak) = (0, 0);
            for (place, &key) in self.children[range].iter_mut().zip(&keys) {
                let c = key as u32;
                *place = c;
                peak = peak.max(held + peaks[c as usize]);
                held += update(c);
            }
            peaks[g] = peak.max(held + update(g as u32));
        }
        let mut order = Vec::with_capacity(groups.len());
        // A depth-first walk from the last to the first, parents before children, reversed.
        let mut stack = core::mem::take(&mut self.roots);
        while let Some(g) = stack.pop() {
            order.push(g);
            stack.extend_from_slice(self.of(g as usize));
        }
        order.reverse();
        order
    }
}
