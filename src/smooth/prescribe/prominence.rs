//! Steps that keep chosen extrema prominent.
//!
//! A minimum is as prominent as the lowest way out of its basin is high above it. Its basin here are the vertices that water reaches from
//! it, in the order of the representative, before it meets that of another minimum. All vertices around the basin are to be as high
//! above the minimum as is wished for: along the way by which each is reached, the rises add up to it. They are shared out as the
//! smooth field rises, where it does, and else evenly. Maxima are minima upside down.

use super::ranking::{around, ascending};
use super::steps::Step;
use crate::error::Result;
use crate::field::VertexOrder;
use crate::mesh::Connectivity;
use crate::support::memory;
use crate::support::union_find::UnionFind;
use crate::support::watch::Watch;

const NONE: u32 = u32::MAX;

/// What steps may lack of their margin, so much more is asked for.
const SPARE: f64 = 0.2;

/// The work with a vertex whose basin is found, or whose rise is shared out.
const BASINS: u64 = 150;

/// What is wished for.
pub(super) struct Wish<'a> {
    /// Relative to the range of the input.
    pub(super) prominence: f64,
    pub(super) margin: f64,
    /// The normalised smooth field.
    pub(super) smooth: &'a [f64],
    /// Extrema that were not chosen, ascending: they need not be prominent.
    pub(super) unavoidable: &'a [u32],
}

/// Asks for larger steps, and more of them, so that every chosen extremum is as prominent as is wished for.
pub(super) fn raise(
    steps: &mut Vec<Step>,
    connectivity: &Connectivity,
    order: VertexOrder<'_>,
    wish: &Wish<'_>,
    watch: &Watch<'_>,
) -> Result<()> {
    let n = connectivity.vertex_count();
    memory::ensure(64 * n as u64)?;
    let mut larger = Vec::new();
    for is_upward in [true, false] {
        watch.tick(BASINS * n as u64)?;
        let basins = Basins::new(connectivity, order, is_upward, watch)?;
        watch.tick(BASINS * n as u64)?;
        for (from, to, least) in basins.rises(connectivity, wish) {
            let (from, to) = if is_upward { (from, to) } else { (to, from) };
            larger.push(Step { from, to, least });
        }
    }
    steps.extend(larger);
    steps.sort_unstable_by(|a, b| (a.from, a.to).cmp(&(b.from, b.to)).then(b.least.total_cmp(&a.least)));
    steps.dedup_by_key(|step| (step.from, step.to));
    Ok(())
}

/// The basins of the minima of an order.
struct Basins {
    is_upward: bool,
    /// The vertices from bottom to top.
    ascending: Vec<u32>,
    /// The lowest neighbour; none for minima.
    parent: Vec<u32>,
    /// The minimum of the basin that a vertex belongs to.
    owner: Vec<u32>,
}

impl Basins {
    fn new(connectivity: &Connectivity, order: VertexOrder<'_>, is_upward: bool, watch: &Watch<'_>) -> Result<Self> {
        let n = connectivity.vertex_count();
        let mut ascending = ascending(connectivity, order.values(), watch)?;
        if !is_upward {
            ascending.reverse();
        }
        let mut rank = vec![NONE; n];
        for (place, &v) in (0..).zip(&ascending) {
            rank[v as usize] = place;
        }
        let mut parent = vec![NONE; n];
        // Sets of vertices that hang together below the one at hand; each knows its minimum until it meets another set.
        let mut sets = UnionFind::singletons(n);
        let mut alone = vec![NONE; n];
        // The rank of the vertex at which the basin of a minimum meets another one.
        let mut end = vec![NONE; n];
        for &v in &ascending {
            let lower = || around(connectivity, v).filter(|&w| rank[w as usize] < rank[v as usize]);
            let Some(lowest) = lower().min_by_key(|&w| rank[w as usize]) else {
                alone[v as usize] = v;
                continue;
            };
            parent[v as usize] = lowest;
            let first = sets.find(lowest);
            let mut meets = false;
            for w in lower() {
                let name = sets.find(w);
                if name != sets.find(first) {
                    for side in [name, sets.find(first)] {
                        let minimum = core::mem::replace(&mut alone[side as usize], NONE);
                        if minimum != NONE {
                            end[minimum as usize] = rank[v as usize];
                        }
                    }
                    sets.unite(name, first);
                    meets = true;
                }
            }
            let name = sets.find(first);
            let minimum = alone[name as usize];
            sets.unite(v, name);
            let name = sets.find(v);
            alone[name as usize] = if meets { NONE } else { minimum };
        }
        let mut owner = vec![NONE; n];
        for &v in &ascending {
            let minimum = match parent[v as usize] {
                NONE => v,
                parent => owner[parent as usize],
            };
            // A basin that never meets another one has nothing to be prominent above.
            let is_inside =
                minimum != NONE && end[minimum as usize] != NONE && rank[v as usize] < end[minimum as usize];
            owner[v as usize] = if is_inside { minimum } else { NONE };
        }
        Ok(Self { is_upward, ascending, parent, owner })
    }

