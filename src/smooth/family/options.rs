//! What a family is made with.

use super::choose::EpsilonRule;
use crate::error::OptionError;
use crate::mesh::{TriMesh, diagonal};
use crate::smooth::operators::Operators;
use crate::smooth::{Functional, Method, Operator, epsilon_for_wavelength};

/// Options of [`Smoother::family`](crate::smooth::Smoother::family).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FamilyOptions<'a> {
    /// The method; its ε is where the space begins, and where it is good first; beyond the range, its nearer end. Default Tikhonov
    /// smoothing.
    pub method: Functional<'a>,
    /// The least and the largest ε. Default 1e-6 to 1e4.
    pub range: (f64, f64),
    /// The largest relative error ‖x − x_ε‖₂/‖x_ε‖₂ over the range, of normalised fields. Default 1e-6.
    pub tolerance: f64,
    /// The most factorisations: [`Smoother::grow`](crate::smooth::Smoother::grow) takes more. Default as many as the tolerance needs.
    pub factorizations: Option<usize>,
}

impl Default for FamilyOptions<'_> {
    fn default() -> Self {
        Self { method: Functional::default(), range: (1e-6, 1e4), tolerance: 1e-6, factorizations: None }
    }
}

/// The widest range: beyond, the two ends are too far apart for one space in double precision.
const WIDEST: f64 = 1e16;
/// Below this, rounding decides.
const SMALLEST_TOLERANCE: f64 = 1e-10;

/// The tolerance for rules that look at norms alone, and for those that count.
const FOR_NORMS: f64 = 1e-4;
const FOR_COUNTS: f64 = 1e-6;

impl<'a> FamilyOptions<'a> {
    /// A family that is to choose ε for a method.
    ///
    /// # Errors
    /// `InvalidOption` for a method without ε.
    pub(in crate::smooth) fn for_choice(
        method: &Method<'a>,
        rule: EpsilonRule,
        operators: &Operators,
    ) -> Result<Self, OptionError> {
        let defaults = Self::default();
        let range = match operators.options.operator {
            Operator::Paper => defaults.range,
            Operator::Fem => wavelengths(&operators.mesh).unwrap_or(defaults.range),
        };
        let middle = (range.0 * range.1).sqrt();
        // Whatever extrema are prescribed, the best ε is a matter of the functional and the noise.
        let Some(functional) = method.functional() else {
            return Err(OptionError::invalid("method", "`tikhonov`, `leastSquares` or `prescribe`, which have ε"));
        };
        let method = functional.with_epsilon(middle);
        let tolerance = if matches!(rule, EpsilonRule::AtMostCriticalPoints { .. }) { FOR_COUNTS } else { FOR_NORMS };
        Ok(Self { method, range, tolerance, ..defaults })
    }
}

/// The ε that halve waves as long as the mesh's bounding box is wide, and those as long as its edges, with a decade more on either side.
fn wavelengths(mesh: &TriMesh) -> Option<(f64, f64)> {
    let edge = (mesh.area() / mesh.triangle_count().max(1) as f64).sqrt();
    let largest = 10.0 * epsilon_for_wavelength(edge).ok()?;
    let least = 0.1 * epsilon_for_wavelength(diagonal(mesh.positions())).ok()?;
    let range = (least.max(largest / WIDEST), largest);
    (range.0 > 0.0 && range.0 < range.1 && range.1.is_finite()).then_some(range)
}

impl FamilyOptions<'_> {
    /// # Errors
    /// `InvalidOption`.
    pub(crate) fn check(&self) -> Result<(), OptionError> {
        let (least, largest) = self.range;
        let is_range = least > 0.0 && least < largest && largest.is_finite() && largest / least <= WIDEST;
        if !is_range {
            let expected = "two positive finite numbers, the smaller one first, with a quotient of no more than 1e16";
            return Err(OptionError::invalid("epsilonRange", expected));
        }
        if !(SMALLEST_TOLERANCE..1.0).contains(&self.tolerance) {
            return Err(OptionError::invalid("tolerance", "a number from 1e-10 to below 1"));
        }
        if self.factorizations == Some(0) {
            return Err(OptionError::invalid("factorizations", "a positive integer"));
        }
        Ok(())
    }

    /// Where the space begins, which is in the range.
    pub(super) fn first(&self) -> f64 {
        self.method.epsilon().clamp(self.range.0, self.range.1)
    }
}
