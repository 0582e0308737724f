//! Laplacians with the weights of \[Patane09, section 4.1\], and the choice among all there are.

use nalgebra_sparse::CscMatrix;

use super::{CORNERS, SUMMED, assemble, assembly_bytes, from_symmetric, intrinsic, symmetric_bytes};
use crate::error::{Cancelled, MeshError};
use crate::mesh::{TriMesh, difference, dot, norm};
use crate::support::memory;
use crate::support::named::named;
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// So many triangles are looked at between two counts of the work.
const WATCHED: usize = 4096;

/// Where the absolute weights of a row cancel to this fraction, dividing by their sum would only blow up rounding.
const CANCELLED: f64 = 1e-12;

/// The weights w_ij of a Laplacian.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum LaplacianWeights {
    /// (cot α + cot β)/2; symmetric. The default.
    #[default]
    Cotangent,
    /// Floater's mean value coordinates; not symmetric.
    MeanValue,
    /// (cot α + cot β)/2 in the intrinsic Delaunay triangulation; symmetric.
    IntrinsicDelaunay,
    /// Cotangent weights, every row divided by its sum; not symmetric.
    NormalizedCotangent,
    /// 1 for every edge; symmetric.
    Uniform,
}

named! { LaplacianWeights {
    Cotangent = "cotangent", MeanValue = "meanValue", NormalizedCotangent = "normalizedCotangent", Uniform = "uniform",
    IntrinsicDelaunay = "intrinsicDelaunay",
} }

impl LaplacianWeights {
    /// Whether w_ij = w_ji.
    #[must_use]
    pub fn is_symmetric(self) -> bool {
        matches!(self, Self::Cotangent | Self::IntrinsicDelaunay | Self::Uniform)
    }
}

/// The Laplacian with the given weights: see the function of each, which does the same unwatched.
///
/// # Errors
/// `ZeroWeightSum` for [`LaplacianWeights::NormalizedCotangent`]; `Cancelled`, `OutOfMemory`.
pub fn laplacian(mesh: &TriMesh, weights: LaplacianWeights, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    match weights {
        LaplacianWeights::Cotangent => symmetric(mesh, cotan_weights, watch),
        LaplacianWeights::IntrinsicDelaunay => intrinsic::laplacian(mesh, watch),
        LaplacianWeights::MeanValue => mean_value(mesh, watch),
        LaplacianWeights::NormalizedCotangent => normalized_cotan(mesh, watch),
        LaplacianWeights::Uniform => symmetric(mesh, |mesh, _| Ok(vec![1.0; mesh.edge_count()]), watch),
    }
}

/// The cotangent Laplacian.
///
/// # Definition
/// w_ij = Σ ½ cot α over the angles α opposite to the edge (i, j): two inside a surface, one on its boundary
/// (\[Patane09, section 4.1\], \[Pinkall93\]). Triangles of zero area contribute nothing.
///
/// # Properties
/// n × n, symmetric, positive semi-definite; constants are in its kernel; single weights may be negative. Rows and columns
/// of isolated vertices are zero.
///
/// # Units
/// None: scaling the mesh does not change it.
///
/// # Errors
/// `OutOfMemory`.
///
/// # Example
/// ```
/// use morse_smooth::{mesh::shapes, operators::cotan_laplacian};
/// let laplacian = cotan_laplacian(&shapes::tetrahedron()?)?;
/// // Three angles of 60° meet every edge's two opposite corners: w = cot 60° = 1/√3.
/// let entry = laplacian.get_entry(0, 1).map(|entry| entry.into_value());
/// assert!((entry.unwrap_or(0.0) + 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn cotan_laplacian(mesh: &TriMesh) -> Result<CscMatrix<f64>, MeshError> {
    laplacian(mesh, LaplacianWeights::Cotangent, &Watch::none())
}

/// The graph Laplacian: w_ij = 1 for every edge.
///
/// # Properties
/// n × n, symmetric, positive semi-definite, without units; the diagonal holds the valences.
///
/// # Errors
/// `OutOfMemory`.
pub fn uniform_laplacian(mesh: &TriMesh) -> Result<CscMatrix<f64>, MeshError> {
    laplacian(mesh, LaplacianWeights::Uniform, &Watch::none())
}

