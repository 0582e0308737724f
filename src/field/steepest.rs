//! Steepest paths along edges: where each vertex leads to, upwards and downwards.

use super::order::VertexOrder;
use crate::mesh::{Connectivity, TriMesh, difference, norm};

/// For every vertex the neighbours that steepest paths go on to; itself where a path ends.
#[derive(Debug, Clone)]
pub(super) struct Steepest {
    pub(super) down: Vec<u32>,
    pub(super) up: Vec<u32>,
}

impl Steepest {
    /// To the lowest and to the highest neighbour: where paths end is all that matters to components.
    #[inline(never)]
    pub(super) fn by_value(connectivity: &Connectivity, order: VertexOrder<'_>) -> Self {
        let mut this = Self::nowhere(connectivity.vertex_count());
        for &[a, b] in connectivity.edges() {
            let (low, high) = if order.is_below(a, b) { (a, b) } else { (b, a) };
            let (down, up) = (&mut this.down[high as usize], &mut this.up[low as usize]);
            if order.is_below(low, *down) {
                *down = low;
            }
            if order.is_below(*up, high) {
                *up = high;
            }
        }
        this
    }

    /// Along the steepest edge, as near to the gradient as edges come. Of equally steep edges the one that leads farther in
    /// the order is taken.
    #[inline(never)]
    pub(super) fn by_slope(mesh: &TriMesh, order: VertexOrder<'_>) -> Self {
        let mut this = Self::nowhere(mesh.vertex_count());
        // Below every slope, so that the first neighbour is taken.
        let mut down_slopes = vec![-1.0; mesh.vertex_count()];
        let mut up_slopes = down_slopes.clone();
        for &[a, b] in mesh.connectivity().edges() {
            let (low, high) = if order.is_below(a, b) { (a, b) } else { (b, a) };
            let slope = slope(mesh, order, low, high);
            let (down, best) = (&mut this.down[high as usize], &mut down_slopes[high as usize]);
            if slope > *best || (slope == *best && order.is_below(low, *down)) {
                (*down, *best) = (low, slope);
            }
            let (up, best) = (&mut this.up[low as usize], &mut up_slopes[low as usize]);
            if slope > *best || (slope == *best && order.is_below(*up, high)) {
                (*up, *best) = (high, slope);
            }
        }
        this
    }

    fn nowhere(vertices: usize) -> Self {
        let itself: Vec<u32> = (0..vertices as u32).collect();
        Self { down: itself.clone(), up: itself }
    }
}

/// |f_a − f_b| over the distance of a and b.
#[inline(always)]
fn slope(mesh: &TriMesh, order: VertexOrder<'_>, a: u32, b: u32) -> f64 {
    let drop = (order.values()[a as usize] - order.values()[b as usize]).abs();
    let length = norm(difference(mesh.position(a), mesh.position(b)));
    if length > 0.0 {
        drop / length
    } else if drop > 0.0 {
        // Two vertices in one place.
        f64::INFINITY
    } else {
        0.0
    }
}

/// The steepest of several neighbours of `v` on the same side of it, as in [`Steepest::by_slope`].
pub(super) fn steepest_of(mesh: &TriMesh, order: VertexOrder<'_>, v: u32, neighbours: &[u32]) -> u32 {
    let mut best = neighbours[0];
    if neighbours.len() == 1 {
        return best;
    }
    let mut best_slope = slope(mesh, order, v, best);
    for &j in &neighbours[1..] {
        let slope = slope(mesh, order, v, j);
        let is_farther = order.is_below(j, best) == order.is_below(j, v);
        if slope > best_slope || (slope == best_slope && is_farther) {
            (best, best_slope) = (j, slope);
        }
    }
    best
}

/// For every entry of a forest, each leading to another one or to itself, where its path ends: for every vertex, the extremum of
/// steepest paths.
#[inline(never)]
pub(super) fn ends(steepest: &[u32]) -> Vec<u32> {
    const UNKNOWN: u32 = u32::MAX;
    let mut ends = vec![UNKNOWN; steepest.len()];
    let mut path = Vec::new();
    for start in 0..steepest.len() as u32 {
        let mut at = start;
        while ends[at as usize] == UNKNOWN && steepest[at as usize] != at {
            path.push(at);
            at = steepest[at as usize];
        }
        let end = if ends[at as usize] == UNKNOWN { at } else { ends[at as usize] };
        ends[at as usize] = end;
        for &v in &path {
            ends[v as usize] = end;
        }
        path.clear();
    }
    ends
}
