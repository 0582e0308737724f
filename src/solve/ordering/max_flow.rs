//! The smallest vertex separator near a given one, by a maximum flow.

use super::graph::Graph;
use super::ids::{NONE, filled};
use super::refine::{Cut, LEFT, RIGHT, SEPARATOR};
use crate::Watch;
use crate::error::{Cancelled, OutOfMemory, SolveError};
use crate::support::memory;

/// An edge of the band, each time that its shortest paths are sought.
const TICKS_PER_EDGE: u64 = 12;

/// What is kept for every vertex of the band besides its neighbours, while lists grow, too.
const BYTES_PER_VERTEX: usize = 90;

/// The ends of paths.
const SOURCE: u32 = u32::MAX - 1;
const SINK: u32 = u32::MAX - 2;

/// The method of \[Ashcraft98\]: finds as many paths as possible that share no vertex through a band around the separator; the smallest
/// separator in the band has one vertex on each of them (Menger's theorem).
pub(super) struct MaxFlow {
    /// The place of a vertex in the band.
    slots: Vec<u32>,
    band: Vec<u32>,
    /// The neighbours of every vertex of the band within it.
    offsets: Vec<u32>,
    neighbours: Vec<u32>,
    /// The path through a vertex of the band: where it comes from and where it goes.
    previous: Vec<u32>,
    next: Vec<u32>,
    is_source: Vec<bool>,
    is_sink: Vec<bool>,
    /// Steps from the sources to the entrance (2 i) and the exit (2 i + 1) of a vertex.
    steps: Vec<u32>,
    queue: Vec<u32>,
    /// Entrances and exits of a path, each with its place in the list of what follows it.
    stack: Vec<(u32, u32)>,
}

impl MaxFlow {
    pub(super) fn new(n: usize) -> Self {
        Self {
            slots: filled(n),
            band: Vec::new(),
            offsets: Vec::new(),
            neighbours: Vec::new(),
            previous: Vec::new(),
            next: Vec::new(),
            is_source: Vec::new(),
            is_sink: Vec::new(),
            steps: Vec::new(),
            queue: Vec::new(),
            stack: Vec::new(),
        }
    }

