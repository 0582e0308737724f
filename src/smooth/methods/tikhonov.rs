//! Tikhonov smoothing, eqs. (3) and (5) of \[Patane09\].

use core::f64::consts::TAU;

use super::regularized::{Regularization, Regularized, term};
use super::settings;
use crate::error::{OptionError, Result};
use crate::field::Missing;
use crate::operators::MassScale;
#[cfg(doc)]
use crate::smooth::Smoother;
use crate::smooth::data_term::Norm;
use crate::smooth::input::Input;
use crate::smooth::names::{Equation, MethodName};
use crate::smooth::report::{About, Smoothed};
use crate::smooth::run::run;
use crate::smooth::schedule::{Forecast, Schedule};
use crate::smooth::systems::Systems;
use crate::smooth::unconstrained::UnconstrainedComponents;
use crate::smooth::{Metric, Operator, SmootherOptions, Unconstrained};
use crate::support::memory;
use crate::support::watch::Watch;

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
    /// What NaN means. Default an error.
    pub missing: Missing,
    /// With [`Missing::Fill`]: what becomes of a component of the mesh without any value; any other choice than an error is refused
    /// otherwise. Default an error.
    pub unconstrained: Unconstrained,
}

impl Default for TikhonovOptions {
    fn default() -> Self {
        Self {
            epsilon: 0.05,
            metric: Metric::default(),
            mass_scale: MassScale::default(),
            channels: 1,
            missing: Missing::default(),
            unconstrained: Unconstrained::default(),
        }
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

/// # Errors
/// `InvalidOption`, `InapplicableOption`.
pub(in crate::smooth) fn check(options: &TikhonovOptions, smoother: SmootherOptions) -> Result<(), OptionError> {
    check_epsilon(options.epsilon)?;
    let defaults = TikhonovOptions::default();
    let inapplicable = |option: &str, reason: &str| {
        Err(OptionError::InapplicableOption { option: option.to_owned(), reason: reason.to_owned() })
    };
    if smoother.operator == Operator::Fem {
        for (option, differs) in
            [("metric", options.metric != defaults.metric), ("massScale", options.mass_scale != defaults.mass_scale)]
        {
            if differs {
                return inapplicable(option, "the finite-element operator has its own mass matrix");
            }
        }
    }
    if options.missing != Missing::Fill && options.unconstrained != defaults.unconstrained {
        return inapplicable("unconstrained", "every vertex has data, unless missing values are filled in");
    }
    Ok(())
}

pub(in crate::smooth) fn start(
    input: &Input<'_>,
    systems: &mut Systems,
    options: &TikhonovOptions,
    watch: &Watch<'_>,
) -> Result<Smoothed> {
    let operators = input.operators;
    let Regularization { about, unknowns, term } = regularization(input, options)?;
    let system = systems.regularized(operators, &unknowns, &term, watch)?;
    let (work, analysis, factorization) = system.forecast(options.epsilon, settings(operators.options, true));
    let groups = input.channels.group_count();
    let schedule = Schedule::new(&Forecast { rule: false, work, analysis, factorization, groups });
    let mut procedure = Regularized { system, epsilon: options.epsilon, options: operators.options, constant: 0 };
    run(input, &about, &mut procedure, schedule.stages(watch))
}

/// What is solved, whatever ε is.
pub(in crate::smooth) fn regularization(input: &Input<'_>, options: &TikhonovOptions) -> Result<Regularization> {
    let operators = input.operators;
    let (norm, equation) = match (operators.options.operator, options.metric) {
        (Operator::Fem, _) => (Norm::Lumped(MassScale::Raw), Equation::Fem),
        (Operator::Paper, Metric::Identity) => (Norm::Identity, Equation::Identity),
        (Operator::Paper, metric) => (Norm::new(metric, options.mass_scale), Equation::Mass),
    };
    let active = &operators.active;
    memory::ensure(24 * operators.mesh.vertex_count() as u64)?;
    let unconstrained = match &input.gaps {
        None => None,
        Some(gaps) => {
            let known: Vec<u32> = active.list().iter().copied().filter(|&v| gaps.has_value(v)).collect();
            Some(UnconstrainedComponents::new(active, &known, options.unconstrained)?)
        }
    };
    let unknowns = unconstrained.as_ref().map(|components| components.remaining(active));
    let unknowns = unknowns.unwrap_or_else(|| active.list().to_vec());
    let about = About {
        method: MethodName::Tikhonov,
        equation,
        epsilon: Some(options.epsilon),
        constraints: None,
        unconstrained,
    };
    Ok(Regularization { about, unknowns, term: term(norm, input.gaps.as_ref()) })
}

/// # Errors
/// `InvalidOption`.
pub(in crate::smooth) fn check_epsilon(epsilon: f64) -> Result<(), OptionError> {
    if epsilon.is_finite() && epsilon > 0.0 {
        return Ok(());
    }
    let expected = "a positive finite number".to_owned();
    Err(OptionError::InvalidOption { option: "epsilon".to_owned(), expected })
}
