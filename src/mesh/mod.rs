//! Triangle meshes: immutable positions over a connectivity that knows no positions.

mod connectivity;
mod geometry;
pub mod shapes;
mod submesh;
mod topology;
mod validate;
mod weld;

use std::sync::Arc;

pub use connectivity::{Connectivity, LinkKind};
pub(crate) use geometry::{cross, difference, dot, norm};
pub use submesh::Submesh;
pub use topology::MeshTopology;
pub use weld::{Welded, weld};

use crate::error::{Diagnostic, MeshError};

/// A checked, immutable triangle mesh: any simplicial complex of triangles, closed or open, manifold or not, in one or
/// several components. Cloning is cheap: the data is shared.
///
/// # Units
/// Positions are in the units of the input, areas in their square.
///
/// # Example
/// ```
/// use morse_smooth::mesh::TriMesh;
/// let mesh = TriMesh::new(vec![0., 0., 0., 1., 0., 0., 0., 1., 0.], vec![0, 1, 2])?;
/// assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.triangle_count()), (3, 3, 1));
/// assert_eq!(mesh.area(), 0.5);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct TriMesh {
    shared: Arc<Shared>,
}

#[derive(Debug)]
struct Shared {
    positions: Vec<f64>,
    connectivity: Connectivity,
    /// Zero for the triangles of [`TriMesh::is_zero_area`].
    areas: Vec<f64>,
    area: f64,
    repeated_id_triangles: usize,
    zero_area_triangles: usize,
    warnings: Vec<Diagnostic>,
}

impl TriMesh {
    /// Checks positions (x, y, z of every vertex) and triangles (three vertex ids each) and builds the connectivity.
    ///
    /// Triangles that name a vertex twice and repetitions of a triangle (in any orientation) are left out, zero-area
    /// triangles and vertices of no triangle are kept; each of these leaves a warning ([`TriMesh::warnings`]).
    ///
    /// # Errors
    /// `PositionsNotTriples`, `TrianglesNotTriples`, `TooManyElements`, `NonFinitePosition`, `PositionOverflow`,
    /// `IndexOutOfBounds`, and `EmptyMesh` where no vertex or no usable triangle is there.
    pub fn new(positions: Vec<f64>, triangles: Vec<u32>) -> Result<Self, MeshError> {
        let checked = validate::check(&positions, &triangles)?;
        drop(triangles);
        let connectivity = Connectivity::new(positions.len() / 3, checked.triangles);
        let areas = geometry::areas(&positions, connectivity.triangles());
        let zero_area: Vec<u32> =
            areas.iter().enumerate().filter(|&(_, &area)| area == 0.0).map(|(t, _)| t as u32).collect();
        let mut warnings = checked.warnings;
        Diagnostic::report(&mut warnings, "ZeroAreaTriangle", &mut zero_area.iter().copied(), &|count| {
            format!("{count} triangles have zero area; they count for critical points, but not for the operators")
        });
        let isolated = connectivity.isolated_vertices();
        Diagnostic::report(&mut warnings, "IsolatedVertex", &mut isolated.iter().copied(), &|count| {
            format!("{count} vertices belong to no triangle; they are no critical points and keep their value")
        });
        let area = areas.iter().sum();
        Ok(Self {
            shared: Arc::new(Shared {
                positions,
                connectivity,
                area,
                areas,
                repeated_id_triangles: checked.repeated_id_triangles,
                zero_area_triangles: zero_area.len(),
                warnings,
            }),
        })
    }

    /// Number of vertices, isolated ones included.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.shared.positions.len() / 3
    }

    /// Number of edges (unordered pairs of vertices that share a triangle).
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.connectivity().edges().len()
    }

    /// Number of triangles kept.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.connectivity().triangles().len()
    }

    /// x, y, z of every vertex, one after the other.
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.shared.positions
    }

    /// The position of one vertex.
    ///
    /// # Panics
    /// Where `vertex` is not below [`TriMesh::vertex_count`].
    #[inline]
    #[must_use]
    pub fn position(&self, vertex: u32) -> [f64; 3] {
        geometry::position(&self.shared.positions, vertex)
    }

    /// Vertices, edges and triangles and how they meet.
    #[must_use]
    pub fn connectivity(&self) -> &Connectivity {
        &self.shared.connectivity
    }

    /// Total area.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.shared.area
    }

    /// Area of every triangle; exactly zero where the three corners lie on one line up to rounding.
    #[must_use]
    pub fn triangle_areas(&self) -> &[f64] {
        &self.shared.areas
    }

    /// Whether a triangle's corners lie on one line up to rounding, so that its angles mean nothing.
    ///
    /// # Panics
    /// Where `triangle` is not below [`TriMesh::triangle_count`].
    #[must_use]
    pub fn is_zero_area(&self, triangle: u32) -> bool {
        self.shared.areas[triangle as usize] == 0.0
    }

    /// What was left out or looks suspicious in the input.
    #[must_use]
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.shared.warnings
    }

    /// Counts the invariants of the surface; O(n).
    #[must_use]
    pub fn topology(&self) -> MeshTopology {
        topology::compute(self.connectivity(), self.shared.repeated_id_triangles + self.shared.zero_area_triangles)
    }
}
