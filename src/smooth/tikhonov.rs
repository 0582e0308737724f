//! Tikhonov smoothing, eqs. (3) and (5) of \[Patane09\].

use core::f64::consts::TAU;

use super::report::{self, Smoothed};
use super::system::TikhonovSystem;
use super::{Operator, Phase, Progress, Smoother};
use crate::error::{FieldError, OptionError, Result};
use crate::field::{ValueRange, value_range};
use crate::operators::MassScale;

/// The matrix B that measures ‖x − f‖.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// B = I: eq. (3).
    Identity,
    /// B is the Galerkin mass matrix: eq. (5). The default.
    #[default]
    Mass,
    /// B is the lumped mass matrix: eq. (5) with a diagonal.
    Lumped,
}

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
    if !(options.epsilon.is_finite() && options.epsilon > 0.0) {
        let expected = "a positive finite number".to_owned();
        return Err(OptionError::InvalidOption { option: "epsilon".to_owned(), expected }.into());
    }
    let defaults = TikhonovOptions::default();
    if smoother.options.operator == Operator::Fem {
        for (option, differs) in
            [("metric", options.metric != defaults.metric), ("massScale", options.mass_scale != defaults.mass_scale)]
        {
            if differs {
                let reason = "the finite-element operator has its own mass matrix".to_owned();
                return Err(OptionError::InapplicableOption { option: option.to_owned(), reason }.into());
            }
        }
    }
    let ranges = ranges(smoother, values, options.channels)?;
    let mut interleaved = values.to_vec();
    let mut reports = Vec::with_capacity(options.channels);
    // A few at a time: any number of channels takes the memory of so many.
    for first in (0..options.channels).step_by(TOGETHER) {
        let channels: Vec<Channel> = (first..options.channels.min(first + TOGETHER))
            .map(|c| Channel::new(smoother, column(values, c, options.channels), ranges[c]))
            .collect();
        let mut system = match smoother.tikhonov.take() {
            Some(system) => system,
            None => TikhonovSystem::new(&smoother.mesh, &smoother.laplacian, smoother.options.operator)?,
        };
        let solved = system.solve(&smoother.mesh, &channels, options, &smoother.options, progress);
        // Kept after an error too: the analysis stays valid.
        smoother.tikhonov = Some(system);
        let solved = solved?;
        progress(Phase::Report, 0.95);
        for (c, (channel, solution)) in (first..).zip(channels.iter().zip(&solved.solutions)) {
            let smoothed: Vec<f64> = solution
                .values
                .iter()
                .zip(&channel.values)
                .map(|(x, &original)| x.map_or(original, |x| channel.range.min + channel.range.length() * x))
                .collect();
            for (vertex, &value) in smoothed.iter().enumerate() {
                interleaved[vertex * options.channels + c] = value;
            }
            reports.push(report::tikhonov(smoother, channel, solution, &smoothed, &solved, options)?);
        }
    }
    progress(Phase::Report, 1.0);
    Ok(Smoothed { values: interleaved, reports })
}

/// Channels that are solved for at once: as many as a factor in double precision takes together.
const TOGETHER: usize = 4;

/// One channel of the input.
pub(super) struct Channel {
    pub(super) values: Vec<f64>,
    pub(super) range: ValueRange,
    /// (value − min)/(max − min); zero for a constant.
    pub(super) normalized: Vec<f64>,
}

impl Channel {
    fn new(smoother: &Smoother, values: Vec<f64>, range: ValueRange) -> Self {
        let normalized = report::normalize(&values, smoother.mesh.connectivity().link_kinds(), range);
        Self { values, range, normalized }
    }
}

/// One channel of interleaved values.
fn column(values: &[f64], channel: usize, channels: usize) -> Vec<f64> {
    values.iter().skip(channel).step_by(channels).copied().collect()
}

/// The range of every channel, once all of them are known to be valid.
fn ranges(smoother: &Smoother, values: &[f64], channels: usize) -> Result<Vec<ValueRange>> {
    let n = smoother.mesh.vertex_count();
    if channels == 0 {
        let expected = "a positive integer".to_owned();
        return Err(OptionError::InvalidOption { option: "channels".to_owned(), expected }.into());
    }
    if n.checked_mul(channels) != Some(values.len()) {
        let expected = n.saturating_mul(channels);
        return Err(FieldError::LengthMismatch { expected, actual: values.len() }.into());
    }
    (0..channels).map(|c| Ok(value_range(smoother.mesh.connectivity(), &column(values, c, channels))?)).collect()
}
