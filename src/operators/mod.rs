//! Laplacians and mass matrices as compressed sparse columns.
//!
//! Sign: Laplacians are positive semi-definite where symmetric: l_ii = Σ w_ij, l_ij = −w_ij, every row sums to zero.

mod laplacian;
mod mass;

pub use laplacian::{
    LaplacianWeights, cotan_laplacian, laplacian, mean_value_laplacian, normalized_cotan_laplacian, uniform_laplacian,
};
pub use mass::{MassScale, galerkin_mass, lumped_mass, lumped_mass_diagonal};

use nalgebra_sparse::{CooMatrix, CscMatrix};

use crate::mesh::TriMesh;

/// A matrix with `diagonal` and, for every edge (a, b), the entries `sides[0]` at (a, b) and `sides[1]` at (b, a). The
/// diagonal is always stored, so that patterns depend on the connectivity only.
fn assemble(mesh: &TriMesh, diagonal: &[f64], sides: &[[f64; 2]]) -> CscMatrix<f64> {
    let n = mesh.vertex_count();
    let entries = n + 2 * sides.len();
    let (mut rows, mut columns, mut values) =
        (Vec::with_capacity(entries), Vec::with_capacity(entries), Vec::with_capacity(entries));
    let mut push = |row: usize, column: usize, value: f64| {
        rows.push(row);
        columns.push(column);
        values.push(value);
    };
    for (i, &value) in diagonal.iter().enumerate() {
        push(i, i, value);
    }
    for (&[a, b], &[ab, ba]) in mesh.connectivity().edges().iter().zip(sides) {
        push(a as usize, b as usize, ab);
        push(b as usize, a as usize, ba);
    }
    let mut coo = CooMatrix::new(n, n);
    if let Ok(filled) = CooMatrix::try_from_triplets(n, n, rows, columns, values) {
        coo = filled;
    }
    CscMatrix::from(&coo)
}
