//! Nested dissection.

use nalgebra_sparse::pattern::SparsityPattern;

use super::bisection::bisect;
use super::edge_cut::EdgeRefiner;
use super::graph::{Graph, bytes};
use super::ids::{NONE, filled};
use super::leaf::LeafOrder;
use super::max_flow::MaxFlow;
use super::minimum_degree::order_graph;
use super::refine::{Cut, LABELS, Refiner, SEPARATOR};
use crate::Watch;
use crate::error::{OutOfMemory, SolveError};
use crate::support::counting_sort::grouped;
use crate::support::memory;

/// Parts up to this size are ordered by minimum degree. Smaller ones save some more entries, but hardly any operations.
const LEAF: usize = 120;
/// From this size on, separators are worth the search for the smallest ones near by.
const LARGE: usize = 3000;
/// How far that goes, in steps.
const DEPTH: usize = 2;
/// Passes of the local search. Further ones hardly change anything.
const PASSES: usize = 2;

/// What is kept for every unknown besides the graphs.
const BYTES_PER_UNKNOWN: u64 = 140;

/// An unknown of a part that is labelled, grouped and handed down.
const TICKS_PER_MEMBER: u64 = 80;
/// A pair of unknowns of a leaf.
const TICKS_PER_LEAF: u64 = 8;

/// Nested dissection (\[George73\]) of the graph of a square symmetric pattern: a small set of unknowns that separates the rest
/// into two parts of similar size comes last, and each of the parts is ordered alike, until minimum degree takes over. Leaves
/// less fill than [`minimum_degree`](super::minimum_degree) on large meshes, and a balanced elimination tree. Returns the old
/// ids in their new order; the same for the same pattern everywhere.
///
/// Unknowns are gathered into clusters once. A separator begins as a small edge cut between clusters, found by levels, and is
/// refined among the unknowns themselves. Where the unknowns are does not matter: cuts across the axes of a mesh were hardly
/// ever smaller than those found from its graph.
///
/// # Errors
/// `Cancelled`; `OutOfMemory`.
pub fn nested_dissection(pattern: &SparsityPattern, watch: &Watch<'_>) -> Result<Vec<u32>, SolveError> {
    memory::ensure(bytes(pattern) + BYTES_PER_UNKNOWN * pattern.major_dim() as u64)?;
    let (graph, dense) = Graph::new(pattern);
    let n = graph.len();
    let mut is_dense = vec![false; n];
    for &v in &dense {
        is_dense[v as usize] = true;
    }
    let mut order: Vec<u32> = (0..n as u32).filter(|&v| !is_dense[v as usize]).collect();
    // Four of the seven around a vertex of a mesh, eight of the nineteen in the graph of a squared operator.
    let cluster_size = (2 + graph.neighbours.len() / (3 * n.max(1))).clamp(2, 8);
    let (cluster_of, count) = graph.cluster(cluster_size, watch)?;
    let clusters = graph.contract(&cluster_of, count, watch)?;
    let mut dissection = Dissection {
        labels: filled(n),
        refiner: Refiner::new(n),
        flow: MaxFlow::new(n),
        cluster_refiner: EdgeRefiner::new(count),
        leaf: LeafOrder::new(n),
        place: filled(count),
        local: filled(count),
        base: 0,
        stack: Vec::new(),
        spare: Vec::new(),
        graph,
        cluster_of,
    };
    let end = order.len();
    dissection.stack.push(Part { begin: 0, end, ids: (0..count as u32).collect(), clusters });
    while let Some(part) = dissection.stack.pop() {
        dissection.split(&mut order, &part, watch)?;
    }
    order.extend_from_slice(&dense);
    Ok(order)
}

/// Unknowns to order, contiguous in the order, and their clusters.
struct Part {
    begin: usize,
    end: usize,
    /// The clusters that they belong to.
    ids: Vec<u32>,
    /// The graph of these, with the weights of what belongs to this part. It has all edges of the part, and perhaps some more.
    clusters: Graph,
}

struct Dissection {
    graph: Graph,
    cluster_of: Vec<u32>,
    /// The side of an unknown: the base of its part and `LEFT`, `RIGHT` or `SEPARATOR`. Unknowns with lower labels are in
    /// other parts or in separators.
    labels: Vec<u32>,
    base: u32,
    refiner: Refiner,
    flow: MaxFlow,
    cluster_refiner: EdgeRefiner,
    leaf: LeafOrder,
    /// The vertex of a cluster in the graph of the current part.
    local: Vec<u32>,
    /// Scratch for every cluster, all `NONE`.
    place: Vec<u32>,
    /// Scratch for the unknowns of a part.
    spare: Vec<u32>,
    /// Parts to do.
    stack: Vec<Part>,
}

