//! Components of growing sublevel or superlevel sets, by union and find.

use super::saddles::Saddles;
use super::sweep::Sweep;
use crate::error::FieldError;
use crate::support::pieces::ranges;
use crate::support::union_find::UnionFind;
use crate::support::watch::Watch;

/// The components of what a sweep has met, each named by the extremum that it began with.
///
/// Only saddles have to be visited, in the order of the sweep, and not all vertices: between saddles, components grow, and a
/// steepest path stays within its component, so that a neighbour's component is that of the extremum it leads to.
#[derive(Debug)]
pub(super) struct Merging<'a> {
    sweep: Sweep<'a>,
    /// At first the steepest paths; later, extrema lead on to those that their components joined.
    components: UnionFind,
}

/// Two components became one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Merged {
    /// The extremum that was met later: its component ends.
    pub(super) ended: u32,
    /// The extremum that now names both.
    pub(super) survivor: u32,
}

impl<'a> Merging<'a> {
    /// `steepest` has the neighbour that every vertex leads to, against the direction of the sweep.
    pub(super) fn new(sweep: Sweep<'a>, steepest: Vec<u32>) -> Self {
        Self { sweep, components: UnionFind::new(steepest) }
    }

    /// The extremum that the component of `v` began with.
    pub(super) fn find(&mut self, v: u32) -> u32 {
        self.components.find(v)
    }

    /// Joins the components of `a` and `b`; `None` if they are one already.
    pub(super) fn join(&mut self, a: u32, b: u32) -> Option<Merged> {
        let (a, b) = (self.find(a), self.find(b));
        if a == b {
            return None;
        }
        let (survivor, ended) = if self.sweep.precedes(a, b) { (a, b) } else { (b, a) };
        self.components.link(ended, survivor);
        Some(Merged { ended, survivor })
    }

    /// Visits the saddles in the order of the sweep, but for blocked ones, and tells for each merger the index of its saddle.
    ///
    /// # Errors
    /// `Cancelled`, and those of `tell`.
    pub(super) fn visit(
        &mut self,
        saddles: &Saddles,
        ascending: &[u32],
        is_blocked: &dyn Fn(u32) -> bool,
        watch: &Watch<'_>,
        mut tell: impl FnMut(u32, Merged) -> Result<(), FieldError>,
    ) -> Result<(), FieldError> {
        let downwards = self.sweep.is_downwards();
        for range in ranges(ascending.len(), 100, watch) {
            for i in range? {
                let index = ascending[if downwards { ascending.len() - 1 - i } else { i }];
                let saddle = saddles.get(index);
                if is_blocked(saddle.vertex) {
                    continue;
                }
                let sides = if downwards { saddle.upper } else { saddle.lower };
                for k in 1..sides.len() {
                    if let Some(merged) = self.join(sides[0], sides[k]) {
                        tell(index, merged)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether nothing took over the component that began with `v`.
    pub(super) fn is_root(&self, v: u32) -> bool {
        self.components.is_name(v)
    }
}
