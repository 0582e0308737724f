//! The options of smoothing.

use js_sys::Function;
use wasm_bindgen::{JsCast, JsValue};

use super::{ConstraintInput, Options, choose, inapplicable, invalid, is_absent, read, unsupported};
use crate::error::OptionError;
use crate::smooth::{
    BilateralOptions, Energy, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Metric, Operator, Precision,
    SmootherOptions, SolverChoice, TikhonovOptions, Unconstrained, epsilon_for_wavelength,
};

/// The names that `Smoother` takes.
pub(in crate::wasm) const SMOOTHER: &[&str] = &["weights", "operator", "solver", "precision", "bounds", "onProgress"];
/// The names that its methods take.
pub(in crate::wasm) const TIKHONOV: &[&str] = &["epsilon", "cutoffWavelength", "metric", "massScale", "channels"];
pub(in crate::wasm) const INTERPOLATE: &[&str] = &["constraints", "unconstrained", "energy", "channels"];
pub(in crate::wasm) const LEAST_SQUARES: &[&str] = &["constraints", "unconstrained", "epsilon", "channels"];
pub(in crate::wasm) const LOW_PASS: &[&str] = &["iterations", "lambda", "mu", "channels"];
pub(in crate::wasm) const BILATERAL: &[&str] = &["iterations", "radius", "sigmaDistance", "sigmaValue", "channels"];

/// The methods of `smooth`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::wasm) enum Method {
    Tikhonov,
    Interpolate,
    LeastSquares,
}

impl Method {
    fn names(self) -> &'static [&'static str] {
        match self {
            Self::Tikhonov => TIKHONOV,
            Self::Interpolate => INTERPOLATE,
            Self::LeastSquares => LEAST_SQUARES,
        }
    }
}

/// The options of `smooth`, and the method they ask for.
pub(in crate::wasm) fn read_smooth(value: &JsValue) -> Result<(Options, Method), OptionError> {
    let options = read(value, &[SMOOTHER, TIKHONOV, INTERPOLATE, &["method"]])?;
    let method = match options.method {
        None if is_absent(&options.constraints) => Method::Tikhonov,
        None => Method::LeastSquares,
        Some(_) => choose(
            "method",
            options.method.as_ref(),
            &[
                ("tikhonov", Method::Tikhonov),
                ("interpolate", Method::Interpolate),
                ("leastSquares", Method::LeastSquares),
            ],
        )?,
    };
    // What means nothing for the method is refused, rather than passed over.
    for (name, is_there) in [
        ("constraints", !is_absent(&options.constraints)),
        ("unconstrained", options.unconstrained.is_some()),
        ("energy", options.energy.is_some()),
        ("epsilon", !is_absent(&options.epsilon)),
        ("cutoffWavelength", options.cutoff_wavelength.is_some()),
        ("metric", options.metric.is_some()),
        ("massScale", options.mass_scale.is_some()),
    ] {
        if is_there && !method.names().contains(&name) {
            return Err(inapplicable(name, "the method does not have it"));
        }
    }
    Ok((options, method))
}

impl Options {
    pub(in crate::wasm) fn smoother(&self) -> Result<SmootherOptions, OptionError> {
        let precisions = [("double", Precision::Double), ("single", Precision::Single)];
        let solvers = [
            ("auto", SolverChoice::Auto),
            ("cholesky", SolverChoice::Cholesky),
            ("cg", SolverChoice::ConjugateGradient),
        ];
        Ok(SmootherOptions {
            weights: self.weights()?,
            operator: self.operator()?,
            solver: choose("solver", self.solver.as_ref(), &solvers)?,
            precision: choose("precision", self.precision.as_ref(), &precisions)?,
            bounds: self.bounds.unwrap_or_default(),
        })
    }

    fn operator(&self) -> Result<Operator, OptionError> {
        choose("operator", self.operator.as_ref(), &[("paper", Operator::Paper), ("fem", Operator::Fem)])
    }

    /// The callback, if there is one.
    pub(in crate::wasm) fn progress(&self) -> Result<Option<Function>, OptionError> {
        if is_absent(&self.on_progress) {
            return Ok(None);
        }
        let callback = self.on_progress.dyn_ref::<Function>().cloned();
        callback.map(Some).ok_or_else(|| invalid("onProgress", "a function"))
    }

