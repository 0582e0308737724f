//! What a family is made with.

use crate::error::OptionError;
use crate::smooth::{LeastSquaresOptions, Method, TikhonovOptions};

/// The methods that have families.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FamilyMethod<'a> {
    /// [`Smoother::tikhonov`](crate::smooth::Smoother::tikhonov).
    Tikhonov(TikhonovOptions),
    /// [`Smoother::least_squares`](crate::smooth::Smoother::least_squares).
    LeastSquares(LeastSquaresOptions<'a>),
}

impl<'a> FamilyMethod<'a> {
    /// The method with its options, in which ε is the one where the space begins.
    pub(super) fn method(self) -> Method<'a> {
        match self {
            Self::Tikhonov(options) => Method::Tikhonov(options),
            Self::LeastSquares(options) => Method::LeastSquares(options),
        }
    }

    fn epsilon(&self) -> f64 {
        match self {
            Self::Tikhonov(options) => options.epsilon,
            Self::LeastSquares(options) => options.epsilon,
        }
    }
}

/// Options of [`Smoother::family`](crate::smooth::Smoother::family).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FamilyOptions<'a> {
    /// The method; its ε is where the space begins, and where it is good first. Default Tikhonov smoothing.
    pub method: FamilyMethod<'a>,
    /// The least and the largest ε. Default 1e-6 to 1e4.
    pub range: (f64, f64),
    /// The largest relative error ‖x − x_ε‖₂/‖x_ε‖₂ over the range, of normalised fields. Default 1e-6.
    pub tolerance: f64,
    /// The most factorisations: [`Smoother::grow`](crate::smooth::Smoother::grow) takes more. Default as many as the tolerance needs.
    pub factorizations: Option<usize>,
}

impl Default for FamilyOptions<'_> {
    fn default() -> Self {
        Self {
            method: FamilyMethod::Tikhonov(TikhonovOptions::default()),
            range: (1e-6, 1e4),
            tolerance: 1e-6,
            factorizations: None,
        }
    }
}

/// The widest range: beyond, the two ends are too far apart for one space in double precision.
const WIDEST: f64 = 1e16;
/// Below this, rounding decides.
const SMALLEST_TOLERANCE: f64 = 1e-10;

impl FamilyOptions<'_> {
    /// # Errors
    /// `InvalidOption`.
    pub(super) fn check(&self) -> Result<(), OptionError> {
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
