//! Saddles taken apart into simple ones.

use super::NONE;
use crate::error::FieldError;
use crate::field::arrays::{collected, push, with_room};
use crate::field::order::VertexOrder;
use crate::field::saddles::Saddles;
use crate::mesh::{LinkKind, TriMesh};
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// Simple saddles, each with at most two steepest paths down and two up, given by their first vertices; [`NONE`] where there
/// is none. Those of one vertex are neighbours, and vertices ascend.
///
/// A saddle of multiplicity k on a surface has k + 1 paths down and as many up, in turn around it. It becomes k simple ones as
/// a small perturbation would have it: the first path down goes to each of the others, and such a pair separates two
/// neighbouring paths up, so that every pair down crosses one pair up and no other.
#[derive(Debug, Default)]
pub(super) struct SimpleSaddles {
    pub(super) vertices: Vec<u32>,
    pub(super) down: Vec<[u32; 2]>,
    pub(super) up: Vec<[u32; 2]>,
    /// The saddles by ascending (value, id), those of one vertex in their order.
    pub(super) ascending: Vec<u32>,
}

impl SimpleSaddles {
    pub(super) fn new(mesh: &TriMesh, order: VertexOrder<'_>, watch: &Watch<'_>) -> Result<Self, FieldError> {
        let saddles = Saddles::steepest(mesh, order, watch)?;
        let mut this = Self::default();
        let mut starts = with_room(saddles.len() + 1)?;
        for range in ranges(saddles.len(), 20, watch) {
            for i in range? {
                let i = i as u32;
                starts.push(this.vertices.len() as u32);
                let saddle = saddles.get(i);
                let around = mesh.connectivity().link_kinds()[saddle.vertex as usize] == LinkKind::Cycle;
                let first = |paths: &[u32], k: usize| paths.get(k).copied().unwrap_or(NONE);
                for k in 1..saddle.lower.len().max(saddle.upper.len()) {
                    let hub = if around { k - 1 } else { 0 };
                    push(&mut this.vertices, saddle.vertex)?;
                    push(&mut this.down, [first(saddle.lower, 0), first(saddle.lower, k)])?;
                    push(&mut this.up, [first(saddle.upper, hub), first(saddle.upper, k)])?;
                }
            }
        }
        starts.push(this.vertices.len() as u32);
        let ascending = saddles.ascending(order.values(), watch)?;
        let of_vertex = |&i: &u32| starts[i as usize]..starts[i as usize + 1];
        this.ascending = collected(this.len(), ascending.iter().flat_map(of_vertex))?;
        Ok(this)
    }

    pub(super) fn len(&self) -> usize {
        self.vertices.len()
    }
}