    fn epsilon(&self, operator: Operator) -> Result<f64, OptionError> {
        if let Some(wavelength) = self.cutoff_wavelength {
            if operator == Operator::Paper {
                return Err(inapplicable("cutoffWavelength", "only the operator `fem` knows lengths"));
            }
            if !is_absent(&self.epsilon) {
                return Err(inapplicable("epsilon", "`cutoffWavelength` says the same"));
            }
            return epsilon_for_wavelength(wavelength);
        }
        if self.epsilon.as_string().as_deref() == Some("auto") {
            return Err(unsupported("epsilon", "auto"));
        }
        let missing = || invalid("epsilon", "a positive finite number, and it has no default");
        self.epsilon.as_f64().ok_or_else(missing)
    }

    /// `operator` is the smoother's: not every option goes with every operator.
    pub(in crate::wasm) fn tikhonov(&self, operator: Operator) -> Result<TikhonovOptions, OptionError> {
        let epsilon = self.epsilon(operator)?;
        let metrics = [("mass", Metric::Mass), ("identity", Metric::Identity), ("lumped", Metric::Lumped)];
        let metric = choose("metric", self.metric.as_ref(), &metrics)?;
        if metric == Metric::Identity && self.mass_scale.is_some() {
            return Err(inapplicable("massScale", "the metric `identity` has no mass matrix"));
        }
        if operator == Operator::Fem {
            for (option, given) in [("metric", self.metric.is_some()), ("massScale", self.mass_scale.is_some())] {
                if given {
                    return Err(inapplicable(option, "the operator `fem` has its own mass matrix"));
                }
            }
        }
        Ok(TikhonovOptions {
            epsilon,
            metric,
            mass_scale: self.mass_scale()?,
            channels: self.channels(),
            ..TikhonovOptions::default()
        })
    }

    pub(in crate::wasm) fn channels(&self) -> usize {
        self.channels.map_or(1, |channels| channels as usize)
    }

    pub(in crate::wasm) fn interpolate<'a>(
        &self,
        input: &'a ConstraintInput,
    ) -> Result<InterpolateOptions<'a>, OptionError> {
        let energies = [("harmonic", Energy::Harmonic), ("biharmonic", Energy::Biharmonic)];
        Ok(InterpolateOptions {
            constraints: input.constraints(self.unconstrained()?),
            energy: choose("energy", self.energy.as_ref(), &energies)?,
            channels: self.channels(),
            ..InterpolateOptions::default()
        })
    }

    pub(in crate::wasm) fn least_squares<'a>(
        &self,
        input: &'a ConstraintInput,
        weights: Option<&'a [f64]>,
    ) -> Result<LeastSquaresOptions<'a>, OptionError> {
        Ok(LeastSquaresOptions {
            constraints: input.constraints(self.unconstrained()?),
            epsilon: self.epsilon(Operator::Paper)?,
            weights,
            channels: self.channels(),
            ..LeastSquaresOptions::default()
        })
    }

    fn unconstrained(&self) -> Result<Unconstrained, OptionError> {
        let choices = [("error", Unconstrained::Error), ("keep", Unconstrained::Keep), ("mean", Unconstrained::Mean)];
        choose("unconstrained", self.unconstrained.as_ref(), &choices)
    }

    fn iterations(&self) -> Result<usize, OptionError> {
        let missing = || invalid("iterations", "an integer that is not negative, and it has no default");
        self.iterations.map(|iterations| iterations as usize).ok_or_else(missing)
    }

    pub(in crate::wasm) fn low_pass(&self) -> Result<LowPassOptions, OptionError> {
        let defaults = LowPassOptions::default();
        Ok(LowPassOptions {
            iterations: self.iterations()?,
            lambda: self.lambda.unwrap_or(defaults.lambda),
            mu: self.mu.unwrap_or(defaults.mu),
            channels: self.channels(),
            ..defaults
        })
    }

    pub(in crate::wasm) fn bilateral(&self) -> Result<BilateralOptions, OptionError> {
        let given = |option: &str, value: Option<f64>| {
            value.ok_or_else(|| invalid(option, "a positive finite number, and it has no default"))
        };
        Ok(BilateralOptions {
            iterations: self.iterations()?,
            radius: given("radius", self.radius)?,
            sigma_distance: given("sigmaDistance", self.sigma_distance)?,
            sigma_value: given("sigmaValue", self.sigma_value)?,
            channels: self.channels(),
            ..BilateralOptions::default()
        })
    }
}
