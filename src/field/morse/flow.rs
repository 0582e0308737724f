//! Where vertices flow to in one direction, before and after cancellations.

use super::NONE;

/// A forest: every vertex leads on to another one, and an extremum to itself. Behind the vertices come the simple saddles,
/// through which cancelled extrema flow; such an entry is for the vertex of its saddle.
#[derive(Debug)]
pub(super) struct Flow<'a> {
    next: Vec<u32>,
    vertices: usize,
    /// The vertex of every simple saddle.
    saddles: &'a [u32],
}

impl<'a> Flow<'a> {
    /// `steepest` has the next vertex of each vertex.
    pub(super) fn new(mut steepest: Vec<u32>, saddles: &'a [u32]) -> Self {
        let vertices = steepest.len();
        steepest.extend((vertices as u32..).take(saddles.len()));
        Self { next: steepest, vertices, saddles }
    }

    /// Cancels an extremum with a simple saddle: what flowed to the extremum now goes back along the path that came down (or
    /// up) from the saddle, and over it. `here` is the first vertex of that path, `beyond` that of the other path of the
    /// saddle.
    pub(super) fn cancel(&mut self, unit: u32, here: u32, beyond: u32) {
        let saddle = self.vertices as u32 + unit;
        let (mut before, mut at) = (saddle, here);
        loop {
            let next = core::mem::replace(&mut self.next[at as usize], before);
            if next == at {
                break;
            }
            (before, at) = (at, next);
        }
        self.next[saddle as usize] = beyond;
    }

    /// The entry after `at`; `None` at an extremum.
    #[inline]
    pub(super) fn next(&self, at: u32) -> Option<u32> {
        let next = self.next[at as usize];
        (next != at).then_some(next)
    }

    /// The vertex of an entry.
    #[inline]
    pub(super) fn vertex(&self, at: u32) -> u32 {
        match (at as usize).checked_sub(self.vertices) {
            Some(unit) => self.saddles[unit],
            None => at,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.next.len()
    }

    /// For every entry the extremum that it flows to.
    pub(super) fn ends(&self) -> Vec<u32> {
        ends(&self.next)
    }

    /// For every entry how many there are from it to its extremum, both included.
    pub(super) fn lengths(&self) -> Vec<u32> {
        let mut lengths = vec![0_u32; self.next.len()];
        let mut path = Vec::new();
        for start in 0..self.next.len() as u32 {
            let mut at = start;
            while lengths[at as usize] == 0 {
                path.push(at);
                match self.next(at) {
                    Some(next) => at = next,
                    None => break,
                }
            }
            let mut length = lengths[at as usize];
            while let Some(at) = path.pop() {
                length += 1;
                lengths[at as usize] = length;
            }
        }
        lengths
    }
}

/// For every vertex the extremum that it flows to along steepest paths.
pub(super) fn ends(steepest: &[u32]) -> Vec<u32> {
    let mut ends = vec![NONE; steepest.len()];
    let mut path = Vec::new();
    for start in 0..steepest.len() as u32 {
        let mut at = start;
        while ends[at as usize] == NONE && steepest[at as usize] != at {
            path.push(at);
            at = steepest[at as usize];
        }
        let end = if ends[at as usize] == NONE { at } else { ends[at as usize] };
        ends[at as usize] = end;
        for &v in &path {
            ends[v as usize] = end;
        }
        path.clear();
    }
    ends
}
