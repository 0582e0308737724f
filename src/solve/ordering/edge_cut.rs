//! Smaller edge cuts by local search.

use super::graph::Graph;
use super::queue::BucketQueue;
use super::refine::{IMBALANCE, LEFT, RIGHT, cost};
use crate::Watch;
use crate::error::Cancelled;

/// A cut between two sides.
#[derive(Clone, Copy, Default)]
pub(super) struct EdgeCut {
    /// Weights of left and right.
    weights: [i64; 2],
    /// Weight of the edges between.
    edges: i64,
    /// Weight of all edges, at both ends.
    all: i64,
}

impl EdgeCut {
    pub(super) fn of(graph: &Graph, sides: &[u32]) -> Self {
        let mut cut = Self::default();
        for v in 0..graph.len() as u32 {
            cut.weights[sides[v as usize] as usize] += i64::from(graph.weights[v as usize]);
            for edge in graph.range(v) {
                let weight = i64::from(graph.edge_weight(edge));
                cut.all += weight;
                if sides[v as usize] < sides[graph.neighbours[edge] as usize] {
                    cut.edges += weight;
                }
            }
        }
        cut
    }

    /// The weight of the cut edges, with a penalty for the imbalance of the sides.
    pub(super) fn cost(&self) -> f64 {
        let [left, right] = self.weights.map(|weight| weight as f64);
        cost(self.edges as f64, self.all as f64, (left - right).abs() / (left + right))
    }
}

/// A vertex that may be at the cut, and one that moves or is at the cut.
const TICKS_PER_VERTEX: u64 = 30;
const TICKS_PER_MOVE: u64 = 250;

/// Buckets of a queue; gains are counted from the middle.
const BUCKETS: i64 = 512;

/// The search of \[Fiduccia82\]: the vertex with the largest gain changes sides, once in each pass, and the best cut on the way is
/// kept.
pub(super) struct EdgeRefiner {
    /// Vertices at the cut by side and gain of moving them.
    queues: [BucketQueue; 2],
    /// By how much the cut shrinks where a vertex changes sides.
    gains: Vec<i64>,
    /// The pass in which a vertex was last moved.
    moved: Vec<u32>,
    pass: u32,
    log: Vec<u32>,
}

impl EdgeRefiner {
    pub(super) fn new(n: usize) -> Self {
        Self {
            queues: [BucketQueue::new(n, BUCKETS as usize), BucketQueue::new(n, BUCKETS as usize)],
            gains: vec![0; n],
            moved: vec![0; n],
            pass: 0,
            log: Vec::new(),
        }
    }

    /// Improves a cut until that fails or `passes` are over.
    #[inline(never)]
    pub(super) fn refine(
        &mut self,
        graph: &Graph,
        labels: &mut [u32],
        cut: &mut EdgeCut,
        passes: usize,
        watch: &Watch<'_>,
    ) -> Result<(), Cancelled> {
        // Gains in buckets of about a sixteenth of the edges that a vertex has on average; a power of two, as divisions are slow.
        let shift = (cut.all / (16 * graph.len() as i64)).max(1).ilog2();
        let mut boundary: Vec<u32> = (0..graph.len() as u32).collect();
        for _ in 0..passes {
            let before = cut.cost();
            // Boundaries are short but for the first pass, which goes over the whole graph.
            let seen = boundary.len() as u64;
            self.run(graph, labels, cut, shift, &mut boundary);
            watch.tick(TICKS_PER_VERTEX * seen + TICKS_PER_MOVE * (boundary.len() + self.log.len()) as u64)?;
            if cut.cost() >= before {
                break;
            }
        }
        Ok(())
    }

