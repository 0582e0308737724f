//! The maximum principle, and what of it can be certified for a harmonic interpolation.

use nalgebra_sparse::CscMatrix;

use crate::mesh::Connectivity;

/// A value beyond its neighbours by no more than this, of the field normalised to [0, 1], is beyond them by rounding.
const ROUNDING: f64 = 1e-12;

/// What a harmonic interpolation shows of the maximum principle: where no weight is negative, every free value is a weighted
/// mean of its neighbours', so that no free vertex is an extremum among them.
///
/// With [`LaplacianWeights::IntrinsicDelaunay`](crate::operators::LaplacianWeights::IntrinsicDelaunay) the neighbours are those
/// of the intrinsic triangulation, and weights can be negative at boundary and non-manifold edges only. What is an extremum
/// among the neighbours along the mesh's own edges is counted, not promised.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct MaximumPrinciple {
    /// The smallest weight between a free vertex and a neighbour; negative ones void the principle. 0 where there are none.
    pub smallest_weight: f64,
    /// Free vertices that are extrema among the neighbours that L couples them with, beyond rounding (1e-12 of the range).
    pub extrema: usize,
    /// Free vertices that are extrema, likewise, among the neighbours along the edges of the mesh.
    pub mesh_extrema: usize,
}

/// `free`: ascending.
pub(super) fn certify(
    connectivity: &Connectivity,
    laplacian: &CscMatrix<f64>,
    free: &[u32],
    x: &[f64],
) -> MaximumPrinciple {
    let mut is_free = vec![false; x.len()];
    free.iter().for_each(|&v| is_free[v as usize] = true);
    let mut smallest = f64::INFINITY;
    let mut sides = vec![0_u8; x.len()];
    let (offsets, rows, values) = laplacian.csc_data();
    for column in 0..x.len() {
        for k in offsets[column]..offsets[column + 1] {
            let (row, value) = (rows[k], values[k]);
            if row != column && value != 0.0 && is_free[row] {
                smallest = if -value < smallest { -value } else { smallest };
                sides[row] |= side(x[column] - x[row]);
            }
        }
    }
    let extrema = count_extrema(&sides, free);
    sides.fill(0);
    for &[a, b] in connectivity.edges() {
        let difference = x[b as usize] - x[a as usize];
        sides[a as usize] |= side(difference);
        sides[b as usize] |= side(-difference);
    }
    MaximumPrinciple {
        smallest_weight: if smallest.is_finite() { smallest } else { 0.0 },
        extrema,
        mesh_extrema: count_extrema(&sides, free),
    }
}

const BELOW: u8 = 1;
const NEAR: u8 = 2;
const ABOVE: u8 = 4;

/// Where a neighbour lies whose value differs by so much.
#[inline]
fn side(difference: f64) -> u8 {
    // Without branches, which could not be foretold where a field is rough.
    let (below, above) = (u8::from(difference < -ROUNDING), u8::from(difference > ROUNDING));
    below * BELOW | above * ABOVE | (1 - below - above) * NEAR
}

/// Vertices with all neighbours on one side.
fn count_extrema(sides: &[u8], of: &[u32]) -> usize {
    of.iter().filter(|&&v| matches!(sides[v as usize], BELOW | ABOVE)).count()
}
