//! Pairs of the Morse complex in the order in which they are cancelled, and what is left of it at a threshold.

use super::NONE;
use super::paths::{Crossing, Paths};
use super::simple_saddles::SimpleSaddles;
use crate::field::merging::Merging;
use crate::field::order::VertexOrder;
use crate::field::sorting::{ascending_bits, sort_by_key};
use crate::field::steepest::{Steepest, ends};
use crate::field::sweep::Sweep;
use crate::mesh::TriMesh;
use crate::support::union_find::UnionFind;

/// An extremum and a simple saddle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cancellation {
    pub(super) extremum: u32,
    pub(super) simple: u32,
    pub(super) upwards: bool,
    pub(super) persistence: f64,
    /// The extremum that takes over.
    pub(super) into: u32,
    /// First vertices of the saddle's paths to the extremum and to the one that takes over.
    here: u32,
    beyond: u32,
}

/// All that thresholds have in common.
pub(super) struct Cancellations {
    pub(super) steepest: Steepest,
    pub(super) simple_saddles: SimpleSaddles,
    /// For every vertex the minimum and the maximum that its path leads to; nothing where nothing is cancelled.
    pub(super) ends: [Vec<u32>; 2],
    /// By ascending persistence.
    pub(super) list: Vec<Cancellation>,
    /// In how many pairs each simple saddle is: at a boundary it may be in one of each direction.
    pairs: Vec<u8>,
}

impl Cancellations {
    /// Pairs of persistence above `limit` are left out, and all of them where it is 0.
    pub(super) fn new(mesh: &TriMesh, order: VertexOrder<'_>, limit: f64) -> Self {
        let steepest = Steepest::by_slope(mesh, order);
        let simple_saddles = SimpleSaddles::new(mesh, order);
        let ends = if limit > 0.0 { [ends(&steepest.down), ends(&steepest.up)] } else { [Vec::new(), Vec::new()] };
        let (mut found, mut pairs) = (Vec::new(), vec![0_u8; simple_saddles.len()]);
        for upwards in [false, true].into_iter().filter(|_| limit > 0.0) {
            let sweep = if upwards { Sweep::downwards(order) } else { Sweep::upwards(order) };
            let mut merging = Merging::new(sweep, ends[usize::from(upwards)].clone());
            let paths = if upwards { &simple_saddles.up } else { &simple_saddles.down };
            for i in 0..simple_saddles.len() {
                let simple = simple_saddles.ascending[if upwards { simple_saddles.len() - 1 - i } else { i }];
                let [a, b] = paths[simple as usize];
                if a == NONE || b == NONE {
                    continue;
                }
                let Some(merged) = merging.join(a, b) else { continue };
                let (extremum, saddle) = (merged.ended, simple_saddles.vertices[simple as usize]);
                let persistence = (order.values()[extremum as usize] - order.values()[saddle as usize]).abs();
                pairs[simple as usize] += 1;
                if persistence <= limit {
                    found.push(Cancellation { extremum, simple, upwards, persistence, into: NONE, here: a, beyond: b });
                }
            }
        }
        // Among equals the one that a sweep met first comes first: what it joined has to be one already.
        let mut sorted: Vec<u32> = (0..found.len() as u32).collect();
        sort_by_key(&mut sorted, &|i| ascending_bits(found[i as usize].persistence));
        let mut this =
            Self { steepest, simple_saddles, ends, list: sorted.iter().map(|&i| found[i as usize]).collect(), pairs };
        this.find_successors();
        this
    }

    /// In order of persistence, the arcs of a cancelled extremum go over to the one on the other side of its saddle.
    fn find_successors(&mut self) {
        let mut joined = self.ends.each_ref().map(|ends| UnionFind::new(ends.clone()));
        for cancellation in &mut self.list {
            let joined = &mut joined[usize::from(cancellation.upwards)];
            let Cancellation { here, beyond, extremum, .. } = *cancellation;
            let (a, b) = (joined.find(here), joined.find(beyond));
            if a == extremum {
                cancellation.into = b;
            } else {
                (cancellation.here, cancellation.beyond, cancellation.into) = (beyond, here, a);
            }
            joined.link(extremum, cancellation.into);
        }
    }

    /// The paths down and up once all of the list up to a threshold is cancelled.
    pub(super) fn paths(&self, threshold: f64) -> [Paths<'_>; 2] {
        let crossings = [false, true].map(|side| {
            let of_side = self.up_to(threshold).iter().filter(|cancellation| cancellation.upwards == side);
            of_side.map(|c| Crossing { simple: c.simple, extremum: c.extremum, sides: [c.here, c.beyond] }).collect()
        });
        let [down, up]: [Vec<Crossing>; 2] = crossings;
        [
            Paths::new(&self.steepest.down, &self.ends[0], &self.simple_saddles.vertices, &down),
            Paths::new(&self.steepest.up, &self.ends[1], &self.simple_saddles.vertices, &up),
        ]
    }

    /// For every vertex that is an extremum, down and up, the one that has taken its place at a threshold.
    pub(super) fn extrema(&self, threshold: f64) -> [Vec<u32>; 2] {
        let mut extrema = [(); 2].map(|()| (0..self.ends[0].len() as u32).collect::<Vec<u32>>());
        let cancelled = self.up_to(threshold);
        // The one that takes over is cancelled later, if at all.
        for cancellation in cancelled.iter().rev() {
            let extrema = &mut extrema[usize::from(cancellation.upwards)];
            extrema[cancellation.extremum as usize] = extrema[cancellation.into as usize];
        }
        extrema
    }

    /// The simple saddles that are left at a threshold: one that is in two pairs goes with the second.
    pub(super) fn alive(&self, threshold: f64) -> Vec<bool> {
        let mut pairs = self.pairs.clone();
        let mut alive = vec![true; self.simple_saddles.len()];
        for cancellation in self.up_to(threshold) {
            let left = &mut pairs[cancellation.simple as usize];
            *left -= 1;
            alive[cancellation.simple as usize] = *left > 0;
        }
        alive
    }

    fn up_to(&self, threshold: f64) -> &[Cancellation] {
        let end = if threshold > 0.0 {
            self.list.partition_point(|cancellation| cancellation.persistence <= threshold)
        } else {
            0
        };
        &self.list[..end]
    }
}