    /// Replaces the separator by the smallest one within `depth` steps, where that is better.
    #[inline(never)]
    pub(super) fn improve(
        &mut self,
        graph: &Graph,
        labels: &mut [u32],
        base: u32,
        cut: &mut Cut,
        depth: usize,
        watch: &Watch<'_>,
    ) -> Result<(), SolveError> {
        self.collect(graph, labels, base, cut, depth)?;
        self.saturate(watch)?;
        // What the sources still reach lies left of the separator.
        let mut new = Cut { sizes: cut.sizes, separator: Vec::new() };
        for i in 0..self.band.len() {
            let v = self.band[i];
            new.sizes[(labels[v as usize] - base) as usize] -= 1;
            let label = self.label(i);
            new.sizes[label as usize] += 1;
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
        Ok(())
    }

    fn label(&self, i: usize) -> u32 {
        if self.steps[2 * i + 1] != NONE {
            LEFT
        } else if self.steps[2 * i] != NONE {
            SEPARATOR
        } else {
            RIGHT
        }
    }

    fn collect(
        &mut self,
        graph: &Graph,
        labels: &[u32],
        base: u32,
        cut: &Cut,
        depth: usize,
    ) -> Result<(), OutOfMemory> {
        self.band.clear();
        self.band.extend_from_slice(&cut.separator);
        for (i, &v) in self.band.iter().enumerate() {
            self.slots[v as usize] = i as u32;
        }
        let mut begin = 0;
        for _ in 0..depth {
            let end = self.band.len();
            for i in begin..end {
                let around = graph.of(self.band[i]);
                memory::make_room(&mut self.band, around.len())?;
                for &u in around {
                    if self.slots[u as usize] == NONE && labels[u as usize].wrapping_sub(base) < SEPARATOR {
                        self.slots[u as usize] = self.band.len() as u32;
                        self.band.push(u);
                    }
                }
            }
            begin = end;
        }
        let n = self.band.len();
        memory::ensure((BYTES_PER_VERTEX * n) as u64)?;
        self.is_source.clear();
        self.is_sink.clear();
        self.is_source.resize(n, false);
        self.is_sink.resize(n, false);
        self.offsets.clear();
        self.neighbours.clear();
        self.offsets.push(0);
        for i in 0..n {
            let around = graph.of(self.band[i]);
            memory::make_room(&mut self.neighbours, around.len())?;
            for &u in around {
                let slot = self.slots[u as usize];
                if slot == NONE {
                    self.is_source[i] |= labels[u as usize] == base + LEFT;
                    self.is_sink[i] |= labels[u as usize] == base + RIGHT;
                } else {
                    self.neighbours.push(slot);
                }
            }
            self.offsets.push(self.neighbours.len() as u32);
        }
        for list in [&mut self.previous, &mut self.next] {
            list.clear();
            list.resize(n, NONE);
        }
        Ok(())
    }

    /// Blocking flows on shortest paths until there is none (\[Dinic70\]).
    fn saturate(&mut self, watch: &Watch<'_>) -> Result<(), Cancelled> {
        while self.measure() {
            watch.tick(TICKS_PER_EDGE * self.neighbours.len() as u64)?;
            for i in 0..self.band.len() {
                if self.is_source[i] && self.previous[i] != SOURCE {
                    self.search(i as u32);
                }
            }
        }
        for i in 0..self.band.len() {
            if self.is_source[i] && self.steps[2 * i] == NONE {
                self.steps[2 * i] = 0;
            }
        }
        Ok(())
    }

    /// The one exit that follows an entrance, if any: through an unused vertex, or back along the path that uses it.
    fn exit(&self, i: usize) -> u32 {
        match self.previous[i] {
            NONE => 2 * i as u32 + 1,
            SOURCE => NONE,
            from => 2 * from + 1,
        }
    }

    /// The entrances that follow an exit: of any neighbour, or, where a path leaves the vertex, its own.
    fn around(&self, i: usize) -> core::ops::Range<usize> {
        self.offsets[i] as usize..self.offsets[i + 1] as usize
    }

    /// Whether a path can end here.
    fn ends(&self, state: u32) -> bool {
        let i = (state / 2) as usize;
        state % 2 == 1 && self.is_sink[i] && self.next[i] != SINK
    }

    /// Counts the steps from the sources to everything they reach, up to the nearest sink; whether there is one.
    fn measure(&mut self) -> bool {
        self.steps.clear();
        self.steps.resize(2 * self.band.len(), NONE);
        self.queue.clear();
        for i in 0..self.band.len() {
            if self.is_source[i] && self.previous[i] != SOURCE {
                self.steps[2 * i] = 0;
                self.queue.push(2 * i as u32);
            }
        }
        let mut last = NONE;
        let mut head = 0;
        while head < self.queue.len() {
            let state = self.queue[head];
            head += 1;
            let steps = self.steps[state as usize];
            if steps >= last {
                break;
            }
            if self.ends(state) {
                last = steps;
            }
            let i = (state / 2) as usize;
            if state & 1 == 0 {
                let exit = self.exit(i);
                self.reach(exit, steps + 1);
            } else {
                for k in self.around(i) {
                    if self.neighbours[k] != self.next[i] {
                        self.reach(2 * self.neighbours[k], steps + 1);
                    }
                }
                if self.previous[i] != NONE {
                    self.reach(2 * i as u32, steps + 1);
                }
            }
        }
        last != NONE
    }

    fn reach(&mut self, state: u32, steps: u32) {
        if state != NONE && self.steps[state as usize] == NONE {
            self.steps[state as usize] = steps;
            self.queue.push(state);
        }
    }

    /// Looks for one more shortest path from a vertex, depth first, and takes it.
    fn search(&mut self, source: u32) {
        self.stack.clear();
        self.stack.push((2 * source, 0));
        while let Some(&(state, mut place)) = self.stack.last() {
            if place == 0 && self.ends(state) {
                self.augment();
                break;
            }
            let wanted = self.steps[state as usize] + 1;
            let i = (state / 2) as usize;
            let mut next = NONE;
            if state & 1 == 0 {
                let exit = self.exit(i);
                if exit != NONE && self.steps[exit as usize] == wanted {
                    next = exit;
                }
            } else {
                let around = &self.neighbours[self.around(i)];
                while next == NONE && (place as usize) < around.len() {
                    let slot = around[place as usize];
                    place += 1;
                    if slot != self.next[i] && self.steps[2 * slot as usize] == wanted {
                        next = 2 * slot;
                    }
                }
                if next == NONE && self.previous[i] != NONE && self.steps[2 * i] == wanted {
                    next = 2 * i as u32;
                }
            }
            if let Some(top) = self.stack.last_mut() {
                top.1 = place.max(1);
            }
            if next == NONE {
                // Nobody needs to come here again.
                self.steps[state as usize] = NONE;
                self.stack.pop();
            } else {
                self.stack.push((next, 0));
            }
        }
        for &(state, _) in &self.stack {
            self.steps[state as usize] = NONE;
        }
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
