//! The functionals ‖Lx‖² + ε‖x − f‖² that eqs. (3), (5) and (7) of \[Patane09\] minimise.

use super::{LeastSquaresOptions, Regularization, TikhonovOptions, least_squares, tikhonov};
use crate::error::{OptionError, Result};
use crate::field::Missing;
use crate::smooth::SmootherOptions;
use crate::smooth::input::Input;
use crate::smooth::schedule::Stages;

/// A smoothness energy with a data term that ε weighs: what Tikhonov smoothing or least squares minimise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Functional<'a> {
    /// That of [`Smoother::tikhonov`](crate::smooth::Smoother::tikhonov), with all values as data.
    Tikhonov(TikhonovOptions),
    /// That of [`Smoother::least_squares`](crate::smooth::Smoother::least_squares), with the values of constrained vertices as data.
    LeastSquares(LeastSquaresOptions<'a>),
}

impl Default for Functional<'_> {
    fn default() -> Self {
        Self::Tikhonov(TikhonovOptions::default())
    }
}

impl<'a> Functional<'a> {
    /// ε.
    #[must_use]
    pub fn epsilon(&self) -> f64 {
        match self {
            Self::Tikhonov(options) => options.epsilon,
            Self::LeastSquares(options) => options.epsilon,
        }
    }

    /// The same with another ε.
    #[must_use]
    pub fn with_epsilon(self, epsilon: f64) -> Self {
        match self {
            Self::Tikhonov(options) => Self::Tikhonov(TikhonovOptions { epsilon, ..options }),
            Self::LeastSquares(options) => Self::LeastSquares(LeastSquaresOptions { epsilon, ..options }),
        }
    }

    /// Values per vertex.
    #[must_use]
    pub fn channels(&self) -> usize {
        match self {
            Self::Tikhonov(options) => options.channels,
            Self::LeastSquares(options) => options.channels,
        }
    }

    /// What NaN means.
    #[must_use]
    pub fn missing(&self) -> Missing {
        match self {
            Self::Tikhonov(options) => options.missing,
            Self::LeastSquares(options) => options.missing,
        }
    }

    /// # Errors
    /// `InvalidOption`, `InapplicableOption`.
    pub(in crate::smooth) fn check(&self, smoother: SmootherOptions) -> Result<(), OptionError> {
        match self {
            Self::Tikhonov(options) => tikhonov::check(options, smoother),
            Self::LeastSquares(options) => tikhonov::check_epsilon(options.epsilon),
        }
    }

    /// What is solved, whatever ε is.
    pub(in crate::smooth) fn regularization(
        &self,
        input: &Input<'_>,
        stages: &mut Stages<'_, '_>,
    ) -> Result<Regularization> {
        match self {
            Self::Tikhonov(options) => tikhonov::regularization(input, options),
            Self::LeastSquares(options) => least_squares::regularization(input, options, stages),
        }
    }
}
