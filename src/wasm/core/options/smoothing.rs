//! The options of smoothing.

use js_sys::Float64Array;

use super::Constraining;
use super::epsilon::epsilon;
use super::prescribe::Prescribing;
use crate::field::Missing;
use crate::smooth::{
    BilateralOptions, Constraints, EpsilonRule, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Method,
    MethodName, Metric, Operator, SmootherOptions, TikhonovOptions, epsilon_for_wavelength,
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

/// The methods of `smooth`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::wasm::core) enum ShortMethod {
    Tikhonov,
    Interpolate,
    LeastSquares,
    Prescribe,
}

named! { ShortMethod {
    Tikhonov = "tikhonov", Interpolate = "interpolate", LeastSquares = "leastSquares", Prescribe = "prescribe",
} }

impl ShortMethod {
    pub(in crate::wasm::core) fn method(self) -> MethodName {
        match self {
            Self::Tikhonov => MethodName::Tikhonov,
            Self::Interpolate => MethodName::Interpolate,
            Self::LeastSquares => MethodName::LeastSquares,
            Self::Prescribe => MethodName::Prescribe,
        }
    }
}

/// Why an option of constraints is refused.
const WITHOUT_CONSTRAINTS: &str = "without `constraints` it has no meaning";

/// A method with its options; owns what the options of `smooth` borrow.
pub(in crate::wasm::core) enum Smoothing {
    Tikhonov(TikhonovOptions, Option<EpsilonRule>),
    Interpolate(Constraining, InterpolateOptions<'static>),
    LeastSquares(Constraining, Option<Vec<f64>>, LeastSquaresOptions<'static>, Option<EpsilonRule>),
    LowPass(LowPassOptions),
    Bilateral(BilateralOptions),
    /// With the method whose functional is to be small.
    Prescribe(Box<Smoothing>, Prescribing),
}

impl Smoothing {
    /// `operator` is the smoother's: not every option goes with every operator.
    pub(in crate::wasm::core) fn read(record: &Record, method: MethodName, operator: Operator) -> Self {
        Self::read_with(record, method, operator, false)
    }

    /// The same where ε is chosen if it is not given.
    pub(in crate::wasm::core) fn read_with_default(record: &Record, method: MethodName, operator: Operator) -> Self {
        Self::read_with(record, method, operator, true)
    }

    fn read_with(record: &Record, method: MethodName, operator: Operator, has_default: bool) -> Self {
        let channels = record.integer("channels").map_or(1, |channels| channels as usize);
        let missing = record.choice("missing").unwrap_or_default();
        match method {
            MethodName::Tikhonov => {
                let (options, rule) = tikhonov(record, operator, has_default);
                Self::Tikhonov(TikhonovOptions { channels, missing, ..options }, rule)
            }
            MethodName::Interpolate => {
                let (constraining, constraints) = constraints(record);
                let energy = record.choice("energy").unwrap_or_default();
                Self::Interpolate(constraining, InterpolateOptions { constraints, energy, channels, missing })
            }
            MethodName::LeastSquares => {
                let (constraining, constraints) = constraints(record);
                let (epsilon, rule) = epsilon(record, has_default);
                let options = LeastSquaresOptions { constraints, epsilon, weights: None, channels, missing };
                Self::LeastSquares(constraining, None, options, rule)
            }
            MethodName::LowPass => Self::LowPass(LowPassOptions { channels, missing, ..low_pass(record) }),
            MethodName::Bilateral => Self::Bilateral(BilateralOptions { channels, missing, ..bilateral(record) }),
            MethodName::Prescribe => {
                let functional = Self::read_functional(record, operator, has_default);
                Self::Prescribe(Box::new(functional), Prescribing::read(record))
            }
        }
    }

    /// The functional of least squares where there are constraints, else that of Tikhonov smoothing.
    fn read_functional(record: &Record, operator: Operator, has_default: bool) -> Self {
        let read = |constrained: bool| {
            let method = if constrained { MethodName::LeastSquares } else { MethodName::Tikhonov };
            Self::read_with(record, method, operator, has_default)
        };
        let constrained = record.holds("constraints");
        let functional = read(constrained);
        record.foreign(if constrained { "it is not for least squares" } else { WITHOUT_CONSTRAINTS }, &|_| {
            read(!constrained);
        });
        functional
    }

    /// Reads also the weights of constraints: the weights among the options of `smooth` are those of the Laplacian.
    pub(in crate::wasm::core) fn with_weights(mut self, record: &Record) -> Self {
        if let Self::Prescribe(functional, prescribing) = self {
            if !record.holds("constraints") && record.has("weights") {
                record.inapplicable("weights", WITHOUT_CONSTRAINTS);
                return Self::Prescribe(functional, prescribing);
            }
            return Self::Prescribe(Box::new(functional.with_weights(record)), prescribing);
        }
        if let Self::LeastSquares(_, weights, ..) = &mut self {
            let array = record.object::<Float64Array>("weights", "one number for each constrained vertex");
            *weights = array.and_then(|array| record.taken(floats(&array)));
        }
        self
    }

    /// The rule that chooses ε, where none is given.
    pub(in crate::wasm::core) fn rule(&self) -> Option<EpsilonRule> {
        match self {
            Self::Tikhonov(_, rule) | Self::LeastSquares(.., rule) => *rule,
            Self::Prescribe(functional, _) => functional.rule(),
            _ => None,
        }
    }

    pub(in crate::wasm::core) fn method(&self) -> Method<'_> {
        match self {
            Self::Tikhonov(options, _) => Method::Tikhonov(*options),
            Self::Interpolate(constraining, options) => {
                let constraints = constraining.constraints(options.constraints.unconstrained);
                Method::Interpolate(InterpolateOptions { constraints, ..*options })
            }
            Self::LeastSquares(constraining, weights, options, _) => {
                let constraints = constraining.constraints(options.constraints.unconstrained);
                Method::LeastSquares(LeastSquaresOptions { constraints, weights: weights.as_deref(), ..*options })
            }
            Self::LowPass(options) => Method::LowPass(*options),
            Self::Bilateral(options) => Method::Bilateral(*options),
            Self::Prescribe(functional, prescribing) => {
                prescribing.method(functional.method().functional().unwrap_or_default())
            }
        }
    }
}

/// What is constrained, and what becomes of components without a constraint.
fn constraints(record: &Record) -> (Constraining, Constraints<'static>) {
    if !record.has("constraints") {
        record.invalid("constraints", Constraining::EXPECTED);
    }
    let constraining = record.part("constraints", Constraining::read).unwrap_or_default();
    let unconstrained = record.choice("unconstrained").unwrap_or_default();
    (constraining, Constraints { unconstrained, ..Constraints::default() })
}

fn tikhonov(record: &Record, operator: Operator, has_default: bool) -> (TikhonovOptions, Option<EpsilonRule>) {
    let (epsilon, rule) = match record.number("cutoffWavelength") {
        None => epsilon(record, has_default),
        Some(wavelength) => {
            if operator == Operator::Paper {
                record.inapplicable("cutoffWavelength", "only the operator `fem` knows lengths");
            }
            if record.has("epsilon") {
                record.inapplicable("epsilon", "`cutoffWavelength` says the same");
            }
            (record.taken(epsilon_for_wavelength(wavelength)).unwrap_or_default(), None)
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
    // Without gaps that are filled in no component is without values.
    let fills = record.choice("missing") == Some(Missing::Fill);
    let unconstrained = if fills { record.choice("unconstrained") } else { None };
    let unconstrained = unconstrained.unwrap_or_default();
    (TikhonovOptions { epsilon, metric, mass_scale, unconstrained, ..TikhonovOptions::default() }, rule)
}

fn iterations(record: &Record) -> usize {
    record.given_integer("iterations", "an integer that is not negative, and it has no default")
}

fn low_pass(record: &Record) -> LowPassOptions {
    let defaults = LowPassOptions::default();
    LowPassOptions {
        iterations: iterations(record),
        lambda: record.number("lambda").unwrap_or(defaults.lambda),
        mu: record.number("mu").unwrap_or(defaults.mu),
        ..defaults
    }
}

fn bilateral(record: &Record) -> BilateralOptions {
    let given = |option: &str| record.given(option, "a positive finite number, and it has no default");
    BilateralOptions {
        iterations: iterations(record),
        radius: given("radius"),
        sigma_distance: given("sigmaDistance"),
        sigma_value: given("sigmaValue"),
        ..BilateralOptions::default()
    }
}
