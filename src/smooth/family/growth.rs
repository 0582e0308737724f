//! How far a family has grown, and how good it is.

use super::estimate::Calibration;
use super::reach::{counted, kernel_of_traces};
use super::space::Space;
use crate::smooth::active::ActiveVertices;
use crate::smooth::system::Matrices;
use crate::support::random::Random;

/// Vectors with random signs that the trace of the matrix that smooths is found by. They are solved for together with what the space
/// needs, in two blocks of [`TOGETHER`](crate::smooth::channels::TOGETHER).
pub(super) const PROBES: usize = 6;

/// How far a family has grown.
#[derive(Debug)]
pub(super) struct Growth {
    pub(super) shifts: Vec<f64>,
    /// For every shift the trace of (S + εB)⁻¹εB.
    pub(super) traces: Vec<f64>,
    /// The number of values that the data term knows.
    pub(super) known: usize,
    pub(super) probes: Vec<Vec<f64>>,
    /// What the components' means have of the traces by the probes, on average, and their number, which is what they have in truth.
    pub(super) kernel: (f64, f64),
    pub(super) calibrations: Vec<Calibration>,
    pub(super) tolerance: f64,
    /// The ε with the largest error, and that error.
    pub(super) worst: (f64, f64),
    /// The least such error, and how many shifts ago it was halved.
    pub(super) least: (f64, usize),
    pub(super) is_complete: bool,
}

impl Growth {
    pub(super) fn new(first: f64, tolerance: f64, matrices: &Matrices, active: &ActiveVertices) -> Self {
        let counted = counted(matrices.mass());
        let n = matrices.unknowns().len();
        let is_known = |i: usize| counted.as_ref().is_none_or(|counted| counted[i] > 0.0);
        let mut random = Random::new(1);
        let mut sign = |i: usize| if is_known(i) { random.signed().signum() } else { 0.0 };
        let probes: Vec<Vec<f64>> = (0..PROBES).map(|_| (0..n).map(&mut sign).collect()).collect();
        let kernel = kernel_of_traces(&probes, matrices, active);
        Self {
            shifts: Vec::new(),
            traces: Vec::new(),
            known: (0..n).filter(|&i| is_known(i)).count(),
            probes,
            kernel,
            calibrations: Vec::new(),
            tolerance,
            worst: (first, 1.0),
            least: (1.0, 0),
            is_complete: false,
        }
    }

    /// The largest relative error of all channels.
    pub(super) fn error(&self, spaces: &[Space], epsilon: f64) -> f64 {
        let each = spaces.iter().zip(&self.calibrations);
        each.map(|(space, calibration)| calibration.error(space, epsilon, &self.shifts)).fold(0.0, f64::max)
    }
}
