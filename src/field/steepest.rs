//! Steepest paths along edges: where each vertex leads to, upwards and downwards.

use super::arrays::{filled, numbers, push};
use super::order::VertexOrder;
use crate::error::{FieldError, OutOfMemory};
use crate::mesh::{Connectivity, TriMesh, difference, norm};
use crate::support::pieces::{pieces, ranges};
use crate::support::watch::Watch;

/// The work with one edge.
const BY_VALUE: u64 = 8;
const BY_SLOPE: u64 = 20;
/// The work with one entry of a forest.
const ENDS: u64 = 10;

/// For every vertex the neighbours that steepest paths go on to; itself where a path ends.
#[derive(Debug, Clone)]
pub(super) struct Steepest {
    pub(super) down: Vec<u32>,
    pub(super) up: Vec<u32>,
}

impl Steepest {
    /// To the lowest and to the highest neighbour: where paths end is all that matters to components.
    #[inline(never)]
    pub(super) fn by_value(
        connectivity: &Connectivity,
        order: VertexOrder<'_>,
        watch: &Watch<'_>,
    ) -> Result<Self, FieldError> {
        let mut this = Self::nowhere(connectivity.vertex_count())?;
        for piece in pieces(connectivity.edges(), BY_VALUE, watch) {
            for &[a, b] in piece? {
                let (low, high) = if order.is_below(a, b) { (a, b) } else { (b, a) };
                let (down, up) = (&mut this.down[high as usize], &mut this.up[low as usize]);
                if order.is_below(low, *down) {
                    *down = low;
                }
                if order.is_below(*up, high) {
                    *up = high;
                }
            }
        }
        Ok(this)
    }

    /// Along the steepest edge, as near to the gradient as edges come. Of equally steep edges the one that leads farther in
    /// the order is taken.
    #[inline(never)]
    pub(super) fn by_slope(mesh: &TriMesh, order: VertexOrder<'_>, watch: &Watch<'_>) -> Result<Self, FieldError> {
        let mut this = Self::nowhere(mesh.vertex_count())?;
        // Below every slope, so that the first neighbour is taken.
        let mut down_slopes = filled(-1.0, mesh.vertex_count())?;
        let mut up_slopes = filled(-1.0, mesh.vertex_count())?;
        for piece in pieces(mesh.connectivity().edges(), BY_SLOPE, watch) {
            for &[a, b] in piece? {
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
        }
        Ok(this)
    }

    fn nowhere(vertices: usize) -> Result<Self, OutOfMemory> {
        Ok(Self { down: numbers(vertices)?, up: numbers(vertices)? })
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
pub(super) fn ends(steepest: &[u32], watch: &Watch<'_>) -> Result<Vec<u32>, FieldError> {
    const UNKNOWN: u32 = u32::MAX;
    let mut ends = filled(UNKNOWN, steepest.len())?;
    let mut path = Vec::new();
    for range in ranges(steepest.len(), ENDS, watch) {
        for start in range? {
            let mut at = start as u32;
            while ends[at as usize] == UNKNOWN && steepest[at as usize] != at {
                push(&mut path, at)?;
                at = steepest[at as usize];
            }
            let end = if ends[at as usize] == UNKNOWN { at } else { ends[at as usize] };
            ends[at as usize] = end;
            for &v in &path {
                ends[v as usize] = end;
            }
            path.clear();
        }
    }
    Ok(ends)
}
