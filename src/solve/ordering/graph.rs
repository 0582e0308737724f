//! Graphs in compressed rows, and how they get smaller.

use nalgebra_sparse::pattern::SparsityPattern;

use super::ids::{NONE, filled};
use crate::Watch;
use crate::error::{Cancelled, OutOfMemory, SolveError};
use crate::support::counting_sort::grouped;
use crate::support::memory;

/// Neighbours of neighbours are not counted for more neighbours than this: it would take the square of the time.
const MANY: usize = 64;

/// An edge that is looked at, in a graph that does not fit the cache.
const TICKS_PER_EDGE: u64 = 10;

/// Bytes of the graph of a pattern.
pub(super) fn bytes(pattern: &SparsityPattern) -> u64 {
    4 * pattern.nnz() as u64 + 9 * pattern.major_dim() as u64
}

/// An undirected graph without loops, every edge stored at both ends.
pub(super) struct Graph {
    pub(super) offsets: Vec<u32>,
    pub(super) neighbours: Vec<u32>,
    /// How many unknowns a vertex stands for.
    pub(super) weights: Vec<u32>,
    /// How many edges of the finest graph an edge stands for; empty where all are one.
    pub(super) edge_weights: Vec<u32>,
}

impl Graph {
    /// The graph of a square symmetric pattern, and the unknowns of very high degree, which it leaves without edges.
    pub(super) fn new(pattern: &SparsityPattern) -> (Self, Vec<u32>) {
        let n = pattern.major_dim();
        // A row that touches a good part of the matrix only slows the others down (threshold of [Amestoy04]).
        let most = (10.0 * (n as f64).sqrt()).max(16.0) as usize;
        // By degree above, the unknown below.
        let mut keys: Vec<u64> = Vec::new();
        for v in 0..n {
            let degree = pattern.lane(v).len();
            if degree > most {
                keys.push((degree as u64) << 32 | v as u64);
            }
        }
        keys.sort_unstable();
        let dense: Vec<u32> = keys.iter().map(|&key| key as u32).collect();
        let mut is_dense = vec![false; n];
        for &v in &dense {
            is_dense[v as usize] = true;
        }
        let mut offsets = Vec::with_capacity(n + 1);
        let mut neighbours = Vec::with_capacity(pattern.nnz());
        offsets.push(0);
        for v in 0..n {
            if !is_dense[v] {
                for &u in pattern.lane(v) {
                    if u != v && u < n && !is_dense[u] {
                        neighbours.push(u as u32);
                    }
                }
            }
            offsets.push(neighbours.len() as u32);
        }
        (Self { offsets, neighbours, weights: vec![1; n], edge_weights: Vec::new() }, dense)
    }

    pub(super) fn len(&self) -> usize {
        self.weights.len()
    }

    pub(super) fn range(&self, v: u32) -> core::ops::Range<usize> {
        self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize
    }

    pub(super) fn of(&self, v: u32) -> &[u32] {
        &self.neighbours[self.range(v)]
    }

    pub(super) fn edge_weight(&self, edge: usize) -> u32 {
        self.edge_weights.get(edge).copied().unwrap_or(1)
    }

    /// The graph whose vertices are `count` clusters of this one's.
    pub(super) fn contract(&self, cluster_of: &[u32], count: usize, watch: &Watch<'_>) -> Result<Self, SolveError> {
        let members = grouped(cluster_of, count);
        let mut offsets = Vec::with_capacity(count + 1);
        let mut neighbours: Vec<u32> = Vec::new();
        let mut edge_weights: Vec<u32> = Vec::new();
        let mut weights = vec![0; count];
        // Where the edge to a cluster is, if it is behind `begin`.
        let mut place = vec![0_u32; count];
        offsets.push(0);
        for cluster in 0..count {
            let (begin, mut seen) = (neighbours.len(), 4);
            for &v in members.bucket(cluster as u32) {
                let edges = self.range(v).len();
                seen += edges;
                memory::make_room(&mut neighbours, edges)?;
                memory::make_room(&mut edge_weights, edges)?;
                weights[cluster] += self.weights[v as usize];
                for edge in self.range(v) {
                    let other = cluster_of[self.neighbours[edge] as usize] as usize;
                    if other == cluster {
                        continue;
                    }
                    let weight = self.edge_weight(edge);
                    let at = place[other] as usize;
                    if at >= begin && at < neighbours.len() && neighbours[at] == other as u32 {
                        edge_weights[at] += weight;
                    } else {
                        place[other] = neighbours.len() as u32;
                        neighbours.push(other as u32);
                        edge_weights.push(weight);
                    }
                }
            }
            offsets.push(neighbours.len() as u32);
            watch.tick(TICKS_PER_EDGE * seen as u64)?;
        }
        Ok(Self { offsets, neighbours, weights, edge_weights })
    }

