//! An order of the vertices that has exactly the chosen extrema, and else is that of a field, as far as it can be.
//!
//! Water rises from the chosen minima: a vertex is reached from the lowest ones that are wet, as in a priority flood \[Barnes14\]. Where it
//! runs over into a basin without a chosen minimum it first goes down to the ground, by the lowest vertices, and then fills the basin by
//! ascending values: the basin keeps its shape, but for the way by which it is reached. Then all is turned upside down, for hills
//! without a chosen maximum, and again, until nothing changes.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::extrema::Chosen;
use crate::error::{Cancelled, Result};
use crate::field::sort_by_value;
use crate::mesh::{Connectivity, LinkKind};
use crate::support::memory;
use crate::support::watch::Watch;

/// Rounds after which an order that has other extrema still is given up.
const MOST_ROUNDS: usize = 24;
/// The work with a vertex that is flooded.
const FLOODED: u64 = 250;

/// The vertices in an order with exactly these extrema; nothing where that was not found.
///
/// # Errors
/// `Cancelled`, `OutOfMemory`.
pub(super) fn ranking(
    connectivity: &Connectivity,
    ascending: Vec<u32>,
    extrema: &Chosen,
    watch: &Watch<'_>,
) -> Result<Option<Vec<u32>>> {
    let n = connectivity.vertex_count();
    memory::ensure(40 * n as u64)?;
    let mut order = ascending;
    for round in 0..MOST_ROUNDS {
        let (sources, others) =
            if round % 2 == 0 { (&extrema.minima, &extrema.maxima) } else { (&extrema.maxima, &extrema.minima) };
        let Some(flooded) = flooded(connectivity, &order, sources, watch)? else { return Ok(None) };
        order = flooded;
        order.reverse();
        // What was flooded has no other extrema of the one kind; those of the other kind are first in the reversed order.
        if firsts(connectivity, &order) == *others {
            if round % 2 == 0 {
                order.reverse();
            }
            return Ok(Some(order));
        }
    }
    Ok(None)
}

/// The vertices without neighbours before them, ascending.
fn firsts(connectivity: &Connectivity, order: &[u32]) -> Vec<u32> {
    let rank = ranks(order, connectivity.vertex_count());
    let is_first = |&v: &u32| around(connectivity, v).all(|w| rank[w as usize] > rank[v as usize]);
    let mut firsts: Vec<u32> = order.iter().copied().filter(is_first).collect();
    firsts.sort_unstable();
    firsts
}

/// For every vertex its place in an order.
fn ranks(order: &[u32], vertices: usize) -> Vec<u32> {
    let mut ranks = vec![u32::MAX; vertices];
    for (rank, &v) in (0..).zip(order) {
        ranks[v as usize] = rank;
    }
    ranks
}

/// The vertices in the order in which water from the sources reaches them; nothing where it does not reach all.
fn flooded(
    connectivity: &Connectivity,
    order: &[u32],
    sources: &[u32],
    watch: &Watch<'_>,
) -> Result<Option<Vec<u32>>, Cancelled> {
    let rank = ranks(order, connectivity.vertex_count());
    let mut is_known = vec![false; connectivity.vertex_count()];
    let mut shore = BinaryHeap::new();
    for &v in sources {
        is_known[v as usize] = true;
        shore.push(Reverse((rank[v as usize], rank[v as usize])));
    }
    let mut reached = Vec::with_capacity(order.len());
    while let Some(Reverse((level, own))) = shore.pop() {
        watch.tick(FLOODED)?;
        let v = order[own as usize];
        reached.push(v);
        for w in around(connectivity, v) {
            if !core::mem::replace(&mut is_known[w as usize], true) {
                let rank = rank[w as usize];
                shore.push(Reverse((level.max(rank), rank)));
            }
        }
    }
    Ok((reached.len() == order.len()).then_some(reached))
}

/// The vertices of triangles by ascending (value, id).
///
/// # Errors
/// `Cancelled`, `OutOfMemory`.
pub(super) fn ascending(connectivity: &Connectivity, values: &[f64], watch: &Watch<'_>) -> Result<Vec<u32>> {
    let kinds = connectivity.link_kinds();
    let mut order: Vec<u32> = (0..values.len() as u32).filter(|&v| kinds[v as usize] != LinkKind::Isolated).collect();
    sort_by_value(&mut order, values, watch)?;
    Ok(order)
}

/// The neighbours of a vertex, some of them several times.
pub(super) fn around(connectivity: &Connectivity, vertex: u32) -> impl Iterator<Item = u32> {
    connectivity.link(vertex).flatten()
}