impl Dissection {
    /// Orders a small part; cuts a larger one in two and leaves these for later.
    #[inline(never)]
    fn split(&mut self, order: &mut [u32], part: &Part, watch: &Watch<'_>) -> Result<(), SolveError> {
        let members = &mut order[part.begin..part.end];
        if members.len() <= LEAF {
            self.leaf.order(&self.graph, members);
            return Ok(watch.tick(TICKS_PER_LEAF * (members.len() * members.len()) as u64)?);
        }
        watch.tick(TICKS_PER_MEMBER * members.len() as u64)?;
        for (i, &id) in part.ids.iter().enumerate() {
            self.local[id as usize] = i as u32;
        }
        let (component_of, count) = components(&part.clusters);
        if count > 1 {
            let groups: Vec<u32> = members.iter().map(|&v| component_of[self.cluster(v)]).collect();
            return Ok(self.descend(members, part, &groups, count, count)?);
        }
        let sides = bisect(&part.clusters, &mut self.cluster_refiner, watch)?;
        self.base += LABELS;
        let mut cut = self.separate(members, &part.clusters, &sides);
        self.refiner.refine(&self.graph, &mut self.labels, self.base, &mut cut, PASSES, watch)?;
        if members.len() >= LARGE {
            self.flow.improve(&self.graph, &mut self.labels, self.base, &mut cut, DEPTH, watch)?;
        }
        let smaller = cut.sizes[0].min(cut.sizes[1]) as usize;
        // Large parts of meshes do with a few hundredths. What needs a sixth, as random graphs do, is better left to minimum degree.
        let is_thick = members.len() >= LARGE / 3 && cut.separator.len() * 6 > members.len();
        if smaller < cut.separator.len() || smaller * 50 < members.len() || is_thick {
            return self.order_whole(members, watch);
        }
        let groups: Vec<u32> = members.iter().map(|&v| self.labels[v as usize] - self.base).collect();
        Ok(self.descend(members, part, &groups, 3, 2)?)
    }

    fn cluster(&self, v: u32) -> usize {
        self.local[self.cluster_of[v as usize] as usize] as usize
    }

    /// Labels the unknowns of a part by the sides of their clusters; those next to the other side, on both sides, make a first
    /// separator, twice as thick as needed.
    #[inline(never)]
    fn separate(&mut self, members: &[u32], clusters: &Graph, sides: &[u32]) -> Cut {
        let is_at_cut: Vec<bool> = (0..sides.len())
            .map(|c| clusters.of(c as u32).iter().any(|&other| sides[other as usize] != sides[c]))
            .collect();
        for &v in members {
            self.labels[v as usize] = self.base + sides[self.cluster(v)];
        }
        let mut cut = Cut::default();
        for &v in members {
            let cluster = self.cluster(v);
            let across = self.base + 1 - sides[cluster];
            if is_at_cut[cluster] && self.graph.of(v).iter().any(|&u| self.labels[u as usize] == across) {
                cut.separator.push(v);
            } else {
                cut.sizes[sides[cluster] as usize] += 1;
            }
        }
        cut.sizes[SEPARATOR as usize] = cut.separator.len() as u32;
        for &v in &cut.separator {
            self.labels[v as usize] = self.base + SEPARATOR;
        }
        cut
    }

    /// Puts the groups one behind the other, and the first `parts` of them on the stack.
    fn descend(
        &mut self,
        members: &mut [u32],
        part: &Part,
        group_of: &[u32],
        count: usize,
        parts: usize,
    ) -> Result<(), OutOfMemory> {
        self.spare.clear();
        self.spare.extend_from_slice(members);
        let groups = grouped(group_of, count);
        for (place, &item) in members.iter_mut().zip(&groups.items) {
            *place = self.spare[item as usize];
        }
        for group in 0..parts {
            let (begin, end) = (groups.offsets[group] as usize, groups.offsets[group + 1] as usize);
            // The clusters of a part, with what they still hold.
            let mut kept: Vec<u32> = Vec::new();
            let mut weights: Vec<u32> = Vec::new();
            if end - begin > LEAF {
                for &v in &members[begin..end] {
                    let cluster = self.local[self.cluster_of[v as usize] as usize];
                    let place = &mut self.place[cluster as usize];
                    if *place == NONE {
                        *place = kept.len() as u32;
                        kept.push(cluster);
                        weights.push(0);
                    }
                    weights[*place as usize] += 1;
                }
                for &cluster in &kept {
                    self.place[cluster as usize] = NONE;
                }
            }
            let clusters = part.clusters.part(&kept, weights, &mut self.place)?;
            let ids = kept.iter().map(|&cluster| part.ids[cluster as usize]).collect();
            self.stack.push(Part { begin: part.begin + begin, end: part.begin + end, ids, clusters });
        }
        Ok(())
    }

    /// Orders a part that has no separator.
    #[inline(never)]
    fn order_whole(&mut self, members: &mut [u32], watch: &Watch<'_>) -> Result<(), SolveError> {
        memory::ensure(8 * (self.graph.len() + members.len()) as u64)?;
        let mut place = filled(self.graph.len());
        let part = self.graph.part(members, vec![1; members.len()], &mut place)?;
        let old = members.to_vec();
        for (place, &new) in members.iter_mut().zip(&order_graph(&part, watch)?) {
            *place = old[new as usize];
        }
        Ok(())
    }
}

/// The component of every vertex, and the number of components.
#[inline(never)]
fn components(graph: &Graph) -> (Vec<u32>, usize) {
    let mut component_of = filled(graph.len());
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in 0..graph.len() as u32 {
        if component_of[seed as usize] == NONE {
            component_of[seed as usize] = count;
            stack.push(seed);
            while let Some(v) = stack.pop() {
                for &u in graph.of(v) {
                    if component_of[u as usize] == NONE {
                        component_of[u as usize] = count;
                        stack.push(u);
                    }
                }
            }
            count += 1;
        }
    }
    (component_of, count as usize)
}
