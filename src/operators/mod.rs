//! Laplacians and mass matrices as compressed sparse columns.
//!
//! Sign: Laplacians are positive semi-definite where symmetric: l_ii = Σ w_ij, l_ij = −w_ij, every row sums to zero.

mod intrinsic;
mod laplacian;
mod mass;

pub use intrinsic::intrinsic_delaunay_laplacian;
pub use laplacian::{
    LaplacianWeights, cotan_laplacian, laplacian, mean_value_laplacian, normalized_cotan_laplacian, uniform_laplacian,
};
pub use mass::{MassKind, MassOptions, MassScale, galerkin_mass, lumped_mass, lumped_mass_diagonal, mass};

use nalgebra_sparse::CscMatrix;

use crate::error::Cancelled;
use crate::support::csc::valid_csc;
use crate::support::pieces::{pieces, ranges};
use crate::support::watch::Watch;

/// Bytes of a number as it is stored in a matrix.
const INDEX: u64 = size_of::<usize>() as u64;

/// The work with an edge that is counted or summed up, with one whose entries are put in their places, and with a triangle of which
/// all three corners are looked at.
const SUMMED: u64 = 10;
const PLACED: u64 = 40;
const CORNERS: u64 = 60;

/// The bytes that [`assemble`] takes, the matrix included.
fn assembly_bytes(n: usize, edges: usize) -> u64 {
    let (n, entries) = (n as u64, n as u64 + 2 * edges as u64);
    // Two counters for each column and where it begins; a row and a value for each entry.
    INDEX * (3 * n + 1) + (INDEX + 8) * entries
}

/// The bytes that [`from_symmetric`] takes, the matrix included.
fn symmetric_bytes(n: usize, edges: usize) -> u64 {
    8 * n as u64 + 16 * edges as u64 + assembly_bytes(n, edges)
}

/// The symmetric Laplacian with these weights of these edges: see [`assemble`]. The caller makes sure of [`symmetric_bytes`].
fn from_symmetric(
    n: usize,
    edges: &[[u32; 2]],
    weights: &[f64],
    watch: &Watch<'_>,
) -> Result<CscMatrix<f64>, Cancelled> {
    let mut diagonal = vec![0.0; n];
    let mut sides = Vec::with_capacity(weights.len());
    for range in ranges(edges.len(), SUMMED, watch) {
        let range = range?;
        for (&[a, b], &w) in edges[range.clone()].iter().zip(&weights[range]) {
            diagonal[a as usize] += w;
            diagonal[b as usize] += w;
            sides.push([-w, -w]);
        }
    }
    assemble(edges, &diagonal, &sides, watch)
}

/// A matrix with `diagonal` and, for every edge (a, b), the entries `sides[0]` at (a, b) and `sides[1]` at (b, a). The
/// diagonal is always stored, and so is every edge whatever its entries: who has the edges knows the pattern.
///
/// The caller makes sure of [`assembly_bytes`]. The edges, a < b, each once, come in lexicographic order, so the columns fill in the order of their rows and nothing needs
/// sorting, which triplets would.
fn assemble(
    edges: &[[u32; 2]],
    diagonal: &[f64],
    sides: &[[f64; 2]],
    watch: &Watch<'_>,
) -> Result<CscMatrix<f64>, Cancelled> {
    let n = diagonal.len();
    let (mut below, mut above) = (vec![0_usize; n], vec![0_usize; n]);
    for piece in pieces(edges, SUMMED, watch) {
        for &[a, b] in piece? {
            above[a as usize] += 1;
            below[b as usize] += 1;
        }
    }
    let mut offsets = Vec::with_capacity(n + 1);
    let mut end = 0;
    offsets.push(end);
    for v in 0..n {
        end += below[v] + 1 + above[v];
        offsets.push(end);
    }
    let (mut rows, mut values) = (vec![0; end], vec![0.0; end]);
    // From here on where the next entry above and below the diagonal goes.
    for v in 0..n {
        let place = offsets[v] + below[v];
        rows[place] = v;
        values[place] = diagonal[v];
        below[v] = offsets[v];
        above[v] = place + 1;
    }
    for range in ranges(edges.len(), PLACED, watch) {
        let range = range?;
        for (&[a, b], &[ab, ba]) in edges[range.clone()].iter().zip(&sides[range]) {
            let (a, b) = (a as usize, b as usize);
            for (place, row, value) in [(&mut above[a], b, ba), (&mut below[b], a, ab)] {
                rows[*place] = row;
                values[*place] = value;
                *place += 1;
            }
        }
    }
    // Rows ascend in every column by construction, so the data is valid.
    Ok(valid_csc(n, n, offsets, rows, values))
}