    /// Rises between neighbours: from, to, and how much.
    fn rises(&self, connectivity: &Connectivity, wish: &Wish<'_>) -> Vec<(u32, u32, f64)> {
        let Wish { prominence, margin, smooth, unavoidable } = *wish;
        let n = connectivity.vertex_count();
        let height = |v: u32| if self.is_upward { smooth[v as usize] } else { -smooth[v as usize] };
        // How many steps lead to a vertex of a basin, and how high the smooth field comes on the way above the minimum.
        let (mut depth, mut crest) = (vec![0_u32; n], vec![0.0_f64; n]);
        for &v in &self.ascending {
            let (minimum, parent) = (self.owner[v as usize], self.parent[v as usize]);
            if minimum != NONE && parent != NONE {
                depth[v as usize] = depth[parent as usize] + 1;
                crest[v as usize] = crest[parent as usize].max(height(v) - height(minimum));
            }
        }
        // The vertices around basins, each with the vertex inside by which it is reached.
        let mut shores: Vec<(u32, u32, u32)> = Vec::new();
        for &[a, b] in connectivity.edges() {
            for (inside, outside) in [(a, b), (b, a)] {
                let minimum = self.owner[inside as usize];
                if minimum != NONE
                    && minimum != self.owner[outside as usize]
                    && unavoidable.binary_search(&minimum).is_err()
                {
                    shores.push((minimum, outside, inside));
                }
            }
        }
        shores.sort_unstable_by(|a, b| {
            (a.0, a.1).cmp(&(b.0, b.1)).then(crest[b.2 as usize].total_cmp(&crest[a.2 as usize])).then(a.2.cmp(&b.2))
        });
        shores.dedup_by_key(|shore| (shore.0, shore.1));
        let mut rises = Vec::new();
        let mut is_done = vec![false; n];
        for basin in shores.chunk_by(|a, b| a.0 == b.0) {
            let minimum = basin[0].0;
            let deepest = basin.iter().map(|shore| depth[shore.2 as usize]).max().unwrap_or(0) + 1;
            let rim =
                |&(_, outside, inside): &(u32, u32, u32)| crest[inside as usize].max(height(outside) - height(minimum));
            let natural = basin.iter().map(rim).fold(f64::INFINITY, f64::min);
            let wanted = prominence + SPARE * margin * f64::from(deepest);
            let trust = (natural / wanted).clamp(0.0, 1.0);
            // What of the wished-for rise is done at a vertex of the basin.
            let done = |v: u32| {
                let by_field = if natural > 0.0 { (crest[v as usize] / natural.min(wanted)).min(1.0) } else { 0.0 };
                let evenly = f64::from(depth[v as usize]) / f64::from(deepest);
                wanted * (trust * by_field + (1.0 - trust) * evenly)
            };
            for &(_, outside, inside) in basin {
                rises.push((inside, outside, (wanted - done(inside)).max(margin)));
                let mut v = inside;
                while v != minimum && !core::mem::replace(&mut is_done[v as usize], true) {
                    let parent = self.parent[v as usize];
                    rises.push((parent, v, (done(v) - done(parent)).max(margin)));
                    v = parent;
                }
            }
        }
        rises
    }
}