    /// The graph of some of the vertices, in the given order with the given weights. `place` is scratch for every vertex, all `NONE`.
    pub(super) fn part(&self, members: &[u32], weights: Vec<u32>, place: &mut [u32]) -> Result<Self, OutOfMemory> {
        for (new, &old) in members.iter().enumerate() {
            place[old as usize] = new as u32;
        }
        let mut offsets = Vec::with_capacity(members.len() + 1);
        let mut neighbours = Vec::new();
        let mut edge_weights = Vec::new();
        offsets.push(0);
        for &old in members {
            memory::make_room(&mut neighbours, self.range(old).len())?;
            if !self.edge_weights.is_empty() {
                memory::make_room(&mut edge_weights, self.range(old).len())?;
            }
            for edge in self.range(old) {
                let new = place[self.neighbours[edge] as usize];
                if new != NONE {
                    neighbours.push(new);
                    if !self.edge_weights.is_empty() {
                        edge_weights.push(self.edge_weights[edge]);
                    }
                }
            }
            offsets.push(neighbours.len() as u32);
        }
        for &old in members {
            place[old as usize] = NONE;
        }
        Ok(Self { offsets, neighbours, weights, edge_weights })
    }

    /// Clusters of up to `most` vertices: a vertex and those of its neighbours that share the most neighbours with it. Returns
    /// the cluster of every vertex and the number of clusters.
    #[inline(never)]
    pub(super) fn cluster(&self, most: usize, watch: &Watch<'_>) -> Result<(Vec<u32>, usize), Cancelled> {
        let n = self.len();
        let mut cluster_of = filled(n);
        let mut sizes: Vec<u32> = Vec::new();
        let mut mark = filled(n);
        let mut free: Vec<u64> = Vec::new();
        for whole in [true, false] {
            for v in 0..n as u32 {
                if cluster_of[v as usize] != NONE {
                    continue;
                }
                let mut seen = self.of(v).len();
                free.clear();
                free.extend(self.of(v).iter().filter(|&&u| cluster_of[u as usize] == NONE).map(|&u| u64::from(u)));
                let wanted = self.of(v).len().min(most - 1);
                if whole && free.len() < wanted {
                    continue;
                }
                if !whole && free.len() < wanted / 2 && self.join(v, 2 * most as u32, &mut cluster_of, &mut sizes) {
                    continue;
                }
                if free.len() > most - 1 && self.of(v).len() <= MANY {
                    for &u in self.of(v) {
                        mark[u as usize] = v;
                    }
                    // Fewest strangers first.
                    for entry in &mut free {
                        seen += self.of(*entry as u32).len();
                        let strangers = self.of(*entry as u32).iter().filter(|&&t| mark[t as usize] != v).count();
                        *entry |= (strangers as u64) << 32;
                    }
                    free.sort_unstable();
                }
                free.truncate(most - 1);
                let cluster = sizes.len() as u32;
                cluster_of[v as usize] = cluster;
                for &u in &free {
                    cluster_of[u as u32 as usize] = cluster;
                }
                sizes.push(1 + free.len() as u32);
                watch.tick(TICKS_PER_EDGE * seen as u64)?;
            }
        }
        let count = sizes.len();
        Ok((cluster_of, count))
    }

    /// Adds a vertex to the neighbouring cluster with the most of its neighbours among those that are not full.
    fn join(&self, v: u32, most: u32, cluster_of: &mut [u32], sizes: &mut [u32]) -> bool {
        // The few clusters around v, with their counts.
        let mut around = [(NONE, 0_u32); 8];
        for &u in self.of(v) {
            let cluster = cluster_of[u as usize];
            if cluster != NONE
                && sizes[cluster as usize] < most
                && let Some(entry) = around.iter_mut().find(|entry| entry.0 == cluster || entry.0 == NONE)
            {
                *entry = (cluster, entry.1 + 1);
            }
        }
        let mut best = around[0];
        for &entry in &around[1..] {
            if entry.1 > best.1 {
                best = entry;
            }
        }
        if best.0 != NONE {
            cluster_of[v as usize] = best.0;
            sizes[best.0 as usize] += 1;
        }
        best.0 != NONE
    }

    /// Pairs of vertices joined by their heaviest edges (\[Karypis98\]), none heavier than `most`, as clusters. Vertices choose in
    /// steps of `stride`.
    pub(super) fn pairs(&self, most: u32, stride: usize, watch: &Watch<'_>) -> Result<(Vec<u32>, usize), Cancelled> {
        let n = self.len();
        let mut cluster_of = filled(n);
        let mut count = 0;
        // A prime; where it divides the size, it does not come by every vertex.
        let stride = if n.is_multiple_of(stride) { 1 } else { stride };
        let mut v = 0;
        for _ in 0..n {
            v = ((v as usize + stride) % n) as u32;
            if cluster_of[v as usize] != NONE {
                continue;
            }
            let (mut best, mut heaviest, mut lightest) = (v, 0, 0);
            for edge in self.range(v) {
                let u = self.neighbours[edge];
                let (weight, mass) = (self.edge_weight(edge), self.weights[u as usize]);
                let better = weight > heaviest || weight == heaviest && mass < lightest;
                if cluster_of[u as usize] == NONE && better && self.weights[v as usize] + mass <= most {
                    (best, heaviest, lightest) = (u, weight, mass);
                }
            }
            cluster_of[v as usize] = count;
            cluster_of[best as usize] = count;
            count += 1;
            watch.tick(TICKS_PER_EDGE * (2 + self.range(v).len() as u64))?;
        }
        Ok((cluster_of, count as usize))
    }
}
