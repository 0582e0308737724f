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
    let mut around = Around::new(x);
    for (column, entries) in laplacian.col_iter().enumerate() {
        for (&row, &value) in entries.row_indices().iter().zip(entries.values()) {
            if row != column && value != 0.0 && is_free[row] {
                smallest = if -value < smallest { -value } else { smallest };
                around.see(row, column);
            }
        }
    }
    let extrema = around.extrema(free);
    let mut around = Around::new(x);
    for &[a, b] in connectivity.edges() {
        around.see(a as usize, b as usize);
        around.see(b as usize, a as usize);
    }
    MaximumPrinciple {
        smallest_weight: if smallest.is_finite() { smallest } else { 0.0 },
        extrema,
        mesh_extrema: around.extrema(free),
    }
}

/// Which sides of each vertex's value its neighbours lie on.
struct Around<'a> {
    x: &'a [f64],
    sides: Vec<u8>,
}

const BELOW: u8 = 1;
const NEAR: u8 = 2;
const ABOVE: u8 = 4;

impl<'a> Around<'a> {
    fn new(x: &'a [f64]) -> Self {
        Self { x, sides: vec![0; x.len()] }
    }

    fn see(&mut self, vertex: usize, neighbour: usize) {
        let difference = self.x[neighbour] - self.x[vertex];
        self.sides[vertex] |= match () {
            () if difference > ROUNDING => ABOVE,
            () if difference < -ROUNDING => BELOW,
            () => NEAR,
        };
    }

    /// Vertices with all neighbours on one side.
    fn extrema(&self, of: &[u32]) -> usize {
        of.iter().filter(|&&v| matches!(self.sides[v as usize], BELOW | ABOVE)).count()
    }
}
