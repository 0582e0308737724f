//! Fill-reducing orderings.

use nalgebra_sparse::pattern::SparsityPattern;

use crate::error::SolveError;

/// A renumbering of unknowns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Permutation {
    new_to_old: Vec<u32>,
    old_to_new: Vec<u32>,
}

impl Permutation {
    /// From the old ids in their new order.
    ///
    /// # Errors
    /// `DimensionMismatch` where an id is missing or comes twice.
    pub fn new(new_to_old: Vec<u32>) -> Result<Self, SolveError> {
        let n = new_to_old.len();
        let mut old_to_new = vec![u32::MAX; n];
        for (new, &old) in new_to_old.iter().enumerate() {
            match old_to_new.get_mut(old as usize) {
                Some(place) if *place == u32::MAX => *place = new as u32,
                _ => return Err(SolveError::DimensionMismatch { expected: n, actual: old as usize }),
            }
        }
        Ok(Self { new_to_old, old_to_new })
    }

    /// From ids that are known to be a permutation.
    pub(super) fn of_valid(new_to_old: Vec<u32>) -> Self {
        let mut old_to_new = vec![0; new_to_old.len()];
        for (new, &old) in new_to_old.iter().enumerate() {
            old_to_new[old as usize] = new as u32;
        }
        Self { new_to_old, old_to_new }
    }

    /// The old id at every new place.
    #[must_use]
    pub fn new_to_old(&self) -> &[u32] {
        &self.new_to_old
    }

    /// The new place of every old id.
    #[must_use]
    pub fn old_to_new(&self) -> &[u32] {
        &self.old_to_new
    }
}

const NONE: u32 = u32::MAX;

/// Approximate minimum degree on the quotient graph (\[Amestoy96\]): at every step the unknown whose elimination links the
/// fewest others, up to overlaps, goes next. Unknowns that become indistinguishable are merged, eliminated ones that
/// another covers are absorbed, and unknowns of very high degree are put last.
///
/// The pattern must be square and symmetric; the diagonal does not matter.
#[must_use]
pub fn minimum_degree(pattern: &SparsityPattern) -> Vec<u32> {
    let n = pattern.major_dim();
    let mut graph = QuotientGraph::new(pattern);
    while let Some(pivot) = graph.queue.pop() {
        graph.eliminate(pivot);
    }
    let mut order = Vec::with_capacity(n);
    let mut stack = Vec::new();
    for i in 0..graph.pivots.len() {
        stack.push(graph.pivots[i]);
        while let Some(v) = stack.pop() {
            order.push(v);
            let mut child = graph.first_merged[v as usize];
            while child != NONE {
                stack.push(child);
                child = graph.next_merged[child as usize];
            }
        }
    }
    order
}

/// Variables (not yet eliminated) and elements (eliminated pivots, each a clique of variables).
struct QuotientGraph {
    /// Neighbouring variables of a variable that no element covers; for an element, its clique.
    variables: Vec<Vec<u32>>,
    /// Elements next to a variable.
    elements: Vec<Vec<u32>>,
    /// How many original unknowns a variable stands for; 0 once merged or eliminated.
    weight: Vec<u32>,
    /// Sum of the weights in an element's clique; 0 once absorbed.
    clique_weight: Vec<u32>,
    /// Marks of the current pivot's clique.
    in_clique: Vec<bool>,
    /// |L_e \ L_p| for the elements met at the current pivot, valid where `stamp` is current.
    outside: Vec<u32>,
    stamp: Vec<u32>,
    current_stamp: u32,
    /// Neighbours (variables and elements are numbered alike) of the variable that others are compared with.
    mark: Vec<u32>,
    current_mark: u32,
    queue: DegreeQueue,
    pivots: Vec<u32>,
    /// Unknowns that were merged into another: linked lists.
    first_merged: Vec<u32>,
    next_merged: Vec<u32>,
    /// Original unknowns not yet eliminated: a bound on every degree.
    left: u32,
}

