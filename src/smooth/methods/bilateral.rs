//! The bilateral filter of \[Patane09, section 2.2\].

use core::ops::Range;

use super::grid::Grid;
use super::{filtered, filtering_bytes, require};
use crate::error::{Cancelled, OptionError, Result};
use crate::field::Missing;
use crate::mesh::{LinkKind, TriMesh};
#[cfg(doc)]
use crate::smooth::Smoother;
use crate::smooth::channels::Channel;
use crate::smooth::input::Input;
use crate::smooth::names::{Equation, MethodName};
use crate::smooth::report::{About, Measures, Smoothed};
use crate::smooth::run::{Found, Procedure, Solution, run};
use crate::smooth::schedule::{Schedule, Stages};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// Options of [`Smoother::bilateral`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BilateralOptions {
    /// Number of steps. Default 1.
    pub iterations: usize,
    /// How far neighbours can be, in the units of the mesh; two or three times `sigma_distance` leave out little. Positive and
    /// finite, with no default that would suit every mesh. The time of a step grows with the number of vertices within it.
    pub radius: f64,
    /// The standard deviation of the weights by distance, in the units of the mesh. Positive and finite, without a default.
    pub sigma_distance: f64,
    /// The standard deviation of the weights by difference of value, in the units of the field: larger steps are kept.
    /// Positive and finite, without a default.
    pub sigma_value: f64,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`. Default 1.
    pub channels: usize,
    /// What NaN means; filters cannot fill. Default an error.
    pub missing: Missing,
}

impl Default for BilateralOptions {
    /// The lengths are 0, which is refused: they have to be given.
    fn default() -> Self {
        Self {
            iterations: 1,
            radius: 0.0,
            sigma_distance: 0.0,
            sigma_value: 0.0,
            channels: 1,
            missing: Missing::default(),
        }
    }
}

/// # Errors
/// `InvalidOption`.
pub(in crate::smooth) fn check(options: &BilateralOptions) -> Result<(), OptionError> {
    let &BilateralOptions { radius, sigma_distance, sigma_value, .. } = options;
    for (option, value) in [("radius", radius), ("sigmaDistance", sigma_distance), ("sigmaValue", sigma_value)] {
        require(value.is_finite() && value > 0.0, option, "a positive finite number")?;
    }
    Ok(())
}

pub(in crate::smooth) fn start(input: &Input<'_>, options: &BilateralOptions, watch: &Watch<'_>) -> Result<Smoothed> {
    let schedule = Schedule::of_filter(input.channels.group_count());
    let stages = schedule.stages(watch);
    // The grid while it is sorted; coordinates, and the values of two steps.
    memory::ensure(64 * input.operators.mesh.vertex_count() as u64)?;
    let points = Points::new(&input.operators.mesh, options.radius);
    let about = About {
        method: MethodName::Bilateral,
        equation: Equation::Bilateral,
        epsilon: None,
        constraints: None,
        unconstrained: None,
    };
    run(input, &about, &mut Bilateral { options, points }, stages)
}

struct Bilateral<'a> {
    options: &'a BilateralOptions,
    points: Points,
}

impl Procedure for Bilateral<'_> {
    fn solve(&mut self, group: &[Channel], _: bool, stages: &mut Stages<'_, '_>) -> Result<Found> {
        let steps = (group.len() * self.options.iterations) as u64;
        stages.begin(Phase::Solve, self.points.ticks().saturating_mul(steps))?;
        memory::ensure(filtering_bytes(group[0].values.len(), group.len()))?;
        let smooth = |channel: &Channel| self.smoothed(channel, stages.watch);
        let solutions = group.iter().map(smooth).collect::<Result<_>>()?;
        Ok(Found { solutions, perturbation_factor: None })
    }

    fn measures(&mut self, _: &[f64], _: &[f64]) -> Measures {
        Measures::default()
    }
}

impl Bilateral<'_> {
    fn smoothed(&self, channel: &Channel, watch: &Watch<'_>) -> Result<Solution> {
        let &BilateralOptions { iterations, radius, sigma_distance, sigma_value, .. } = self.options;
        let weights = Weights {
            radius_squared: radius * radius,
            distance: exponent(sigma_distance),
            // Infinite for a constant channel, which stays.
            difference: exponent(sigma_value / channel.range.length()),
        };
        let mut x = channel.normalized.clone();
        let points = self.points.grid.points();
        let mut here: Vec<f64> = points.iter().map(|&v| x[v as usize]).collect();
        let mut next = here.clone();
        for _ in 0..iterations {
            self.points.step(&here, &weights, &mut next, watch)?;
            core::mem::swap(&mut here, &mut next);
        }
        for (&v, &value) in points.iter().zip(&here) {
            x[v as usize] = value;
        }
        Ok(filtered(channel, &x, iterations))
    }
}

/// 1/(2σ²), which is not infinite, because infinity times zero would be NaN.
fn exponent(sigma: f64) -> f64 {
    (0.5 / sigma / sigma).min(f64::MAX)
}

/// The time of a pair of points, in ticks: most of it is the exponential of those within the radius.
const PAIR: u64 = 8;

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
    fn new(mesh: &TriMesh, radius: f64) -> Self {
        let kinds = mesh.connectivity().link_kinds();
        let used: Vec<u32> = (0..kinds.len() as u32).filter(|&v| kinds[v as usize] != LinkKind::Isolated).collect();
        let positions = mesh.positions();
        let grid = Grid::new(positions, &used, radius);
        let axis = |k: usize| grid.points().iter().map(|&v| positions[3 * v as usize + k]).collect();
        Self { x: axis(0), y: axis(1), z: axis(2), grid }
    }

    /// How long a step takes, in ticks.
    fn ticks(&self) -> u64 {
        let mut ticks = 0_u64;
        let count = |cell: Range<usize>, near: &[Range<usize>; 9]| {
            ticks += cell.len() as u64 * pairs(near);
            Ok(())
        };
        // Counting is not stopped.
        let _: Result<(), Cancelled> = self.grid.visit(&mut { count });
        ticks
    }

    /// One step for all points, which come in the order of the grid.
    fn step(&self, values: &[f64], weights: &Weights, next: &mut [f64], watch: &Watch<'_>) -> Result<(), Cancelled> {
        self.grid.visit(&mut |cell, near| {
            let ticks = pairs(near);
            for i in cell {
                // A cell can hold all of the mesh.
                watch.tick(ticks)?;
                let mut sums = Sums { weights: 0.0, differences: 0.0 };
                for range in near {
                    self.gather(values, i, range, weights, &mut sums);
                }
                // The point itself weighs 1, so the sum is not zero.
                next[i] = values[i] + sums.differences / sums.weights;
            }
            Ok(())
        })
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

/// How long a point with these points near takes, in ticks.
fn pairs(near: &[Range<usize>; 9]) -> u64 {
    PAIR * near.iter().map(|range| range.len() as u64).sum::<u64>()
}

/// Sums over the neighbours of a point.
struct Sums {
    weights: f64,
    differences: f64,
}
