//! Pairs of the Morse complex in the order in which they are cancelled, and what is left of it at a threshold.

use super::NONE;
use super::paths::{Crossing, Paths};
use super::simple_saddles::SimpleSaddles;
use crate::error::FieldError;
use crate::field::arrays::{collected, copied, filled, numbers, push};
use crate::field::merging::Merging;
use crate::field::order::VertexOrder;
use crate::field::sorting::{ascending_bits, sort_by_key};
use crate::field::steepest::{Steepest, ends};
use crate::field::sweep::Sweep;
use crate::mesh::TriMesh;
use crate::support::pieces::{pieces, ranges};
use crate::support::union_find::UnionFind;
use crate::support::watch::{Phase, Watch};

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

/// The shares of: steepest paths, simple saddles, the ends of paths, pairing and sorting.
const STEPS: [(Phase, f64); 4] = [(Phase::Field, 4.0), (Phase::Field, 3.0), (Phase::Field, 1.0), (Phase::Field, 3.0)];

/// All that thresholds have in common.
pub(super) struct Cancellations {
    pub(super) steepest: Steepest,
    pub(super) simple_saddles: SimpleSaddles,
    /// For every vertex the minimum and the maximum that its path leads to; nothing where nothing is cancelled.
    pub(super) ends: [Vec<u32>; 2],
    /// The pairs by ascending persistence.
    pub(super) list: Vec<Cancellation>,
    /// In how many pairs each simple saddle is: at a boundary it may be in one of each direction.
    pairs: Vec<u8>,
}

impl Cancellations {
    /// Pairs of persistence above `limit` are left out, and all of them where it is 0.
    pub(super) fn new(
        mesh: &TriMesh,
        order: VertexOrder<'_>,
        limit: f64,
        watch: &Watch<'_>,
    ) -> Result<Self, FieldError> {
        let mut plan = watch.plan(&STEPS);
        plan.begin(20 * mesh.edge_count() as u64)?;
        let steepest = Steepest::by_slope(mesh, order, watch)?;
        plan.begin(8 * mesh.triangle_count() as u64 + 40 * mesh.vertex_count() as u64)?;
        let simple_saddles = SimpleSaddles::new(mesh, order, watch)?;
        plan.begin(if limit > 0.0 { 20 * mesh.vertex_count() as u64 } else { 0 })?;
        let ends = if limit > 0.0 {
            [ends(&steepest.down, watch)?, ends(&steepest.up, watch)?]
        } else {
            [Vec::new(), Vec::new()]
        };
        plan.begin(if limit > 0.0 { 400 * simple_saddles.len() as u64 } else { 0 })?;
        let (mut found, mut pairs) = (Vec::new(), filled(0_u8, simple_saddles.len())?);
        for upwards in [false, true].into_iter().filter(|_| limit > 0.0) {
            let sweep = if upwards { Sweep::downwards(order) } else { Sweep::upwards(order) };
            let mut merging = Merging::new(sweep, copied(&ends[usize::from(upwards)])?);
            let paths = if upwards { &simple_saddles.up } else { &simple_saddles.down };
            for range in ranges(simple_saddles.len(), 100, watch) {
                for i in range? {
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
                        let (into, here, beyond) = (NONE, a, b);
                        push(&mut found, Cancellation { extremum, simple, upwards, persistence, into, here, beyond })?;
                    }
                }
            }
        }
        // Among equals the one that a sweep met first comes first: what it joined has to be one already.
        let mut sorted = numbers(found.len())?;
        sort_by_key(&mut sorted, &|i| ascending_bits(found[i as usize].persistence), watch)?;
        let list = collected(found.len(), sorted.iter().map(|&i| found[i as usize]))?;
        drop(found);
        let mut this = Self { steepest, simple_saddles, ends, list, pairs };
        this.find_successors(watch)?;
        plan.finish()?;
        Ok(this)
    }

    /// In order of persistence, the arcs of a cancelled extremum go over to the one on the other side of its saddle.
    fn find_successors(&mut self, watch: &Watch<'_>) -> Result<(), FieldError> {
        let [down, up] = &self.ends;
        let mut joined = [UnionFind::new(copied(down)?), UnionFind::new(copied(up)?)];
        for range in ranges(self.list.len(), 60, watch) {
            for cancellation in &mut self.list[range?] {
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
        Ok(())
    }

    /// The paths down and up once all of the list up to a threshold is cancelled.
    pub(super) fn paths(&self, threshold: f64, watch: &Watch<'_>) -> Result<[Paths<'_>; 2], FieldError> {
        let (mut down, mut up) = (Vec::new(), Vec::new());
        for piece in pieces(self.up_to(threshold), 10, watch) {
            for c in piece? {
                let crossings = if c.upwards { &mut up } else { &mut down };
                push(crossings, Crossing { simple: c.simple, extremum: c.extremum, sides: [c.here, c.beyond] })?;
            }
        }
        let saddles = &self.simple_saddles.vertices;
        Ok([
            Paths::new(&self.steepest.down, &self.ends[0], saddles, &down, watch)?,
            Paths::new(&self.steepest.up, &self.ends[1], saddles, &up, watch)?,
        ])
    }

    /// For every vertex that is an extremum, down and up, the one that has taken its place at a threshold.
    pub(super) fn extrema(&self, threshold: f64, watch: &Watch<'_>) -> Result<[Vec<u32>; 2], FieldError> {
        let mut extrema = [numbers(self.ends[0].len())?, numbers(self.ends[0].len())?];
        let cancelled = self.up_to(threshold);
        // The one that takes over is cancelled later, if at all.
        watch.tick(10 * cancelled.len() as u64)?;
        for cancellation in cancelled.iter().rev() {
            let extrema = &mut extrema[usize::from(cancellation.upwards)];
            extrema[cancellation.extremum as usize] = extrema[cancellation.into as usize];
        }
        Ok(extrema)
    }

    /// The simple saddles that are left at a threshold: one that is in two pairs goes with the second.
    pub(super) fn alive(&self, threshold: f64) -> Result<Vec<bool>, FieldError> {
        let mut pairs = copied(&self.pairs)?;
        let mut alive = filled(true, self.simple_saddles.len())?;
        for cancellation in self.up_to(threshold) {
            let left = &mut pairs[cancellation.simple as usize];
            *left -= 1;
            alive[cancellation.simple as usize] = *left > 0;
        }
        Ok(alive)
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