impl QuotientGraph {
    fn new(pattern: &SparsityPattern) -> Self {
        let n = pattern.major_dim();
        // A row that touches a good part of the matrix only slows the others down (threshold of [Amestoy04]).
        let dense = (10.0 * (n as f64).sqrt()).max(16.0) as usize;
        let is_dense: Vec<bool> = (0..n).map(|v| pattern.lane(v).len() > dense).collect();
        let mut variables = Vec::with_capacity(n);
        let mut queue = DegreeQueue::new(n);
        for v in 0..n {
            let neighbours: Vec<u32> = if is_dense[v] {
                Vec::new()
            } else {
                pattern.lane(v).iter().filter(|&&u| u != v && !is_dense[u]).map(|&u| u as u32).collect()
            };
            variables.push(neighbours);
        }
        for v in 0..n {
            // Dense rows wait in the last bucket.
            queue.insert(v as u32, if is_dense[v] { n as u32 } else { variables[v].len() as u32 });
        }
        Self {
            variables,
            elements: vec![Vec::new(); n],
            weight: vec![1; n],
            clique_weight: vec![0; n],
            in_clique: vec![false; n],
            outside: vec![0; n],
            stamp: vec![0; n],
            current_stamp: 0,
            mark: vec![0; n],
            current_mark: 0,
            queue,
            pivots: Vec::new(),
            first_merged: vec![NONE; n],
            next_merged: vec![NONE; n],
            left: n as u32,
        }
    }

    fn eliminate(&mut self, pivot: u32) {
        let p = pivot as usize;
        self.left -= self.weight[p];
        self.weight[p] = 0;
        self.pivots.push(pivot);
        let mut clique = self.take_clique(p);
        self.count_outside(&clique);
        let clique_weight: u32 = clique.iter().map(|&v| self.weight[v as usize]).sum();
        let mut hashes: Vec<u64> = Vec::with_capacity(clique.len());
        for &v in &clique {
            self.update(v, pivot, clique_weight, &mut hashes);
        }
        self.merge_indistinguishable(hashes);
        for &v in &clique {
            self.in_clique[v as usize] = false;
        }
        clique.retain(|&v| self.weight[v as usize] > 0);
        self.clique_weight[p] = clique.iter().map(|&v| self.weight[v as usize]).sum();
        self.variables[p] = clique;
        self.elements[p] = Vec::new();
    }

    /// The variables next to the pivot, directly or through its elements, which are absorbed; marked in `in_clique`.
    fn take_clique(&mut self, p: usize) -> Vec<u32> {
        let mut clique = Vec::new();
        let mut sources = vec![core::mem::take(&mut self.variables[p])];
        for e in core::mem::take(&mut self.elements[p]) {
            if self.clique_weight[e as usize] > 0 {
                self.clique_weight[e as usize] = 0;
                sources.push(core::mem::take(&mut self.variables[e as usize]));
            }
        }
        for v in sources.into_iter().flatten() {
            if self.weight[v as usize] > 0 && !self.in_clique[v as usize] {
                self.in_clique[v as usize] = true;
                clique.push(v);
            }
        }
        clique
    }

    /// For every element next to the clique, the weight of its part outside of the clique.
    fn count_outside(&mut self, clique: &[u32]) {
        self.current_stamp += 1;
        for &v in clique {
            for &e in &self.elements[v as usize] {
                let e = e as usize;
                if self.clique_weight[e] == 0 {
                    continue;
                }
                if self.stamp[e] != self.current_stamp {
                    self.stamp[e] = self.current_stamp;
                    self.outside[e] = self.clique_weight[e];
                }
                self.outside[e] -= self.weight[v as usize];
            }
        }
    }

