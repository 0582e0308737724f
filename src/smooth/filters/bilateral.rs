//! The bilateral filter of \[Patane09, section 2.2\].

use core::ops::Range;

use super::grid::Grid;
use super::{Filter, apply, require};
use crate::error::Result;
use crate::mesh::LinkKind;
use crate::smooth::channels::{Channel, Channels};
use crate::smooth::report::Smoothed;
use crate::smooth::{Progress, Smoother};

/// Options of [`Smoother::bilateral`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BilateralOptions {
    /// Number of steps.
    pub iterations: usize,
    /// How far neighbours can be, in the units of the mesh; two or three times `sigma_distance` leave out little. Positive and
    /// finite. The time of a step grows with the number of vertices within it.
    pub radius: f64,
    /// The standard deviation of the weights by distance, in the units of the mesh. Positive and finite.
    pub sigma_distance: f64,
    /// The standard deviation of the weights by difference of value, in the units of the field: larger steps are kept.
    /// Positive and finite.
    pub sigma_value: f64,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`.
    pub channels: usize,
}

pub(in crate::smooth) fn run(
    smoother: &Smoother,
    values: &[f64],
    options: &BilateralOptions,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    let &BilateralOptions { iterations, radius, sigma_distance, sigma_value, channels } = options;
    for (option, value) in [("radius", radius), ("sigmaDistance", sigma_distance), ("sigmaValue", sigma_value)] {
        require(value.is_finite() && value > 0.0, option, "a positive finite number")?;
    }
    let channels = Channels::new(&smoother.mesh, values, channels)?;
    let points = Points::new(smoother, radius);
    let filter = Filter { method: "bilateral", equation: "[15]", iterations, perturbation_factor: None };
    let mut steps = |channel: &Channel, tell: &mut dyn FnMut(f64)| -> Result<Vec<f64>> {
        let weights = Weights {
            radius_squared: radius * radius,
            distance: exponent(sigma_distance),
            // Infinite for a constant channel, which stays.
            difference: exponent(sigma_value / channel.range.length()),
        };
        let mut x = channel.normalized.clone();
        let mut here: Vec<f64> = points.grid.points().iter().map(|&v| x[v as usize]).collect();
        let mut next = here.clone();
        for iteration in 0..iterations {
            points.step(&here, &weights, &mut next, &mut |of_it| {
                tell((iteration as f64 + of_it) / iterations as f64);
            });
            core::mem::swap(&mut here, &mut next);
        }
        for (&v, &value) in points.grid.points().iter().zip(&here) {
            x[v as usize] = value;
        }
        Ok(x)
    };
    apply(smoother, &channels, &filter, &mut steps, progress)
}

/// 1/(2σ²), which is not infinite, because infinity times zero would be NaN.
fn exponent(sigma: f64) -> f64 {
    (0.5 / sigma / sigma).min(f64::MAX)
}

/// Progress is told after so many points.
const TOLD_EVERY: usize = 16;

/// How a neighbour counts.
struct Weights {
    radius_squared: f64,
    /// 1/(2σ²) for distances.
    distance: f64,
    /// 1/(2σ²) for differences of normalised values.
    difference: f64,
}

/// The vertices of triangles in the order of the grid, one coordinate beside the other.
struct Points {
    grid: Grid,
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
}

impl Points {
    fn new(smoother: &Smoother, radius: f64) -> Self {
        let kinds = smoother.mesh.connectivity().link_kinds();
        let used: Vec<u32> = (0..kinds.len() as u32).filter(|&v| kinds[v as usize] != LinkKind::Isolated).collect();
        let positions = smoother.mesh.positions();
        let grid = Grid::new(positions, &used, radius);
        let axis = |k: usize| grid.points().iter().map(|&v| positions[3 * v as usize + k]).collect();
        Self { x: axis(0), y: axis(1), z: axis(2), grid }
    }

    /// One step for all points, which come in the order of the grid.
    fn step(&self, values: &[f64], weights: &Weights, next: &mut [f64], tell: &mut dyn FnMut(f64)) {
        self.grid.visit(&mut |cell, near| {
            for i in cell.clone() {
                // A cell can hold all of the mesh.
                if i % TOLD_EVERY == 0 {
                    tell(i as f64 / values.len() as f64);
                }
                let mut sums = Sums { weights: 0.0, differences: 0.0 };
                for range in near {
                    self.gather(values, i, range, weights, &mut sums);
                }
                // The point itself weighs 1, so the sum is not zero.
                next[i] = values[i] + sums.differences / sums.weights;
            }
        });
    }

    /// Adds what the points of a range are to one of them.
    #[inline(never)]
    fn gather(&self, values: &[f64], i: usize, range: &Range<usize>, weights: &Weights, sums: &mut Sums) {
        let (x, y, z, value) = (self.x[i], self.y[i], self.z[i], values[i]);
        let (xs, ys) = (&self.x[range.clone()], &self.y[range.clone()]);
        let (zs, values) = (&self.z[range.clone()], &values[range.clone()]);
        for j in 0..xs.len() {
            let (dx, dy, dz) = (xs[j] - x, ys[j] - y, zs[j] - z);
            let square = dx * dx + dy * dy + dz * dz;
            if square <= weights.radius_squared {
                let difference = values[j] - value;
                let exponent = square * weights.distance + difference * difference * weights.difference;
                // Not the standard library's, which differs between platforms.
                let weight = libm::exp(-exponent);
                sums.weights += weight;
                sums.differences += weight * difference;
            }
        }
    }
}

/// Over the neighbours of a point.
struct Sums {
    weights: f64,
    differences: f64,
}