    fn run(&mut self, graph: &Graph, labels: &mut [u32], cut: &mut EdgeCut, shift: u32, boundary: &mut Vec<u32>) {
        self.log.clear();
        // Once as a mark, to list every vertex once.
        self.pass += 1;
        boundary.retain(|&v| {
            core::mem::replace(&mut self.moved[v as usize], self.pass) != self.pass
                && graph.of(v).iter().any(|&u| labels[u as usize] != labels[v as usize])
        });
        self.pass += 1;
        let count = boundary.len();
        if boundary.is_empty() {
            // Everything is on one side; something has to begin.
            boundary.push(0);
        }
        for &v in &*boundary {
            self.enter(graph, labels, v, shift);
        }
        let mut best = cut.cost();
        let (mut best_length, mut best_cut, mut stall) = (0, *cut, 0);
        // Moves without a better cut, once the sides are somewhat alike. More patience takes longer and gains nothing.
        let patience = (count / 2).clamp(12, 200);
        while stall < patience {
            let Some(v) = self.choose(cut) else { break };
            let from = labels[v as usize];
            let weight = i64::from(graph.weights[v as usize]);
            cut.weights[from as usize] -= weight;
            cut.weights[1 - from as usize] += weight;
            cut.edges -= self.gains[v as usize];
            labels[v as usize] = LEFT + RIGHT - from;
            self.queues[from as usize].remove(v);
            self.moved[v as usize] = self.pass;
            self.log.push(v);
            for edge in graph.range(v) {
                let u = graph.neighbours[edge];
                if self.moved[u as usize] == self.pass {
                    continue;
                }
                let side = labels[u as usize] as usize;
                if self.queues[side].holds(u) {
                    let weight = 2 * i64::from(graph.edge_weight(edge));
                    let gain = self.gains[u as usize] + if side == from as usize { weight } else { -weight };
                    self.gains[u as usize] = gain;
                    let key = Self::key(gain, shift);
                    if key != self.queues[side].key(u) {
                        self.queues[side].remove(u);
                        self.queues[side].insert(u, key);
                    }
                } else {
                    boundary.push(u);
                    self.enter(graph, labels, u, shift);
                }
            }
            let cost = cut.cost();
            if cost < best {
                (best, best_length, best_cut, stall) = (cost, self.log.len(), *cut, 0);
            } else if cut.weights[0].min(cut.weights[1]) * 4 > cut.weights[0].max(cut.weights[1]) {
                stall += 1;
            }
        }
        for &v in &*boundary {
            for queue in &mut self.queues {
                if queue.holds(v) {
                    queue.remove(v);
                }
            }
        }
        for &v in &self.log[best_length..] {
            labels[v as usize] = LEFT + RIGHT - labels[v as usize];
        }
        *cut = best_cut;
    }

    fn choose(&mut self, cut: &EdgeCut) -> Option<u32> {
        let most = ((cut.weights[0] + cut.weights[1]) as f64 * 0.5 * (1.0 + IMBALANCE)) as i64;
        let mut best: Option<(u32, i64)> = None;
        for from in 0..2 {
            let (here, there) = (cut.weights[from], cut.weights[1 - from]);
            if there > here && there >= most {
                continue;
            }
            if let Some(v) = self.queues[from].first() {
                let gain = self.gains[v as usize];
                if best.is_none_or(|(_, other)| gain > other || gain == other && here > there) {
                    best = Some((v, gain));
                }
            }
        }
        best.map(|(v, _)| v)
    }

    fn key(gain: i64, shift: u32) -> u32 {
        (BUCKETS / 2 - (gain >> shift)).clamp(0, BUCKETS - 1) as u32
    }

    #[inline(never)]
    fn enter(&mut self, graph: &Graph, labels: &[u32], v: u32, shift: u32) {
        let mut gain = 0;
        for edge in graph.range(v) {
            let weight = i64::from(graph.edge_weight(edge));
            gain += if labels[graph.neighbours[edge] as usize] == labels[v as usize] { -weight } else { weight };
        }
        self.gains[v as usize] = gain;
        self.queues[labels[v as usize] as usize].insert(v, Self::key(gain, shift));
    }
}
