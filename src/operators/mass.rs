//! Mass matrices: the paper's B \[Patane09, section 4.2\] and its lumped form.

use nalgebra_sparse::CscMatrix;

use super::{CORNERS, INDEX, SUMMED, assemble, assembly_bytes};
use crate::error::MeshError;
use crate::mesh::TriMesh;
use crate::support::memory;
use crate::support::named::named;
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// What a mass matrix is scaled to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MassScale {
    /// Times n/area, n the number of vertices with a triangle: mean vertex area 1, so that ε has the same meaning with
    /// and without the matrix and does not depend on units. The default.
    #[default]
    MeanOne,
    /// As the paper prints it, in units of area.
    Raw,
}

named! { MassScale { MeanOne = "meanOne", Raw = "raw" } }

/// The kinds of mass matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum MassKind {
    /// That of linear elements: see [`galerkin_mass`]. The default.
    #[default]
    Galerkin,
    /// Its row sums on the diagonal: see [`lumped_mass`].
    Lumped,
}

named! { MassKind { Galerkin = "galerkin", Lumped = "lumped" } }

/// Which mass matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MassOptions {
    /// Its kind. Default Galerkin.
    pub kind: MassKind,
    /// What it is scaled to. Default mean one.
    pub scale: MassScale,
}

/// The mass matrix with the given options: see the function of each kind, which does the same unwatched.
///
/// # Errors
/// `ZeroArea` for [`MassScale::MeanOne`] on a mesh without area; `Cancelled`, `OutOfMemory`.
pub fn mass(mesh: &TriMesh, options: &MassOptions, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    match options.kind {
        MassKind::Galerkin => galerkin(mesh, options.scale, watch),
        MassKind::Lumped => lumped(mesh, options.scale, watch),
    }
}

impl MassScale {
    fn factor(self, mesh: &TriMesh) -> Result<f64, MeshError> {
        match self {
            Self::Raw => Ok(1.0),
            Self::MeanOne if mesh.area() > 0.0 => {
                Ok(mesh.connectivity().referenced_vertex_count() as f64 / mesh.area())
            }
            Self::MeanOne => Err(MeshError::ZeroArea {}),
        }
    }
}

/// The Galerkin (consistent) mass matrix B of linear elements.
///
/// # Definition
/// b_ij = Σ |t|/12 over the triangles at the edge (i, j), b_ii = Σ |t|/6 over those at the vertex i
/// (\[Patane09, section 4.2\]).
///
/// # Properties
/// n × n, symmetric, positive definite on the vertices with area; the entries sum to the area (raw) or to n (mean one).
///
/// # Errors
/// `ZeroArea` for [`MassScale::MeanOne`] on a mesh without area; `OutOfMemory`.
pub fn galerkin_mass(mesh: &TriMesh, scale: MassScale) -> Result<CscMatrix<f64>, MeshError> {
    galerkin(mesh, scale, &Watch::none())
}

fn galerkin(mesh: &TriMesh, scale: MassScale, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    let factor = scale.factor(mesh)?;
    let connectivity = mesh.connectivity();
    let (n, edges) = (mesh.vertex_count(), mesh.edge_count());
    memory::ensure(8 * n as u64 + 16 * edges as u64 + assembly_bytes(n, edges))?;
    let mut diagonal = vec![0.0; mesh.vertex_count()];
    let mut sides = vec![[0.0; 2]; mesh.edge_count()];
    for range in ranges(mesh.triangle_count(), CORNERS, watch) {
        for t in range? {
            let share = mesh.triangle_areas()[t] * factor / 12.0;
            for c in 0..3 {
                diagonal[connectivity.triangles()[t][c] as usize] += 2.0 * share;
                for side in &mut sides[connectivity.triangle_edges()[t][c] as usize] {
                    *side += share;
                }
            }
        }
    }
    Ok(assemble(connectivity.edges(), &diagonal, &sides, watch)?)
}

/// The lumped mass matrix: a third of the area of the triangles at every vertex on the diagonal, the row sums of
/// [`galerkin_mass`]. Only the diagonal is stored.
///
/// # Errors
/// `ZeroArea` for [`MassScale::MeanOne`] on a mesh without area; `OutOfMemory`.
pub fn lumped_mass(mesh: &TriMesh, scale: MassScale) -> Result<CscMatrix<f64>, MeshError> {
    lumped(mesh, scale, &Watch::none())
}

fn lumped(mesh: &TriMesh, scale: MassScale, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    watch.tick(SUMMED * mesh.triangle_count() as u64)?;
    let diagonal = lumped_mass_diagonal(mesh, scale)?;
    // Where each column begins, its row and its value.
    memory::ensure((2 * INDEX + 8) * diagonal.len() as u64 + INDEX)?;
    let mut matrix = CscMatrix::identity(diagonal.len());
    matrix.values_mut().copy_from_slice(&diagonal);
    Ok(matrix)
}

/// The diagonal of [`lumped_mass`].
///
/// # Errors
/// `ZeroArea` for [`MassScale::MeanOne`] on a mesh without area; `OutOfMemory`.
pub fn lumped_mass_diagonal(mesh: &TriMesh, scale: MassScale) -> Result<Vec<f64>, MeshError> {
    let factor = scale.factor(mesh)?;
    memory::ensure(8 * mesh.vertex_count() as u64)?;
    let mut diagonal = vec![0.0; mesh.vertex_count()];
    for (corners, &area) in mesh.connectivity().triangles().iter().zip(mesh.triangle_areas()) {
        for &v in corners {
            diagonal[v as usize] += area * factor / 3.0;
        }
    }
    Ok(diagonal)
}
