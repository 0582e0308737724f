//! Tikhonov smoothing, eqs. (3) and (5) of \[Patane09\].

use core::f64::consts::TAU;

use super::channels::Channels;
use super::regularized::{self, Regularization};
use super::report::Smoothed;
use super::system::Attraction;
use super::{Metric, Operator, Progress, Smoother};
use crate::error::{OptionError, Result};
use crate::operators::MassScale;

/// Options of [`Smoother::tikhonov`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TikhonovOptions {
    /// The trade-off: large keeps f, small smooths. Positive and finite. Default 0.05.
    pub epsilon: f64,
    /// The metric of ‖x − f‖; [`Operator::Fem`] has its own, the lumped mass in the mesh's units. Default mass.
    pub metric: Metric,
    /// Scale of the mass matrix; means nothing for the identity. Default mean one.
    pub mass_scale: MassScale,
    /// Values per vertex, interleaved: channel c of vertex i at `i · channels + c`. Default 1.
    pub channels: usize,
}

impl Default for TikhonovOptions {
    fn default() -> Self {
        Self { epsilon: 0.05, metric: Metric::default(), mass_scale: MassScale::default(), channels: 1 }
    }
}

/// The ε for which [`Operator::Fem`] halves the amplitude of waves of this length, in the units of the mesh: (2π/ℓ)⁴. Shorter
/// waves are damped more. Sensible between the mean length of the edges and the diameter of the mesh.
///
/// # Errors
/// `InvalidOption` where the length is not positive and finite, or so extreme that ε is not.
pub fn epsilon_for_wavelength(wavelength: f64) -> Result<f64, OptionError> {
    let square = (TAU / wavelength) * (TAU / wavelength);
    let epsilon = square * square;
    if wavelength > 0.0 && epsilon.is_finite() && epsilon > 0.0 {
        return Ok(epsilon);
    }
    let expected = "a positive finite length in the units of the mesh".to_owned();
    Err(OptionError::InvalidOption { option: "cutoffWavelength".to_owned(), expected })
}

pub(super) fn run(
    smoother: &mut Smoother,
    values: &[f64],
    options: &TikhonovOptions,
    progress: Progress<'_>,
) -> Result<Smoothed> {
    check_epsilon(options.epsilon)?;
    let defaults = TikhonovOptions::default();
    let is_fem = smoother.options.operator == Operator::Fem;
    if is_fem {
        for (option, differs) in
            [("metric", options.metric != defaults.metric), ("massScale", options.mass_scale != defaults.mass_scale)]
        {
            if differs {
                let reason = "the finite-element operator has its own mass matrix".to_owned();
                return Err(OptionError::InapplicableOption { option: option.to_owned(), reason }.into());
            }
        }
    }
    let channels = Channels::new(&smoother.mesh, values, options.channels)?;
    let attraction = match is_fem {
        true => Attraction::Metric(Metric::Lumped, MassScale::Raw),
        false => Attraction::Metric(options.metric, options.mass_scale),
    };
    let equation = match (is_fem, options.metric) {
        (true, _) => "fem",
        (false, Metric::Identity) => "(3)",
        (false, _) => "(5)",
    };
    let request =
        Regularization { method: "tikhonov", equation, epsilon: options.epsilon, attraction, constraints: None };
    regularized::run(smoother, &channels, &request, progress)
}

/// # Errors
/// `InvalidOption`.
pub(super) fn check_epsilon(epsilon: f64) -> Result<(), OptionError> {
    if epsilon.is_finite() && epsilon > 0.0 {
        return Ok(());
    }
    let expected = "a positive finite number".to_owned();
    Err(OptionError::InvalidOption { option: "epsilon".to_owned(), expected })
}
