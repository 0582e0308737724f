//! Counts of the surface's invariants.

use super::connectivity::{Connectivity, LinkKind, corner_of};
use crate::error::MeshError;
use crate::support::memory;
use crate::support::union_find::UnionFind;

/// Invariants of a mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct MeshTopology {
    /// V − E + F, isolated vertices included.
    pub euler_characteristic: i64,
    /// Connected components of the triangles; isolated vertices are counted apart.
    pub components: usize,
    /// Closed walks along edges with one triangle.
    pub boundary_loops: usize,
    /// No edge has one triangle only.
    pub closed: bool,
    /// The triangles can be turned so that any two at an edge with two triangles run through it in opposite directions.
    pub orientable: bool,
    /// Sum over components of (2 − χ − boundary loops)/2; `None` where the surface is not an orientable manifold.
    pub genus: Option<u64>,
    /// Edges with more than two triangles.
    pub non_manifold_edges: usize,
    /// Vertices whose link is neither one cycle nor one open path, ends of non-manifold edges included.
    pub non_manifold_vertices: usize,
    /// Vertices of no triangle.
    pub isolated_vertices: usize,
    /// Triangles that named a vertex twice (left out) or have zero area (kept).
    pub degenerate_triangles: usize,
}

pub(super) fn compute(connectivity: &Connectivity, degenerate_triangles: usize) -> Result<MeshTopology, MeshError> {
    let (n, m) = (connectivity.vertex_count() as u64, connectivity.triangles().len() as u64);
    let kinds = connectivity.link_kinds();
    let count = |kind| kinds.iter().filter(|&&k| k == kind).count();
    let sides = |edge: usize| connectivity.triangles_of_edge(edge as u32).len();
    let edges = connectivity.edges().len();
    let boundary_edges = (0..edges).filter(|&e| sides(e) == 1).count();
    // One after the other: components, which triangles were turned and which come next, boundary edges and their loops.
    memory::ensure((4 * n).max(5 * m).max(8 * boundary_edges as u64))?;
    let non_manifold_edges = (0..edges).filter(|&e| sides(e) > 2).count();
    let (components, orientable) = sweep(connectivity);
    let boundary_loops = boundary_loops(connectivity, boundary_edges);
    let euler_characteristic =
        connectivity.vertex_count() as i64 - edges as i64 + connectivity.triangles().len() as i64;
    let isolated_vertices = count(LinkKind::Isolated);
    let non_manifold_vertices = count(LinkKind::NonManifold);
    let surface = euler_characteristic - isolated_vertices as i64;
    let genus = (orientable && non_manifold_vertices == 0)
        .then(|| (2 * components as i64 - surface - boundary_loops as i64) as u64 / 2);
    Ok(MeshTopology {
        euler_characteristic,
        components,
        boundary_loops,
        closed: boundary_edges == 0,
        orientable,
        genus,
        non_manifold_edges,
        non_manifold_vertices,
        isolated_vertices,
        degenerate_triangles,
    })
}

/// Number of components (joined through vertices), and whether the triangles can be oriented coherently.
fn sweep(connectivity: &Connectivity) -> (usize, bool) {
    let mut vertices = UnionFind::singletons(connectivity.vertex_count());
    for &[a, b] in connectivity.edges() {
        vertices.unite(a, b);
    }
    let components = (0..connectivity.vertex_count() as u32)
        .filter(|&v| connectivity.link_kinds()[v as usize] != LinkKind::Isolated && vertices.find(v) == v)
        .count();
    drop(vertices);
    (components, orientable(connectivity))
}

fn orientable(connectivity: &Connectivity) -> bool {
    let triangles = connectivity.triangles();
    // 0: not reached, 1: as given, 2: turned.
    let mut turned = vec![0_u8; triangles.len()];
    // Every triangle comes once, when it is reached.
    let mut queue = Vec::with_capacity(triangles.len());
    for seed in 0..triangles.len() {
        if turned[seed] != 0 {
            continue;
        }
        turned[seed] = 1;
        queue.push(seed as u32);
        while let Some(t) = queue.pop() {
            for c in 0..3 {
                let edge = connectivity.triangle_edges()[t as usize][c];
                let Some(other) = connectivity.across(t, edge) else { continue };
                let start = triangles[t as usize][c];
                let there = triangles[other as usize];
                // Coherent neighbours run through the shared edge in opposite directions.
                let coherent = connectivity.triangle_edges()[other as usize][corner_of(there, start)] != edge;
                let wanted = if coherent { turned[t as usize] } else { 3 - turned[t as usize] };
                if turned[other as usize] == 0 {
                    turned[other as usize] = wanted;
                    queue.push(other);
                } else if turned[other as usize] != wanted {
                    return false;
                }
            }
        }
    }
    true
}

/// Boundary edges are joined at a vertex where they end the same path of its link, so that two sheets that only touch
/// in a vertex keep their own loops.
fn boundary_loops(connectivity: &Connectivity, count: usize) -> usize {
    let is_boundary = |edge: u32| connectivity.triangles_of_edge(edge).len() == 1;
    let mut boundary = Vec::with_capacity(count);
    boundary.extend((0..connectivity.edges().len() as u32).filter(|&e| is_boundary(e)));
    let mut loops = UnionFind::singletons(boundary.len());
    let place = |edge: u32| boundary.partition_point(|&e| e < edge) as u32;
    for (start, &edge) in boundary.iter().enumerate() {
        for &v in &connectivity.edges()[edge as usize] {
            // Walk through the fan of v from this edge to the next edge with no single triangle behind it.
            let mut t = connectivity.triangles_of_edge(edge)[0];
            let mut current = edge;
            loop {
                let c = corner_of(connectivity.triangles()[t as usize], v);
                let sides = connectivity.triangle_edges()[t as usize];
                current = if sides[c] == current { sides[(c + 2) % 3] } else { sides[c] };
                match connectivity.across(t, current) {
                    Some(next) => t = next,
                    None => break,
                }
            }
            if is_boundary(current) {
                loops.unite(start as u32, place(current));
            }
        }
    }
    (0..boundary.len() as u32).filter(|&e| loops.find(e) == e).count()
}
