//! Saddles at which a loop begins that never bounds.

use super::annotations;
use crate::error::FieldError;
use crate::field::arrays::{collected, push, with_room};
use crate::field::order::VertexOrder;
use crate::field::saddles::Saddles;
use crate::mesh::{Connectivity, LinkKind, TriMesh};
use crate::support::pieces::ranges;
use crate::support::union_find::UnionFind;
use crate::support::watch::Watch;

/// The vertices of the essential classes of dimension one of the sublevel sets, by ascending (value, id). `mergers` has for
/// every saddle how many components merge there in the sweeps up and down, and `steepest_up` the highest neighbours.
pub(super) fn essential_saddles(
    mesh: &TriMesh,
    order: VertexOrder<'_>,
    saddles: &Saddles,
    ascending: &[u32],
    mergers: &[[u32; 2]],
    steepest_up: &[u32],
    watch: &Watch<'_>,
) -> Result<Vec<u32>, FieldError> {
    let connectivity = mesh.connectivity();
    if connectivity.link_kinds().contains(&LinkKind::NonManifold) {
        return annotations::essential_saddles(connectivity, order, watch);
    }
    // On a surface, l components of the lower link are l − 1 handles: each joins components of the sublevel set, or begins a
    // loop. By duality a loop comes to bound where components of the superlevel set join.
    watch.tick(10 * saddles.len() as u64)?;
    let first = |i: u32| saddles.get(i).lower_components.saturating_sub(1) - mergers[i as usize][0];
    let mut loops = collected(saddles.len(), (0..saddles.len() as u32).map(first))?;
    if connectivity.special_vertices().is_empty() {
        for (loops, mergers) in loops.iter_mut().zip(mergers) {
            *loops -= mergers[1].min(*loops);
        }
    } else {
        bound_from_beyond(connectivity, saddles, ascending, steepest_up, &mut loops, watch)?;
    }
    let mut essential = Vec::new();
    for &i in ascending {
        for _ in 0..loops[i as usize] {
            push(&mut essential, saddles.get(i).vertex)?;
        }
    }
    Ok(essential)
}

/// Takes away the loops that come to bound on a surface with boundary, where a vertex above everything, next to the whole
/// boundary, takes the place of what lies beyond it.
fn bound_from_beyond(
    connectivity: &Connectivity,
    saddles: &Saddles,
    ascending: &[u32],
    steepest_up: &[u32],
    loops: &mut [u32],
    watch: &Watch<'_>,
) -> Result<(), FieldError> {
    let beyond = connectivity.vertex_count() as u32;
    let mut up = with_room(steepest_up.len() + 1)?;
    up.extend_from_slice(steepest_up);
    up.push(beyond);
    for &v in connectivity.special_vertices() {
        up[v as usize] = beyond;
    }
    let mut above = UnionFind::new(up);
    for range in ranges(ascending.len(), 100, watch) {
        for i in range? {
            let i = ascending[ascending.len() - 1 - i];
            let saddle = saddles.get(i);
            let on_boundary = connectivity.link_kinds()[saddle.vertex as usize] == LinkKind::Path;
            let hub = if on_boundary { beyond } else { saddle.upper[0] };
            for &first in saddle.upper {
                if above.unite(hub, first) {
                    loops[i as usize] = loops[i as usize].saturating_sub(1);
                }
            }
        }
    }
    Ok(())
}
