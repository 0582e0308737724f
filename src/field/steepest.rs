//! Steepest paths along edges: where each vertex leads to, upwards and downwards.

use super::order::VertexOrder;
use crate::mesh::{TriMesh, difference, norm};

/// What makes one neighbour steeper than another.
#[derive(Debug, Clone, Copy)]
pub(super) enum Steepness<'a> {
    /// The difference of the values: any path will do, as long as it keeps to one side.
    Value,
    /// The difference over the length of the edge: the direction of the gradient, as near as edges come to it.
    Slope(&'a TriMesh),
}

impl Steepness<'_> {
    fn between(self, order: VertexOrder<'_>, a: u32, b: u32) -> f64 {
        let drop = (order.values()[a as usize] - order.values()[b as usize]).abs();
        match self {
            Self::Value => drop,
            Self::Slope(mesh) => {
                let length = norm(difference(mesh.position(a), mesh.position(b)));
                // Two vertices at one place: nothing is steeper, unless they have one value too.
                if length > 0.0 || drop == 0.0 { drop / length.max(f64::MIN_POSITIVE) } else { f64::INFINITY }
            }
        }
    }

    /// Whether from `v` it is steeper to `a` than to `b`, both on the same side of it. Among equals the one that lies farther
    /// along is taken, so that the answer is the same whatever order they are met in.
    pub(super) fn is_steeper(self, order: VertexOrder<'_>, v: u32, a: u32, b: u32) -> bool {
        let farther = order.is_below(a, b) == order.is_below(a, v);
        match self {
            Self::Value => farther,
            Self::Slope(_) => {
                let (to_a, to_b) = (self.between(order, v, a), self.between(order, v, b));
                to_a > to_b || (to_a == to_b && farther)
            }
        }
    }
}

/// For every vertex the neighbours that steepest paths go on to; itself where a path ends.
#[derive(Debug, Clone)]
pub(super) struct Steepest {
    pub(super) down: Vec<u32>,
    pub(super) up: Vec<u32>,
}

impl Steepest {
    /// One pass over the edges.
    #[inline(never)]
    pub(super) fn new(mesh: &TriMesh, order: VertexOrder<'_>, steepness: Steepness<'_>) -> Self {
        let n = mesh.vertex_count();
        let itself: Vec<u32> = (0..n as u32).collect();
        let mut this = Self { down: itself.clone(), up: itself };
        match steepness {
            Steepness::Value => this.follow_values(mesh, order),
            Steepness::Slope(_) => this.follow_slopes(mesh, order, steepness),
        }
        this
    }

    fn follow_values(&mut self, mesh: &TriMesh, order: VertexOrder<'_>) {
        for &[a, b] in mesh.connectivity().edges() {
            let (low, high) = if order.is_below(a, b) { (a, b) } else { (b, a) };
            let (down, up) = (&mut self.down[high as usize], &mut self.up[low as usize]);
            if order.is_below(low, *down) {
                *down = low;
            }
            if order.is_below(*up, high) {
                *up = high;
            }
        }
    }

    fn follow_slopes(&mut self, mesh: &TriMesh, order: VertexOrder<'_>, steepness: Steepness<'_>) {
        // Below every slope, so that the first neighbour is taken.
        let mut down_slopes = vec![-1.0; self.down.len()];
        let mut up_slopes = down_slopes.clone();
        for &[a, b] in mesh.connectivity().edges() {
            let (low, high) = if order.is_below(a, b) { (a, b) } else { (b, a) };
            let slope = steepness.between(order, low, high);
            let (down, best) = (&mut self.down[high as usize], &mut down_slopes[high as usize]);
            if slope > *best || (slope == *best && order.is_below(low, *down)) {
                (*down, *best) = (low, slope);
            }
            let (up, best) = (&mut self.up[low as usize], &mut up_slopes[low as usize]);
            if slope > *best || (slope == *best && order.is_below(*up, high)) {
                (*up, *best) = (high, slope);
            }
        }
    }
}