    /// Cleans the lists of a variable of the clique, estimates its degree, and notes its hash.
    fn update(&mut self, v: u32, pivot: u32, clique_weight: u32, hashes: &mut Vec<u64>) {
        let i = v as usize;
        let mut degree = 0_u32;
        let mut hash = pivot;
        let mut elements = core::mem::take(&mut self.elements[i]);
        elements.retain(|&e| {
            let e = e as usize;
            // An element without a part outside is covered by the new one.
            let alive = self.clique_weight[e] > 0 && self.outside[e] > 0;
            if alive {
                degree = degree.saturating_add(self.outside[e]);
                hash = hash.wrapping_add(e as u32);
            } else {
                self.clique_weight[e] = 0;
            }
            alive
        });
        elements.push(pivot);
        self.elements[i] = elements;
        let mut variables = core::mem::take(&mut self.variables[i]);
        variables.retain(|&u| {
            let outside = self.weight[u as usize] > 0 && !self.in_clique[u as usize];
            if outside {
                degree = degree.saturating_add(self.weight[u as usize]);
                hash = hash.wrapping_add(u);
            }
            outside
        });
        self.variables[i] = variables;
        let inside = clique_weight - self.weight[i];
        let bound = self.queue.degree(v).saturating_add(inside);
        let degree = degree.saturating_add(inside).min(bound).min(self.left - self.weight[i]);
        self.queue.remove(v);
        self.queue.insert(v, degree);
        // The hash above, the variable below.
        hashes.push(u64::from(hash) << 32 | u64::from(v));
    }

    fn is_marked(&self, neighbour: u32) -> bool {
        self.mark[neighbour as usize] == self.current_mark
    }

    /// Merges variables of the clique with the same neighbours: they stay equal until eliminated.
    fn merge_indistinguishable(&mut self, mut hashes: Vec<u64>) {
        hashes.sort_unstable();
        for group in hashes.chunk_by(|a, b| a >> 32 == b >> 32).filter(|group| group.len() > 1) {
            for (place, v) in group.iter().map(|&packed| packed as u32).enumerate() {
                if self.weight[v as usize] == 0 {
                    continue;
                }
                self.current_mark += 1;
                for &neighbour in self.variables[v as usize].iter().chain(&self.elements[v as usize]) {
                    self.mark[neighbour as usize] = self.current_mark;
                }
                for u in group[place + 1..].iter().map(|&packed| packed as u32) {
                    let (i, j) = (v as usize, u as usize);
                    let same = self.weight[j] > 0
                        && self.variables[i].len() == self.variables[j].len()
                        && self.elements[i].len() == self.elements[j].len()
                        && self.variables[j].iter().chain(&self.elements[j]).all(|&x| self.is_marked(x));
                    if same {
                        let degree = self.queue.degree(v).saturating_sub(self.weight[j]);
                        self.weight[i] += self.weight[j];
                        self.weight[j] = 0;
                        self.queue.remove(u);
                        self.queue.remove(v);
                        self.queue.insert(v, degree);
                        self.next_merged[j] = self.first_merged[i];
                        self.first_merged[i] = u;
                        self.variables[j] = Vec::new();
                        self.elements[j] = Vec::new();
                    }
                }
            }
        }
    }
}

/// Variables in buckets by degree: doubly linked lists, so that every operation but finding the next minimum is O(1).
struct DegreeQueue {
    heads: Vec<u32>,
    next: Vec<u32>,
    previous: Vec<u32>,
    degrees: Vec<u32>,
    smallest: usize,
}

impl DegreeQueue {
    fn new(n: usize) -> Self {
        Self {
            heads: vec![NONE; n + 1],
            next: vec![NONE; n],
            previous: vec![NONE; n],
            degrees: vec![0; n],
            smallest: 0,
        }
    }

    fn degree(&self, v: u32) -> u32 {
        self.degrees[v as usize]
    }

    fn insert(&mut self, v: u32, degree: u32) {
        let d = (degree as usize).min(self.heads.len() - 1);
        let head = self.heads[d];
        self.next[v as usize] = head;
        self.previous[v as usize] = NONE;
        if head != NONE {
            self.previous[head as usize] = v;
        }
        self.heads[d] = v;
        self.degrees[v as usize] = d as u32;
        self.smallest = self.smallest.min(d);
    }

    fn remove(&mut self, v: u32) {
        let (next, previous) = (self.next[v as usize], self.previous[v as usize]);
        if next != NONE {
            self.previous[next as usize] = previous;
        }
        if previous == NONE {
            self.heads[self.degrees[v as usize] as usize] = next;
        } else {
            self.next[previous as usize] = next;
        }
    }

    fn pop(&mut self) -> Option<u32> {
        while self.smallest < self.heads.len() {
            let head = self.heads[self.smallest];
            if head != NONE {
                self.remove(head);
                return Some(head);
            }
            self.smallest += 1;
        }
        None
    }
}
