//! The smallest vertex separator near a given one.

use super::NONE;
use super::graph::Graph;
use super::refine::{Cut, LEFT, RIGHT, SEPARATOR};

/// The ends of paths.
const SOURCE: u32 = u32::MAX - 1;
const SINK: u32 = u32::MAX - 2;

/// Finds as many paths as possible that share no vertex through a band around the separator; the smallest
/// separator in the band has one vertex on each of them (Menger's theorem).
pub(super) struct Flow {
    /// The place of a vertex in the band.
    slots: Vec<u32>,
    band: Vec<u32>,
    /// The path through a vertex of the band: where it comes from and where it goes.
    previous: Vec<u32>,
    next: Vec<u32>,
    is_source: Vec<bool>,
    is_sink: Vec<bool>,
    /// When the entrance (2 i) or the exit (2 i + 1) of a vertex was last visited.
    visited: Vec<u32>,
    phase: u32,
    stack: Vec<(u32, u32)>,
}

impl Flow {
    pub(super) fn new(n: usize) -> Self {
        Self {
            slots: vec![NONE; n],
            band: Vec::new(),
            previous: Vec::new(),
            next: Vec::new(),
            is_source: Vec::new(),
            is_sink: Vec::new(),
            visited: Vec::new(),
            phase: 0,
            stack: Vec::new(),
        }
    }

    /// Replaces the separator by the smallest one within `depth` steps, where that is better.
    #[inline(never)]
    pub(super) fn improve(&mut self, graph: &Graph, labels: &mut [u32], base: u32, cut: &mut Cut, depth: usize) {
        self.collect(graph, labels, base, cut, depth);
        self.saturate(graph);
        // What the sources still reach lies left of the separator.
        let mut new = Cut { weights: cut.weights, separator: Vec::new() };
        for i in 0..self.band.len() {
            let v = self.band[i];
            let weight = i64::from(graph.weights[v as usize]);
            new.weights[(labels[v as usize] - base) as usize] -= weight;
            let label = self.label(i);
            new.weights[label as usize] += weight;
            if label == SEPARATOR {
                new.separator.push(v);
            }
        }
        if new.cost() < cut.cost() {
            for i in 0..self.band.len() {
                labels[self.band[i] as usize] = base + self.label(i);
            }
            *cut = new;
        }
        for &v in &self.band {
            self.slots[v as usize] = NONE;
        }
    }

    fn label(&self, i: usize) -> u32 {
        if self.visited[2 * i + 1] == self.phase {
            LEFT
        } else if self.visited[2 * i] == self.phase {
            SEPARATOR
        } else {
            RIGHT
        }
    }

    #[inline(never)] fn collect(&mut self, graph: &Graph, labels: &[u32], base: u32, cut: &Cut, depth: usize) {
        self.band.clear();
        self.band.extend_from_slice(&cut.separator);
        for (i, &v) in self.band.iter().enumerate() {
            self.slots[v as usize] = i as u32;
        }
        let mut begin = 0;
        for _ in 0..depth {
            let end = self.band.len();
            for i in begin..end {
                for &u in graph.of(self.band[i]) {
                    if self.slots[u as usize] == NONE && labels[u as usize].wrapping_sub(base) < SEPARATOR {
                        self.slots[u as usize] = self.band.len() as u32;
                        self.band.push(u);
                    }
                }
            }
            begin = end;
        }
        let n = self.band.len();
        self.is_source.clear();
        self.is_sink.clear();
        self.is_source.resize(n, false);
        self.is_sink.resize(n, false);
        for i in begin..n {
            for &u in graph.of(self.band[i]) {
                if self.slots[u as usize] == NONE {
                    self.is_source[i] |= labels[u as usize] == base + LEFT;
                    self.is_sink[i] |= labels[u as usize] == base + RIGHT;
                }
            }
        }
        for list in [&mut self.previous, &mut self.next] {
            list.clear();
            list.resize(n, NONE);
        }
        self.visited.clear();
        self.visited.resize(2 * n, 0);
        self.phase = 0;
    }

    #[inline(never)] fn saturate(&mut self, graph: &Graph) {
        loop {
            self.phase += 1;
            let mut found = false;
            for i in 0..self.band.len() {
                if self.is_source[i] && self.visited[2 * i] != self.phase {
                    self.visited[2 * i] = self.phase;
                    if self.previous[i] != SOURCE && self.search(graph, i as u32) {
                        found = true;
                    }
                }
            }
            if !found {
                break;
            }
        }
    }

    /// Looks for one more path from a vertex, depth first. The stack holds entrances and exits, each with its next neighbour.
    fn search(&mut self, graph: &Graph, source: u32) -> bool {
        self.stack.clear();
        self.stack.push((2 * source, 0));
        while let Some(&(state, edge)) = self.stack.last() {
            let i = (state / 2) as usize;
            let mut next = NONE;
            if state % 2 == 0 {
                // From the entrance: through an unused vertex, or back along the path that uses it.
                let target = if self.previous[i] == NONE { i as u32 } else { self.previous[i] };
                if edge == 0 && target != SOURCE {
                    next = 2 * target + 1;
                }
                if let Some(top) = self.stack.last_mut() {
                    top.1 = 1;
                }
                if next != NONE && self.visited[next as usize] == self.phase {
                    next = NONE;
                }
            } else {
                if edge == 0 && self.is_sink[i] && self.next[i] != SINK {
                    self.augment();
                    return true;
                }
                // From the exit: to any neighbour, or to the entrance if the path leaves the vertex.
                let neighbours = graph.of(self.band[i]);
                let mut at = edge as usize;
                while at <= neighbours.len() {
                    let candidate = if at < neighbours.len() {
                        let slot = self.slots[neighbours[at] as usize];
                        if slot == NONE || slot == self.next[i] { NONE } else { 2 * slot }
                    } else if self.previous[i] == NONE {
                        NONE
                    } else {
                        2 * i as u32
                    };
                    at += 1;
                    if candidate != NONE && self.visited[candidate as usize] != self.phase {
                        next = candidate;
                        break;
                    }
                }
                if let Some(top) = self.stack.last_mut() {
                    top.1 = at as u32;
                }
            }
            if next == NONE {
                self.stack.pop();
            } else {
                self.visited[next as usize] = self.phase;
                self.stack.push((next, 0));
            }
        }
        false
    }

    /// Lets a path run along the stack.
    fn augment(&mut self) {
        for pair in self.stack.windows(2) {
            let (from, to) = (pair[0].0, pair[1].0);
            // The path leaves a vertex.
            if from % 2 == 1 && to + 1 == from {
                self.previous[(to / 2) as usize] = NONE;
                self.next[(to / 2) as usize] = NONE;
            }
        }
        for pair in self.stack.windows(2) {
            let (from, to) = (pair[0].0, pair[1].0);
            if from % 2 == 1 && to + 1 != from {
                self.next[(from / 2) as usize] = to / 2;
                self.previous[(to / 2) as usize] = from / 2;
            }
        }
        if let (Some(first), Some(last)) = (self.stack.first(), self.stack.last()) {
            self.previous[(first.0 / 2) as usize] = SOURCE;
            self.next[(last.0 / 2) as usize] = SINK;
        }
    }
}
