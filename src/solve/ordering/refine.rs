//! Smaller vertex separators by local search.

use super::graph::Graph;
use super::queue::BucketQueue;
use crate::Watch;
use crate::error::Cancelled;

/// What a label says beyond the base of its part.
pub(super) const LEFT: u32 = 0;
pub(super) const RIGHT: u32 = 1;
pub(super) const SEPARATOR: u32 = 2;
/// From the base of a part to that of the next.
pub(super) const LABELS: u32 = 3;

/// Beyond this share of a part, the difference of its sides counts like edges or unknowns that are cut.
pub(super) const IMBALANCE: f64 = 0.3;

/// What is cut, with a penalty for the imbalance. With sides (1 ± d)/2 the work of order n^1.5 below a cut grows by 3/8 d², and
/// it is about twice the work of the separator, which grows like its cube: together as much as a cut longer by 0.3 d².
pub(super) fn cost(cut: f64, all: f64, imbalance: f64) -> f64 {
    let excess = if imbalance > IMBALANCE { imbalance - IMBALANCE } else { 0.0 };
    cut * (1.0 + 0.3 * imbalance * imbalance) + all * excess
}

/// A part cut in two by a vertex separator.
#[derive(Default)]
pub(super) struct Cut {
    /// How many unknowns are left, right, and in the separator.
    pub(super) sizes: [u32; 3],
    pub(super) separator: Vec<u32>,
}

impl Cut {
    pub(super) fn cost(&self) -> f64 {
        let [left, right, separator] = self.sizes.map(f64::from);
        let all = left + right + separator;
        cost(separator, all, (left - right).abs() / all)
    }
}

/// An unknown that enters the separator or leaves it.
const TICKS_PER_MOVE: u64 = 350;

/// More unknowns than these that a move drags along make no difference.
const KEYS: usize = 256;

/// The search of \[Fiduccia82\] for vertex separators (\[Hendrickson98\]): an unknown of the separator moves to a side, and its
/// neighbours on the other side join the separator. The best cut on the way is kept, so that a pass may climb out of a hollow.
pub(super) struct Refiner {
    /// The unknowns of the separator, by how many others join it where they move left, or right.
    queues: [BucketQueue; 2],
    joining: [Vec<u32>; 2],
    /// The pass in which an unknown was last moved: once in each.
    moved: Vec<u32>,
    pass: u32,
    /// Every change: the label before above, the unknown below.
    log: Vec<u64>,
}

impl Refiner {
    pub(super) fn new(n: usize) -> Self {
        Self {
            queues: [BucketQueue::new(n, KEYS), BucketQueue::new(n, KEYS)],
            joining: [vec![0; n], vec![0; n]],
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
        base: u32,
        cut: &mut Cut,
        passes: usize,
        watch: &Watch<'_>,
    ) -> Result<(), Cancelled> {
        for _ in 0..passes {
            let before = cut.cost();
            let seen = cut.separator.len();
            self.run(graph, labels, base, cut);
            watch.tick(TICKS_PER_MOVE * (seen + self.log.len()) as u64)?;
            if cut.cost() >= before {
                break;
            }
        }
        Ok(())
    }

    fn run(&mut self, graph: &Graph, labels: &mut [u32], base: u32, cut: &mut Cut) {
        self.pass += 1;
        self.log.clear();
        let mut separator = core::mem::take(&mut cut.separator);
        // In a clique every move drags all the others along; the moves of a mesh stay far below.
        let mut work = 0;
        for &v in &separator {
            self.enter(graph, labels, base, v);
            work += 16 * graph.of(v).len();
        }
        let (mut best, mut best_sizes, mut best_length) = (cut.cost(), cut.sizes, 0);
        // Moves without a better cut.
        let (mut stall, patience) = (0, (separator.len() / 2).clamp(30, 200));
        while stall < patience && work > 0 {
            let Some((v, side)) = self.choose(cut) else { break };
            work = work.saturating_sub(self.shift(graph, labels, base, cut, v, side));
            let cost = cut.cost();
            stall += 1;
            if cost < best {
                (best, best_sizes, best_length, stall) = (cost, cut.sizes, self.log.len(), 0);
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
        cut.sizes = best_sizes;
        // Another pass number, to list every unknown once.
        self.pass += 1;
        let (moved, pass) = (&mut self.moved, self.pass);
        separator.retain(|&v| {
            labels[v as usize] == base + SEPARATOR && core::mem::replace(&mut moved[v as usize], pass) != pass
        });
        cut.separator = separator;
    }

    /// The best move that does not unbalance the sides.
    fn choose(&mut self, cut: &Cut) -> Option<(u32, usize)> {
        let all: u32 = cut.sizes.iter().sum();
        let most = (f64::from(all) * 0.5 * (1.0 + IMBALANCE)) as u32;
        let mut best = None;
        let mut fewest = u32::MAX;
        for side in 0..2 {
            let (here, there) = (cut.sizes[side], cut.sizes[1 - side]);
            if here > there && here >= most {
                continue;
            }
            if let Some(v) = self.queues[side].first() {
                let joining = self.joining[side][v as usize];
                if best.is_none() || joining < fewest || joining == fewest && here < there {
                    best = Some((v, side));
                    fewest = joining;
                }
            }
        }
        best
    }

    /// Puts an unknown of the separator into the queues.
    #[inline(never)]
    fn enter(&mut self, graph: &Graph, labels: &[u32], base: u32, v: u32) {
        let mut counts = [0; 2];
        for &u in graph.of(v) {
            let side = labels[u as usize].wrapping_sub(base);
            if side < SEPARATOR {
                counts[side as usize] += 1;
            }
        }
        for side in 0..2 {
            self.joining[side][v as usize] = counts[1 - side];
            self.queues[side].insert(v, counts[1 - side]);
        }
    }

    fn change(&mut self, v: u32, side: usize, joining: u32) {
        self.joining[side][v as usize] = joining;
        self.queues[side].remove(v);
        self.queues[side].insert(v, joining);
    }

    /// Moves an unknown from the separator to a side. Returns how many neighbours that took.
    fn shift(&mut self, graph: &Graph, labels: &mut [u32], base: u32, cut: &mut Cut, v: u32, side: usize) -> usize {
        let other = 1 - side;
        self.queues[0].remove(v);
        self.queues[1].remove(v);
        self.moved[v as usize] = self.pass;
        self.log.push(u64::from(base + SEPARATOR) << 32 | u64::from(v));
        labels[v as usize] = base + side as u32;
        cut.sizes[side] += 1;
        cut.sizes[2] -= 1;
        let mut work = graph.of(v).len();
        for &u in graph.of(v) {
            let label = labels[u as usize];
            if label == base + SEPARATOR {
                if self.queues[0].holds(u) {
                    self.change(u, other, self.joining[other][u as usize].wrapping_add(1));
                }
            } else if label == base + other as u32 {
                self.log.push(u64::from(label) << 32 | u64::from(u));
                labels[u as usize] = base + SEPARATOR;
                cut.sizes[other] -= 1;
                cut.sizes[2] += 1;
                work += graph.of(u).len();
                for &t in graph.of(u) {
                    if self.queues[0].holds(t) {
                        self.change(t, side, self.joining[side][t as usize].wrapping_sub(1));
                    }
                }
                if self.moved[u as usize] != self.pass {
                    self.enter(graph, labels, base, u);
                }
            }
        }
        work
    }
}
