//! Where steepest paths lead in one direction, before and after cancellations.

use crate::error::{Cancelled, FieldError};
use crate::field::arrays::{filled, push, with_room};
use crate::field::steepest::ends;
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// The work with one step along a path.
const STEP: u64 = 5;

/// A forest: every vertex leads on to another one, and an extremum to itself. Behind the vertices come the simple saddles,
/// over which the paths of cancelled extrema go on; such an entry is for the vertex of its saddle.
#[derive(Debug)]
pub(super) struct Paths<'a> {
    next: Vec<u32>,
    vertices: usize,
    /// The vertex of every simple saddle.
    saddles: &'a [u32],
    /// Vertices that cancelled paths lead over: only there can a path come back to where it began. Empty where there are none.
    crossed: Vec<bool>,
}

/// A simple saddle that the path of a cancelled extremum goes over, with the first vertices of its two paths.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    pub(super) simple: u32,
    pub(super) extremum: u32,
    pub(super) sides: [u32; 2],
}

impl<'a> Paths<'a> {
    /// `steepest` has the next vertex of each vertex, `ends` the extremum at which its path ends, where there are crossings.
    ///
    /// Cancelling an extremum turns round the path that comes down (or up) from the saddle to it, so that what led to it goes
    /// back and over the saddle. One such path after the other would be turned round again and again: what comes of it in the
    /// end is a tree of basins with the crossings as its edges, and every basin leads to the one next to it on the way to the
    /// extremum that is left.
    pub(super) fn new(
        steepest: &[u32],
        ends: &[u32],
        saddles: &'a [u32],
        crossings: &[Crossing],
        watch: &Watch<'_>,
    ) -> Result<Self, FieldError> {
        let vertices = steepest.len();
        watch.tick(2 * (vertices + saddles.len()) as u64)?;
        let mut next = with_room(vertices + saddles.len())?;
        next.extend_from_slice(steepest);
        next.extend((vertices as u32..).take(saddles.len()));
        let mut this = Self { next, vertices, saddles, crossed: Vec::new() };
        if !crossings.is_empty() {
            this.crossed = filled(false, vertices)?;
            this.lead_over(ends, crossings, watch)?;
            watch.tick(20 * crossings.len() as u64)?;
            this.cut_short(crossings);
        }
        Ok(this)
    }

    fn lead_over(&mut self, ends: &[u32], crossings: &[Crossing], watch: &Watch<'_>) -> Result<(), FieldError> {
        watch.tick(5 * self.vertices as u64 + 20 * crossings.len() as u64)?;
        // The crossings of each basin, in compressed rows.
        let mut offsets = filled(0_u32, self.vertices + 1)?;
        for end in crossings.iter().flat_map(|crossing| crossing.sides).map(|side| ends[side as usize]) {
            offsets[end as usize] += 1;
        }
        let mut total = 0;
        for offset in &mut offsets {
            total += *offset;
            *offset = total;
        }
        let mut around = filled(0_u32, total as usize)?;
        for (i, crossing) in crossings.iter().enumerate() {
            for side in crossing.sides {
                let place = &mut offsets[ends[side as usize] as usize];
                *place -= 1;
                around[*place as usize] = i as u32;
            }
        }
        let of_basin = |basin: u32| &around[offsets[basin as usize] as usize..offsets[basin as usize + 1] as usize];
        let mut known = filled(false, self.vertices)?;
        for crossing in crossings {
            known[crossing.extremum as usize] = true;
        }
        // What is left of each tree of basins: the extremum that is not cancelled.
        let mut waiting = Vec::new();
        for end in crossings.iter().flat_map(|crossing| crossing.sides).map(|side| ends[side as usize]) {
            if !core::mem::replace(&mut known[end as usize], true) {
                push(&mut waiting, end)?;
            }
        }
        let mut done = filled(false, crossings.len())?;
        while let Some(basin) = waiting.pop() {
            for &i in of_basin(basin) {
                if core::mem::replace(&mut done[i as usize], true) {
                    continue;
                }
                let Crossing { simple, sides: [a, b], .. } = crossings[i as usize];
                let (to, from) = if ends[a as usize] == basin { (a, b) } else { (b, a) };
                watch.tick(STEP * self.turn_round(simple, from, to))?;
                push(&mut waiting, ends[from as usize])?;
            }
        }
        Ok(())
    }

    /// What led from `from` on to its extremum leads back, over the simple saddle and on to `to`. Returns how long that was.
    fn turn_round(&mut self, simple: u32, from: u32, to: u32) -> u64 {
        let mut length = 1;
        let saddle = self.vertices as u32 + simple;
        let vertex = self.saddles[simple as usize];
        let (mut before, mut at) = (saddle, from);
        self.crossed[vertex as usize] = true;
        loop {
            self.crossed[at as usize] = true;
            let next = core::mem::replace(&mut self.next[at as usize], before);
            if next == at {
                break;
            }
            (before, at) = (at, next);
            length += 1;
        }
        self.next[saddle as usize] = to;
        // The vertex of the saddle itself need not go to `from` and back.
        if self.next[vertex as usize] == from {
            self.next[vertex as usize] = saddle;
        }
        length
    }

    /// Where a path over a saddle would come back to its vertex at once, it stays there.
    fn cut_short(&mut self, crossings: &[Crossing]) {
        for crossing in crossings {
            let saddle = (self.vertices as u32 + crossing.simple) as usize;
            let back = self.next[self.next[saddle] as usize];
            if self.vertex(back) == self.saddles[crossing.simple as usize] && back != self.next[saddle] {
                self.next[saddle] = back;
            }
        }
    }

    /// Where the path from a saddle begins whose first vertex was `first`: behind the place where it last comes back over the
    /// saddle, if it does.
    ///
    /// # Errors
    /// `Cancelled`: such a path can be as long as the mesh, and many saddles can share it.
    pub(super) fn beginning(&self, saddle: u32, first: u32, watch: &Watch<'_>) -> Result<u32, Cancelled> {
        let (mut begin, mut at) = (first, first);
        if !self.crossed.is_empty() && self.crossed[saddle as usize] {
            while let Some(next) = self.next(at) {
                watch.tick(STEP)?;
                if self.vertex(at) == saddle {
                    begin = next;
                }
                at = next;
            }
        }
        Ok(begin)
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
            Some(simple) => self.saddles[simple],
            None => at,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.next.len()
    }

    /// For every entry the extremum at which its path ends.
    pub(super) fn ends(&self, watch: &Watch<'_>) -> Result<Vec<u32>, FieldError> {
        ends(&self.next, watch)
    }

    /// For every entry how many there are from it to its extremum, both included.
    pub(super) fn lengths(&self, watch: &Watch<'_>) -> Result<Vec<u32>, FieldError> {
        let mut lengths = filled(0_u32, self.next.len())?;
        let mut path = Vec::new();
        for range in ranges(self.next.len(), 10, watch) {
            for start in range? {
                let mut at = start as u32;
                while lengths[at as usize] == 0 {
                    push(&mut path, at)?;
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
        }
        Ok(lengths)
    }
}
