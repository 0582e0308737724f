//! The maximum principle, and what of it can be certified for a harmonic interpolation.

use std::sync::Arc;

use nalgebra_sparse::CscMatrix;

use crate::mesh::Connectivity;

/// A value beyond its neighbours by no more than this, of the field normalised to [0, 1], is beyond them by rounding.
const ROUNDING: f64 = 1e-12;

/// What a harmonic interpolation shows of the maximum principle: where no weight is negative, every free value is a weighted
/// mean of its neighbours', so that no free vertex is an extremum among them.
///
/// With [`LaplacianWeights::IntrinsicDelaunay`](crate::operators::LaplacianWeights::IntrinsicDelaunay) the neighbours are those
/// of the intrinsic triangulation, and weights can be negative at boundary and non-manifold edges only. What is an extremum
/// among the neighbours along the mesh's own edges is counted, not promised. Neighbours with the same value but for rounding are
/// no extrema, alone or together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct MaximumPrinciple {
    /// The smallest weight between a free vertex and a neighbour; negative ones void the principle. 0 where there are none, and
    /// where it is nothing but rounding.
    pub smallest_weight: f64,
    /// Free vertices that are extrema among the neighbours that L couples them with, beyond rounding (1e-12 of the range).
    pub extrema: usize,
    /// Free vertices that are extrema beyond rounding among the neighbours along the edges of the mesh.
    pub mesh_extrema: usize,
}

/// What is the same for all channels.
#[derive(Debug)]
pub(super) struct Certifier<'a> {
    connectivity: &'a Connectivity,
    /// Ascending.
    free: Arc<[u32]>,
    smallest_weight: f64,
    /// The neighbours of free vertices in L, as (vertex, neighbour); nothing where they are those along the edges of the mesh.
    couplings: Option<Vec<[u32; 2]>>,
}

impl<'a> Certifier<'a> {
    pub(super) fn new(connectivity: &'a Connectivity, laplacian: &CscMatrix<f64>, free: &Arc<[u32]>) -> Self {
        let n = connectivity.vertex_count();
        let mut is_free = vec![false; n];
        free.iter().for_each(|&v| is_free[v as usize] = true);
        let (offsets, rows, values) = laplacian.csc_data();
        // L stores its diagonal and the edges of the mesh, and with other weights more than these.
        let mut is_mesh = rows.len() == n + 2 * connectivity.edges().len();
        let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
        for column in 0..n {
            for k in offsets[column]..offsets[column + 1] {
                if rows[k] != column {
                    largest = largest.max(values[k].abs());
                    is_mesh &= values[k] != 0.0;
                    if is_free[rows[k]] && values[k] != 0.0 && -values[k] < smallest {
                        smallest = -values[k];
                    }
                }
            }
        }
        let couplings = (!is_mesh).then(|| {
            let mut couplings = Vec::new();
            for (row, column, &value) in laplacian.triplet_iter() {
                if row != column && value != 0.0 && is_free[row] {
                    couplings.push([row as u32, column as u32]);
                }
            }
            couplings
        });
        // The cotangent of a right angle is zero but for rounding, on either side.
        let is_zero = !smallest.is_finite() || smallest.abs() <= f64::EPSILON * largest;
        let smallest_weight = if is_zero { 0.0 } else { smallest };
        Self { connectivity, free: Arc::clone(free), smallest_weight, couplings }
    }

    pub(super) fn certify(&self, x: &[f64]) -> MaximumPrinciple {
        let mut sides = vec![0_u8; x.len()];
        for &[a, b] in self.connectivity.edges() {
            let difference = x[b as usize] - x[a as usize];
            sides[a as usize] |= side(difference);
            sides[b as usize] |= side(-difference);
        }
        let mesh_extrema = count_extrema(&sides, &self.free);
        let extrema = match &self.couplings {
            None => mesh_extrema,
            Some(couplings) => {
                sides.fill(0);
                for &[vertex, neighbour] in couplings {
                    sides[vertex as usize] |= side(x[neighbour as usize] - x[vertex as usize]);
                }
                count_extrema(&sides, &self.free)
            }
        };
        MaximumPrinciple { smallest_weight: self.smallest_weight, extrema, mesh_extrema }
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
    (below * BELOW) | (above * ABOVE) | ((1 - below - above) * NEAR)
}

/// Vertices with all neighbours on one side.
fn count_extrema(sides: &[u8], of: &[u32]) -> usize {
    of.iter().filter(|&&v| matches!(sides[v as usize], BELOW | ABOVE)).count()
}
