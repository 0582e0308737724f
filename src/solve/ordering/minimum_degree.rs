//! Approximate minimum degree.

use nalgebra_sparse::pattern::SparsityPattern;

use super::graph::Graph;
use super::ids::NONE;
use super::queue::BucketQueue;
use crate::Watch;
use crate::error::SolveError;
use crate::support::memory;

/// What the quotient graph takes for each vertex, and for each edge at each of its ends.
const BYTES_PER_VERTEX: usize = 180;
const BYTES_PER_EDGE: usize = 8;

/// A pivot, and a variable of its clique.
const TICKS_PER_PIVOT: u64 = 200;
const TICKS_PER_VARIABLE: u64 = 60;

/// Approximate minimum degree on the quotient graph (\[Amestoy96\]): at every step the unknown whose elimination links the
/// fewest others, up to overlaps, goes next. Unknowns that become indistinguishable are merged, eliminated ones that
/// another covers are absorbed, and unknowns of very high degree are put last.
///
/// The pattern must be square and symmetric; the diagonal does not matter.
///
/// # Errors
/// `Cancelled`; `OutOfMemory`.
pub fn minimum_degree(pattern: &SparsityPattern, watch: &Watch<'_>) -> Result<Vec<u32>, SolveError> {
    memory::ensure(super::graph::bytes(pattern))?;
    let (graph, dense) = Graph::new(pattern);
    let mut order = order_graph(&graph, watch)?;
    // The unknowns of very high degree have lost their edges; they go to the end.
    let mut is_dense = vec![false; order.len()];
    for &v in &dense {
        is_dense[v as usize] = true;
    }
    order.retain(|&v| !is_dense[v as usize]);
    order.extend_from_slice(&dense);
    Ok(order)
}

/// Orders the vertices of a compact graph.
pub(super) fn order_graph(graph: &Graph, watch: &Watch<'_>) -> Result<Vec<u32>, SolveError> {
    memory::ensure((BYTES_PER_VERTEX * graph.len() + BYTES_PER_EDGE * graph.neighbours.len()) as u64)?;
    let mut graph = QuotientGraph::new(graph);
    while let Some(pivot) = graph.queue.pop() {
        graph.eliminate(pivot);
        watch.tick(TICKS_PER_PIVOT + TICKS_PER_VARIABLE * graph.variables[pivot as usize].len() as u64)?;
    }
    let mut order = Vec::with_capacity(graph.weight.len());
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
    Ok(order)
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
    queue: BucketQueue,
    pivots: Vec<u32>,
    /// Unknowns that were merged into another: linked lists.
    first_merged: Vec<u32>,
    next_merged: Vec<u32>,
    /// Original unknowns not yet eliminated: a bound on every degree.
    left: u32,
}

impl QuotientGraph {
    fn new(graph: &Graph) -> Self {
        let n = graph.len();
        let mut queue = BucketQueue::new(n, n + 1);
        let mut variables = Vec::with_capacity(n);
        for v in 0..n as u32 {
            queue.insert(v, graph.of(v).len() as u32);
            variables.push(graph.of(v).to_vec());
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
        let bound = self.queue.key(v).saturating_add(inside);
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
                        let degree = self.queue.key(v).saturating_sub(self.weight[j]);
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
