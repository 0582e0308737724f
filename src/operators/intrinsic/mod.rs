//! The cotangent Laplacian of the intrinsic Delaunay triangulation.

mod lengths;
mod triangulation;

use nalgebra_sparse::CscMatrix;

use self::triangulation::Triangulation;
use super::SUMMED;
use super::{from_symmetric, symmetric_bytes};
use crate::error::MeshError;
use crate::mesh::TriMesh;
use crate::support::memory;
use crate::support::watch::Watch;

/// The cotangent Laplacian of the intrinsic Delaunay triangulation.
///
/// # Definition
/// The surface, with the lengths measured on it, is triangulated anew on the same vertices: edges between two triangles are
/// flipped within the surface until the two angles opposite to each add up to π at most. The weights w_ij = Σ ½ cot α are
/// summed over all edges of that triangulation from i to j, of which there may be several; edges from a vertex to itself
/// contribute nothing (\[Bobenko07, definition 16\]). Edges on the boundary, and those where more than two triangles meet,
/// stay as they are.
///
/// Lengths are those of the mesh, to the last bit, and areas those of its triangles, however thin: nothing is added to lengths so
/// that triangles keep away from degeneracy, as \[Sharp20\] does. Only a triangle that has no area when all flips are done gets one
/// of 1e-5 times the square of its longest side. Where all vertices coincide, all triangles are equilateral.
///
/// # Properties
/// n × n, symmetric, positive semi-definite; constants are in its kernel. Weights are not negative, but for edges of the mesh
/// on its boundary or with more than two triangles, which may be. Where all triangles have an area, fᵀLf is not larger than
/// with the cotangent Laplacian whatever f is \[Rippa90\], and L is the same for all triangulations of one flat region.
/// Besides the edges of the new triangulation all those of the mesh are stored, with zeros where they are flipped. Rows and
/// columns of isolated vertices are zero.
///
/// Flips end after a thousand per edge. Usual meshes take a few; a fan of tens of thousands of triangles around one vertex
/// of a curved outline takes seconds, and if flips ran out, the negative weights left would show.
///
/// # Units
/// None: scaling the mesh does not change it.
///
/// # Errors
/// `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::{mesh::TriMesh, operators::intrinsic_delaunay_laplacian};
/// // A flat rhombus, cut along its longer diagonal (0, 2).
/// let positions = vec![-2., 0., 0., 0., -1., 0., 2., 0., 0., 0., 1., 0.];
/// let laplacian = intrinsic_delaunay_laplacian(&TriMesh::new(positions, vec![0, 1, 2, 0, 2, 3])?)?;
/// let weight = |i, j| laplacian.get_entry(i, j).map_or(0.0, |entry| -entry.into_value());
/// // The shorter diagonal takes its place. Each opposite angle has the tangent 4/3.
/// assert_eq!(weight(0, 2), 0.0);
/// assert!((weight(1, 3) - 0.75).abs() < 1e-15);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn intrinsic_delaunay_laplacian(mesh: &TriMesh) -> Result<CscMatrix<f64>, MeshError> {
    laplacian(mesh, &Watch::none())
}

pub(super) fn laplacian(mesh: &TriMesh, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    let before = mesh.connectivity().edges();
    memory::ensure(Triangulation::bytes(before.len(), mesh.triangle_count()))?;
    watch.tick(3 * SUMMED * before.len() as u64)?;
    let measured = lengths::measured(mesh);
    let mut triangulation = Triangulation::new(mesh.connectivity(), measured, watch)?;
    triangulation.make_delaunay(watch)?;
    let mut weights = triangulation.weights(watch)?;

    let new_ends =
        |edge: u32| triangulation.ends(edge).filter(|&ends| ends != before[edge as usize] && ends[0] != ends[1]);
    let moved_count = (0..before.len() as u32).filter_map(new_ends).count();
    let most_edges = before.len() + moved_count;
    memory::ensure((size_of::<Moved>() * moved_count) as u64)?;
    let mut moved = Vec::with_capacity(moved_count);
    watch.tick(2 * SUMMED * before.len() as u64)?;
    for edge in 0..before.len() as u32 {
        if let Some(ends) = triangulation.ends(edge)
            && ends != before[edge as usize]
        {
            let weight = core::mem::take(&mut weights[edge as usize]);
            if ends[0] != ends[1] {
                moved.push(Moved { ends, edge, weight });
            }
        }
    }
    drop(triangulation);
    memory::ensure(16 * most_edges as u64 + symmetric_bytes(mesh.vertex_count(), most_edges))?;
    watch.tick(5 * SUMMED * moved_count as u64)?;
    // The id settles the order of edges with the same ends, and with it the rounding of their sum.
    moved.sort_unstable_by_key(|moved| (moved.ends, moved.edge));

    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(most_edges);
    let mut sums: Vec<f64> = Vec::with_capacity(most_edges);
    let mut add = |ends: [u32; 2], weight: f64| match (edges.last(), sums.last_mut()) {
        (Some(last), Some(sum)) if *last == ends => *sum += weight,
        _ => {
            edges.push(ends);
            sums.push(weight);
        }
    };
    watch.tick(SUMMED * most_edges as u64)?;
    let mut rest = moved.iter().peekable();
    for (&ends, &weight) in before.iter().zip(&weights) {
        while let Some(next) = rest.next_if(|next| next.ends < ends) {
            add(next.ends, next.weight);
        }
        add(ends, weight);
    }
    for next in rest {
        add(next.ends, next.weight);
    }
    Ok(from_symmetric(mesh.vertex_count(), &edges, &sums, watch)?)
}

/// An edge with other ends than in the mesh.
struct Moved {
    ends: [u32; 2],
    edge: u32,
    weight: f64,
}
