//! The options of smoothing.

use js_sys::Float64Array;

use super::{Constraining, from_rule};
use crate::error::{OptionError, Result};
use crate::smooth::{
    BilateralOptions, Energy, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Metric, Operator, Progress,
    Smoothed, Smoother, SmootherOptions, TikhonovOptions, Unconstrained, epsilon_for_wavelength,
};
use crate::support::named::named;
use crate::wasm::shared::arrays::floats;
use crate::wasm::shared::record::Record;

/// What a smoother is made with.
pub(in crate::wasm::core) fn smoother(record: &Record) -> SmootherOptions {
    let defaults = SmootherOptions::default();
    SmootherOptions {
        weights: record.choice("weights").unwrap_or(defaults.weights),
        operator: record.choice("operator").unwrap_or(defaults.operator),
        solver: record.choice("solver").unwrap_or(defaults.solver),
        precision: record.choice("precision").unwrap_or(defaults.precision),
        bounds: record.boolean("bounds").unwrap_or(defaults.bounds),
    }
}

/// The methods of a smoother.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::wasm::core) enum MethodName {
    Tikhonov,
    Interpolate,
    LeastSquares,
    LowPass,
    Bilateral,
}

named! { MethodName {
    Tikhonov = "tikhonov", Interpolate = "interpolate", LeastSquares = "leastSquares", LowPass = "lowPass",
    Bilateral = "bilateral",
} }

/// The methods of `smooth`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::wasm::core) enum ShortMethod {
    Tikhonov,
    Interpolate,
    LeastSquares,
}

named! { ShortMethod { Tikhonov = "tikhonov", Interpolate = "interpolate", LeastSquares = "leastSquares" } }

impl ShortMethod {
    pub(in crate::wasm::core) fn method(self) -> MethodName {
        match self {
            Self::Tikhonov => MethodName::Tikhonov,
            Self::Interpolate => MethodName::Interpolate,
            Self::LeastSquares => MethodName::LeastSquares,
        }
    }
}

/// A method with its options; owns what the options of `smooth` borrow.
pub(in crate::wasm::core) enum Smoothing {
    Tikhonov(TikhonovOptions),
    Interpolate {
        constraining: Constraining,
        unconstrained: Unconstrained,
        energy: Energy,
        channels: usize,
    },
    LeastSquares {
        constraining: Constraining,
        unconstrained: Unconstrained,
        epsilon: f64,
        weights: Option<Vec<f64>>,
        channels: usize,
    },
    LowPass(LowPassOptions),
    Bilateral(BilateralOptions),
}

impl Smoothing {
    /// `operator` is the smoother's: not every option goes with every operator.
    pub(in crate::wasm::core) fn read(record: &Record, method: MethodName, operator: Operator) -> Self {
        let channels = record.integer("channels").map_or(1, |channels| channels as usize);
        match method {
            MethodName::Tikhonov => Self::Tikhonov(tikhonov(record, operator, channels)),
            MethodName::Interpolate => Self::Interpolate {
                constraining: constraining(record),
                unconstrained: record.choice("unconstrained").unwrap_or_default(),
                energy: record.choice("energy").unwrap_or_default(),
                channels,
            },
            MethodName::LeastSquares => Self::LeastSquares {
                constraining: constraining(record),
                unconstrained: record.choice("unconstrained").unwrap_or_default(),
                epsilon: epsilon(record),
                weights: None,
                channels,
            },
            MethodName::LowPass => Self::LowPass(low_pass(record, channels)),
            MethodName::Bilateral => Self::Bilateral(bilateral(record, channels)),
        }
    }

    /// Reads also the weights of constraints: the weights among the options of `smooth` are those of the Laplacian.
    pub(in crate::wasm::core) fn with_weights(mut self, record: &Record) -> Self {
        if let Self::LeastSquares { weights, .. } = &mut self {
            let array = record.object::<Float64Array>("weights", "one number for each constrained vertex");
            *weights = array.and_then(|array| record.taken(floats(&array)));
        }
        self
    }

    pub(in crate::wasm::core) fn apply(
        &self,
        smoother: &mut Smoother,
        values: &[f64],
        progress: Progress<'_>,
    ) -> Result<Smoothed> {
        match self {
            Self::Tikhonov(options) => smoother.tikhonov_with_progress(values, options, progress),
            Self::Interpolate { constraining, unconstrained, energy, channels } => {
                let constraints = constraining.constraints(*unconstrained);
                let options = InterpolateOptions { constraints, energy: *energy, channels: *channels };
                smoother.interpolate_with_progress(values, &options, progress).map_err(from_rule)
            }
            Self::LeastSquares { constraining, unconstrained, epsilon, weights, channels } => {
                let constraints = constraining.constraints(*unconstrained);
                let weights = weights.as_deref();
                let options = LeastSquaresOptions { constraints, epsilon: *epsilon, weights, channels: *channels };
                smoother.least_squares_with_progress(values, &options, progress).map_err(from_rule)
            }
            Self::LowPass(options) => smoother.low_pass_with_progress(values, options, progress),
            Self::Bilateral(options) => smoother.bilateral_with_progress(values, options, progress),
        }
    }
}

fn constraining(record: &Record) -> Constraining {
    if !record.has("constraints") {
        record.invalid("constraints", Constraining::EXPECTED);
    }
    record.part("constraints", Constraining::read).unwrap_or_default()
}

fn epsilon(record: &Record) -> f64 {
    if record.get("epsilon").and_then(|epsilon| epsilon.as_string()).as_deref() == Some("auto") {
        record.refuse(OptionError::UnsupportedOption { option: "epsilon".to_owned(), value: "auto".to_owned() });
    }
    record.given("epsilon", "a positive finite number, and it has no default")
}

fn tikhonov(record: &Record, operator: Operator, channels: usize) -> TikhonovOptions {
    let epsilon = match record.number("cutoffWavelength") {
        None => epsilon(record),
        Some(wavelength) => {
            if operator == Operator::Paper {
                record.inapplicable("cutoffWavelength", "only the operator `fem` knows lengths");
            }
            if record.has("epsilon") {
                record.inapplicable("epsilon", "`cutoffWavelength` says the same");
            }
            record.taken(epsilon_for_wavelength(wavelength)).unwrap_or_default()
        }
    };
    let metric = record.choice("metric").unwrap_or_default();
    let mass_scale = record.choice("massScale").unwrap_or_default();
    if metric == Metric::Identity && record.has("massScale") {
        record.inapplicable("massScale", "the metric `identity` has no mass matrix");
    }
    for option in ["metric", "massScale"] {
        if operator == Operator::Fem && record.has(option) {
            record.inapplicable(option, "the operator `fem` has its own mass matrix");
        }
    }
    TikhonovOptions { epsilon, metric, mass_scale, channels }
}

fn iterations(record: &Record) -> usize {
    record.given_integer("iterations", "an integer that is not negative, and it has no default")
}

fn low_pass(record: &Record, channels: usize) -> LowPassOptions {
    let defaults = LowPassOptions::default();
    LowPassOptions {
        iterations: iterations(record),
        lambda: record.number("lambda").unwrap_or(defaults.lambda),
        mu: record.number("mu").unwrap_or(defaults.mu),
        channels,
    }
}

fn bilateral(record: &Record, channels: usize) -> BilateralOptions {
    let given = |option: &str| record.given(option, "a positive finite number, and it has no default");
    BilateralOptions {
        iterations: iterations(record),
        radius: given("radius"),
        sigma_distance: given("sigmaDistance"),
        sigma_value: given("sigmaValue"),
        channels,
    }
}
