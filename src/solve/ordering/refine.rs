//! Smaller vertex separators by local search.

use super::graph::Graph;
use super::queue::BucketQueue;

/// Labels within a part: label − base.
pub(super) const LEFT: u32 = 0;
pub(super) const RIGHT: u32 = 1;
pub(super) const SEPARATOR: u32 = 2;
/// Step between the bases of two parts.
pub(super) const LABELS: u32 = 4;

/// A part cut in two by a vertex separator.
#[derive(Clone, Default)]
pub(super) struct Cut {
    /// Weights of left, right, separator.
    pub(super) weights: [i64; 3],
    /// The vertices of the separator.
    pub(super) separator: Vec<u32>,
}

/// Beyond this share of a part, the difference of its sides counts like edges or unknowns that are cut.
pub(super) const IMBALANCE: f64 = 0.3;

/// What is cut, with a malus for the imbalance. With sides (1 ± d)/2 the work of order n^1.5 below a cut grows by 3/8 d², and
/// it is about twice the work of the separator, which grows like its cube: together as much as a cut longer by 0.3 d².
pub(super) fn cost(cut: f64, all: f64, imbalance: f64) -> f64 {
    let excess = if imbalance > IMBALANCE { imbalance - IMBALANCE } else { 0.0 };
    cut * (1.0 + 0.3 * imbalance * imbalance) + all * excess
}

impl Cut {
    pub(super) fn cost(&self) -> f64 {
        let [left, right, separator] = self.weights.map(|weight| weight as f64);
        let total = left + right + separator;
        cost(separator, total, (left - right).abs() / total)
    }
}

/// Buckets of a queue; gains are counted from the middle.
const BUCKETS: i64 = 512;

/// Vertex Fiduccia–Mattheyses ([Fiduccia82], [Ashcraft98]).
pub(super) struct Refiner {
    /// Separator vertices by the gain of moving them left, and right.
    queues: [BucketQueue; 2],
    gains: [Vec<i32>; 2],
    /// When a vertex was moved last.
    moved: Vec<u32>,
    pass: u32,
    /// Vertex and label before, for every change.
    log: Vec<u64>,
}

impl Refiner {
    pub(super) fn new(n: usize) -> Self {
        Self {
            queues: [BucketQueue::new(n, BUCKETS as usize), BucketQueue::new(n, BUCKETS as usize)],
            gains: [vec![0; n], vec![0; n]],
            moved: vec![0; n],
            pass: 0,
            log: Vec::new(),
        }
    }

    /// Improves a cut until nothing changes or `passes` are over.
    pub(super) fn refine(
        &mut self,
        graph: &Graph,
        labels: &mut [u32],
        base: u32,
        cut: &mut Cut,
        passes: usize,
        unit: i64,
    ) {
        for _ in 0..passes {
            let before = cut.cost();
            self.run(graph, labels, base, cut, unit);
            if cut.cost() >= before {
                break;
            }
        }
    }

    fn run(&mut self, graph: &Graph, labels: &mut [u32], base: u32, cut: &mut Cut, unit: i64) {
        self.pass += 1;
        self.log.clear();
        let mut separator = core::mem::take(&mut cut.separator);
        for &v in &separator {
            self.enter(graph, labels, base, v, unit);
        }
        let mut best = cut.cost();
        let mut best_length = 0;
        let mut best_weights = cut.weights;
        let mut stall = 0;
        let patience = (separator.len() / 2).clamp(30, 200);
        while stall < patience {
            let Some((v, side)) = self.choose(cut) else { break };
            self.shift(graph, labels, base, cut, v, side, unit);
            let cost = cut.cost();
            if cost < best {
                (best, best_length, best_weights, stall) = (cost, self.log.len(), cut.weights, 0);
            } else if best_weights[0].min(best_weights[1]) > 0 {
                stall += 1;
            }
        }
        separator.extend(self.log.iter().map(|&entry| entry as u32));
        for &v in &separator {
            for queue in &mut self.queues {
                if queue.holds(v) {
                    queue.remove(v);
                }
            }
        }
        for &entry in self.log[best_length..].iter().rev() {
            labels[entry as u32 as usize] = (entry >> 32) as u32;
        }
        cut.weights = best_weights;
        // A new stamp, to keep every vertex once.
        self.pass += 1;
        let (moved, pass) = (&mut self.moved, self.pass);
        separator.retain(|&v| {
            labels[v as usize] == base + SEPARATOR && core::mem::replace(&mut moved[v as usize], pass) != pass
        });
        cut.separator = separator;
    }