/// The Laplacian with one weight per edge, which `weights` makes.
fn symmetric(
    mesh: &TriMesh,
    weights: fn(&TriMesh, &Watch<'_>) -> Result<Vec<f64>, Cancelled>,
    watch: &Watch<'_>,
) -> Result<CscMatrix<f64>, MeshError> {
    let (n, edges) = (mesh.vertex_count(), mesh.connectivity().edges());
    memory::ensure(8 * edges.len() as u64 + symmetric_bytes(n, edges.len()))?;
    Ok(from_symmetric(n, edges, &weights(mesh, watch)?, watch)?)
}

/// The cotangent Laplacian with every row divided by its sum of weights.
///
/// # Properties
/// n × n, not symmetric, unit diagonal except in rows without area, which are zero. Without units.
///
/// # Errors
/// `ZeroWeightSum` where positive and negative weights of a row cancel; `OutOfMemory`.
pub fn normalized_cotan_laplacian(mesh: &TriMesh) -> Result<CscMatrix<f64>, MeshError> {
    laplacian(mesh, LaplacianWeights::NormalizedCotangent, &Watch::none())
}

fn normalized_cotan(mesh: &TriMesh, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    memory::ensure(normalized_bytes(mesh))?;
    let weights = cotan_weights(mesh, watch)?;
    let mut sides = Vec::with_capacity(weights.len());
    sides.extend(weights.iter().map(|&w| [w, w]));
    drop(weights);
    normalized(mesh, sides, watch)
}

/// The Laplacian of Floater's mean value coordinates.
///
/// # Definition
/// λ_ij = w_ij / Σ_k w_ik with w_ij = Σ tan(θ/2)/|p_j − p_i| over the angles θ at i beside the edge (i, j)
/// (\[Floater03, eq. 2.1\]; \[Patane09, section 4.1\] names them as an alternative).
///
/// # Properties
/// n × n, not symmetric, unit diagonal, off-diagonal entries −λ_ij ≤ 0. Without units.
///
/// # Errors
/// `OutOfMemory`.
pub fn mean_value_laplacian(mesh: &TriMesh) -> Result<CscMatrix<f64>, MeshError> {
    laplacian(mesh, LaplacianWeights::MeanValue, &Watch::none())
}

fn mean_value(mesh: &TriMesh, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    memory::ensure(normalized_bytes(mesh))?;
    let mut sides = vec![[0.0; 2]; mesh.edge_count()];
    let connectivity = mesh.connectivity();
    for (t, (corners, edges)) in connectivity.triangles().iter().zip(connectivity.triangle_edges()).enumerate() {
        if t % WATCHED == 0 {
            watch.tick(2 * CORNERS * WATCHED as u64)?;
        }
        if mesh.is_zero_area(t as u32) {
            continue;
        }
        let twice_area = 2.0 * mesh.triangle_areas()[t];
        for c in 0..3 {
            let (here, next, previous) = (corners[c], corners[(c + 1) % 3], corners[(c + 2) % 3]);
            let (a, b) = (
                difference(mesh.position(next), mesh.position(here)),
                difference(mesh.position(previous), mesh.position(here)),
            );
            let (lengths, cosine) = (norm(a) * norm(b), dot(a, b));
            // tan(θ/2) = sin θ/(1 + cos θ) = (1 − cos θ)/sin θ: the one without cancellation.
            let tangent = if cosine > 0.0 { twice_area / (lengths + cosine) } else { (lengths - cosine) / twice_area };
            for (edge, length) in [(edges[c], norm(a)), (edges[(c + 2) % 3], norm(b))] {
                let [first, _] = connectivity.edges()[edge as usize];
                sides[edge as usize][usize::from(first != here)] += tangent / length;
            }
        }
    }
    normalized(mesh, sides, watch)
}

/// Half the cotangents opposite to every edge, summed.
fn cotan_weights(mesh: &TriMesh, watch: &Watch<'_>) -> Result<Vec<f64>, Cancelled> {
    let mut weights = vec![0.0; mesh.edge_count()];
    let connectivity = mesh.connectivity();
    for (t, (corners, edges)) in connectivity.triangles().iter().zip(connectivity.triangle_edges()).enumerate() {
        if t % WATCHED == 0 {
            watch.tick(CORNERS * WATCHED as u64)?;
        }
        if mesh.is_zero_area(t as u32) {
            continue;
        }
        let four_areas = 4.0 * mesh.triangle_areas()[t];
        for c in 0..3 {
            let opposite = mesh.position(corners[(c + 2) % 3]);
            let a = difference(mesh.position(corners[c]), opposite);
            let b = difference(mesh.position(corners[(c + 1) % 3]), opposite);
            weights[edges[c] as usize] += dot(a, b) / four_areas;
        }
    }
    Ok(weights)
}

/// The bytes that [`normalized`] takes, its argument and the matrix included.
fn normalized_bytes(mesh: &TriMesh) -> u64 {
    // The sums of the weights of every vertex, those of their absolute values, and the diagonal.
    let (n, edges) = (mesh.vertex_count(), mesh.edge_count());
    24 * n as u64 + 16 * edges as u64 + assembly_bytes(n, edges)
}

/// Divides the weights of every vertex by their sum.
fn normalized(mesh: &TriMesh, mut sides: Vec<[f64; 2]>, watch: &Watch<'_>) -> Result<CscMatrix<f64>, MeshError> {
    let mut sums = vec![0.0_f64; mesh.vertex_count()];
    let mut sizes = vec![0.0_f64; mesh.vertex_count()];
    let edges = mesh.connectivity().edges();
    for range in ranges(edges.len(), SUMMED, watch) {
        let range = range?;
        for (ends, weights) in edges[range.clone()].iter().zip(&sides[range]) {
            for (&v, w) in ends.iter().zip(weights) {
                sums[v as usize] += w;
                sizes[v as usize] += w.abs();
            }
        }
    }
    let mut diagonal = vec![0.0; sums.len()];
    for (v, (&sum, &size)) in sums.iter().zip(&sizes).enumerate() {
        if size > 0.0 {
            if sum.abs() <= CANCELLED * size {
                return Err(MeshError::ZeroWeightSum { vertex: v as u32 });
            }
            diagonal[v] = 1.0;
        }
    }
    for range in ranges(edges.len(), 2 * SUMMED, watch) {
        let range = range?;
        for (ends, weights) in edges[range.clone()].iter().zip(&mut sides[range]) {
            for (&v, w) in ends.iter().zip(weights) {
                if sizes[v as usize] > 0.0 {
                    *w /= -sums[v as usize];
                }
            }
        }
    }
    Ok(assemble(edges, &diagonal, &sides, watch)?)
}
