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
pub(crate) use geometry::{cross, diagonal, difference, dot, norm};
pub use submesh::Submesh;
pub use topology::MeshTopology;
pub(crate) use validate::check_arrays;
pub use weld::{WeldOptions, Welded, WeldedField, weld};

use crate::error::{Diagnostic, MeshError};
use crate::support::memory;
use crate::support::watch::Watch;

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
    /// `IndexOutOfBounds`, `OutOfMemory`, and `EmptyMesh` where no vertex or no usable triangle is there.
    pub fn new(positions: Vec<f64>, triangles: Vec<u32>) -> Result<Self, MeshError> {
        Self::watched(positions, triangles, &Watch::none())
    }

    /// The same, watched.
    ///
    /// # Errors
    /// Those of [`TriMesh::new`]; `Cancelled`.
    pub(crate) fn watched(positions: Vec<f64>, triangles: Vec<u32>, watch: &Watch<'_>) -> Result<Self, MeshError> {
        let n = positions.len() / 3;
        check_arrays(&positions, &triangles)?;
        memory::ensure(validate::bytes(n, triangles.len() / 3))?;
        let checked = validate::check(n, &triangles, watch)?;
        drop(triangles);
        let m = checked.triangles.len();
        memory::ensure(Connectivity::bytes(n, m) + 8 * m as u64)?;
        let connectivity = Connectivity::new(n, checked.triangles, watch)?;
        let areas = geometry::areas(&positions, connectivity.triangles());
        let has_no_area = || areas.iter().map(|&area| area == 0.0);
        let mut warnings = checked.warnings;
        let mut zero_area = (0_u32..).zip(has_no_area()).filter(|&(_, has_none)| has_none).map(|(t, _)| t);
        Diagnostic::report(&mut warnings, "ZeroAreaTriangle", &mut zero_area, &|count| {
            format!("{count} triangles have zero area; they count for critical points, but not for the operators")
        });
        let is_isolated = connectivity.link_kinds().iter().map(|&kind| kind == LinkKind::Isolated);
        let mut isolated = (0_u32..).zip(is_isolated).filter(|&(_, is_isolated)| is_isolated).map(|(v, _)| v);
        Diagnostic::report(&mut warnings, "IsolatedVertex", &mut isolated, &|count| {
            format!("{count} vertices belong to no triangle; they are no critical points and keep their value")
        });
        let area = areas.iter().sum();
        let zero_area_triangles = has_no_area().filter(|&has_none| has_none).count();
        Ok(Self {
            shared: Arc::new(Shared {
                positions,
                connectivity,
                area,
                areas,
                repeated_id_triangles: checked.repeated_id_triangles,
                zero_area_triangles,
                warnings,
            }),
        })
    }

    /// A mesh of a triangle soup: every three positions are a triangle of its own. [`weld`] joins them.
    ///
    /// # Errors
    /// Those of [`TriMesh::new`]; `TrianglesNotTriples` where the number of vertices is no multiple of three.
    pub fn from_soup(positions: Vec<f64>) -> Result<Self, MeshError> {
        validate::check_positions(&positions)?;
        let n = positions.len() / 3;
        memory::ensure(4 * n as u64)?;
        Self::new(positions, (0..n as u32).collect())
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
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn topology(&self) -> Result<MeshTopology, MeshError> {
        topology::compute(self.connectivity(), self.shared.repeated_id_triangles + self.shared.zero_area_triangles)
    }
}