    /// The best move that leaves the sides balanced.
    fn choose(&mut self, cut: &Cut) -> Option<(u32, usize)> {
        let [left, right, separator] = cut.weights;
        let most = ((left + right + separator) as f64 * 0.5 * (1.0 + IMBALANCE)) as i64;
        let mut best: Option<(u32, usize)> = None;
        for side in 0..2 {
            let (here, there) = (cut.weights[side], cut.weights[1 - side]);
            if here > there && here >= most {
                continue;
            }
            if let Some(v) = self.queues[side].first() {
                let better = match best {
                    None => true,
                    Some((u, other)) => {
                        let (a, b) = (self.gains[side][v as usize], self.gains[other][u as usize]);
                        a > b || a == b && here < there
                    }
                };
                if better {
                    best = Some((v, side));
                }
            }
        }
        best
    }

    fn key(gain: i32, unit: i64) -> u32 {
        (BUCKETS / 2 - i64::from(gain) / unit).clamp(0, BUCKETS - 1) as u32
    }

    /// Puts a separator vertex into the queues.
    fn enter(&mut self, graph: &Graph, labels: &[u32], base: u32, v: u32, unit: i64) {
        let mut sums = [0_i32; 2];
        for &u in graph.of(v) {
            let side = labels[u as usize].wrapping_sub(base);
            if side < 2 {
                sums[side as usize] += graph.weights[u as usize] as i32;
            }
        }
        let own = graph.weights[v as usize] as i32;
        for side in 0..2 {
            let gain = own - sums[1 - side];
            self.gains[side][v as usize] = gain;
            self.queues[side].insert(v, Self::key(gain, unit));
        }
    }

    fn change(&mut self, v: u32, side: usize, difference: i32, unit: i64) {
        let gain = self.gains[side][v as usize] + difference;
        self.gains[side][v as usize] = gain;
        let queue = &mut self.queues[side];
        let key = Self::key(gain, unit);
        if queue.key(v) != key {
            queue.remove(v);
            queue.insert(v, key);
        }
    }

    /// Moves a separator vertex to a side; its neighbours on the other side join the separator.
    fn shift(&mut self, graph: &Graph, labels: &mut [u32], base: u32, cut: &mut Cut, v: u32, side: usize, unit: i64) {
        let other = 1 - side;
        self.queues[0].remove(v);
        self.queues[1].remove(v);
        self.moved[v as usize] = self.pass;
        self.log.push(u64::from(base + SEPARATOR) << 32 | u64::from(v));
        labels[v as usize] = base + side as u32;
        let own = graph.weights[v as usize];
        cut.weights[side] += i64::from(own);
        cut.weights[2] -= i64::from(own);
        for &u in graph.of(v) {
            let label = labels[u as usize];
            if label == base + SEPARATOR {
                if self.queues[0].holds(u) {
                    self.change(u, other, -(own as i32), unit);
                }
            } else if label == base + other as u32 {
                let weight = graph.weights[u as usize];
                self.log.push(u64::from(label) << 32 | u64::from(u));
                labels[u as usize] = base + SEPARATOR;
                cut.weights[other] -= i64::from(weight);
                cut.weights[2] += i64::from(weight);
                for &t in graph.of(u) {
                    if labels[t as usize] == base + SEPARATOR && self.queues[0].holds(t) {
                        self.change(t, side, weight as i32, unit);
                    }
                }
                if self.moved[u as usize] != self.pass {
                    self.enter(graph, labels, base, u, unit);
                }
            }
        }
    }
}
