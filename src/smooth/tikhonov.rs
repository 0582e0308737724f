//! Tikhonov smoothing, eqs. (3) and (5) of \[Patane09\].

use super::report::{self, Smoothed};
use super::system::TikhonovSystem;
use super::{Phase, Progress, Smoother};
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
    /// The metric of ‖x − f‖. Default mass.
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
    let channels = split_channels(smoother, values, options.channels)?;
    let mut system = match smoother.tikhonov.take() {
        Some(system) => system,
        None => TikhonovSystem::new(&smoother.mesh, &smoother.laplacian, smoother.options.weights)?,
    };
    let fields: Vec<Vec<f64>> = channels.iter().map(|channel| channel.normalized.clone()).collect();
    let solved = system.solve(&smoother.mesh, &fields, options, smoother.options.solver, progress);
    // Kept after an error too: the analysis stays valid.
    smoother.tikhonov = Some(system);
    let solved = solved?;
    progress(Phase::Report, 0.95);
    let mut interleaved = values.to_vec();
    let mut reports = Vec::with_capacity(channels.len());
    for (c, (channel, solution)) in channels.iter().zip(&solved.solutions).enumerate() {
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
    progress(Phase::Report, 1.0);
    Ok(Smoothed { values: interleaved, reports })
}

/// One channel of the input.
pub(super) struct Channel {
    pub(super) values: Vec<f64>,
    pub(super) range: ValueRange,
    /// (value − min)/(max − min); zero for a constant.
    pub(super) normalized: Vec<f64>,
}

fn split_channels(smoother: &Smoother, values: &[f64], channels: usize) -> Result<Vec<Channel>> {
    let n = smoother.mesh.vertex_count();
    if channels == 0 {
        let expected = "a positive integer".to_owned();
        return Err(OptionError::InvalidOption { option: "channels".to_owned(), expected }.into());
    }
    if n.checked_mul(channels) != Some(values.len()) {
        let expected = n.saturating_mul(channels);
        return Err(FieldError::LengthMismatch { expected, actual: values.len() }.into());
    }
    (0..channels)
        .map(|c| {
            let values: Vec<f64> = values.iter().skip(c).step_by(channels).copied().collect();
            let range = value_range(smoother.mesh.connectivity(), &values)?;
            let normalized = report::normalize(&values, smoother.mesh.connectivity().link_kinds(), range);
            Ok(Channel { values, range, normalized })
        })
        .collect()
}
