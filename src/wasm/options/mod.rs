//! Option objects: read through serde, with unknown and malformed options refused by name.

mod constraints;
mod smoothing;

pub(super) use super::convert::is_absent;
pub(super) use constraints::{ConstraintInput, from_rule};
pub(super) use smoothing::{BILATERAL, INTERPOLATE, LEAST_SQUARES, LOW_PASS, Method, SMOOTHER, TIKHONOV, read_smooth};

use js_sys::{Array, Object};
use wasm_bindgen::{JsCast, JsValue};

use super::error::set;
use crate::error::OptionError;
use crate::field::{DeltaOptions, DeltaScale, ExtremumRule, Keep, LinkReading, PathStyle, Threshold};
use crate::operators::{LaplacianWeights, MassScale};

/// All options of all functions: each function names those it takes. One type of few kinds of fields keeps the module small,
/// because serde writes the code for every type anew.
#[derive(Default, serde::Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Options {
    pub(super) weld: Option<bool>,
    pub(super) format: Option<String>,
    pub(super) file_name: Option<String>,
    pub(super) binary: Option<bool>,
    pub(super) count: Option<u32>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    pub(super) saddles: JsValue,
    pub(super) offset: Option<f64>,
    kind: Option<String>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    pub(super) column: JsValue,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    pub(super) fields: JsValue,
    threshold: Option<f64>,
    threshold_is: Option<String>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    pub(super) keep: JsValue,
    persistence: Option<f64>,
    persistence_is: Option<String>,
    paths: Option<String>,
    delta: Option<f64>,
    delta_is: Option<String>,
    link: Option<String>,
    rule: Option<String>,
    weights: Option<String>,
    operator: Option<String>,
    solver: Option<String>,
    precision: Option<String>,
    bounds: Option<bool>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    on_progress: JsValue,
    method: Option<String>,
    metric: Option<String>,
    mass_scale: Option<String>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    epsilon: JsValue,
    cutoff_wavelength: Option<f64>,
    channels: Option<u32>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    pub(super) constraints: JsValue,
    from: Option<String>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    vertices: JsValue,
    clusters: Option<u32>,
    seed: Option<u32>,
    stars: Option<bool>,
    unconstrained: Option<String>,
    energy: Option<String>,
    iterations: Option<u32>,
    lambda: Option<f64>,
    mu: Option<f64>,
    radius: Option<f64>,
    sigma_distance: Option<f64>,
    sigma_value: Option<f64>,
}

/// Reads an options object that may have the names in `known`. `undefined` and `null` give the defaults.
pub(super) fn read(value: &JsValue, known: &[&[&str]]) -> Result<Options, OptionError> {
    if is_absent(value) {
        return Ok(Options::default());
    }
    if !value.is_object() || Array::is_array(value) || value.is_function() {
        return Err(not_an_object());
    }
    for entry in Object::entries(value.unchecked_ref()).iter() {
        let entry: Array = entry.unchecked_into();
        let option = entry.get(0).as_string().unwrap_or_default();
        if !known.iter().any(|names| names.contains(&option.as_str())) {
            return Err(OptionError::UnknownOption { option });
        }
        // One at a time, because the message of the whole object would not say which option is wrong.
        let single = Object::new();
        set(&single, &option, &entry.get(1));
        if serde_wasm_bindgen::from_value::<Options>(single.into()).is_err() {
            return Err(invalid(&option, expected(&option)));
        }
    }
    serde_wasm_bindgen::from_value(value.clone()).map_err(|_| not_an_object())
}

fn not_an_object() -> OptionError {
    OptionError::InvalidArgument { argument: "options".to_owned(), expected: "an object".to_owned() }
}

/// What kind of value an option takes, in the words of JavaScript rather than of serde.
fn expected(option: &str) -> &'static str {
    match option {
        "delta" | "offset" | "threshold" | "persistence" | "cutoffWavelength" | "lambda" | "mu" | "radius"
        | "sigmaDistance" | "sigmaValue" => "a number",
        "channels" | "count" | "clusters" | "seed" | "iterations" => "an integer from 0 to 4294967295",
        "weights" => "the name of weights of the Laplacian; weights of constraints are for `Smoother.leastSquares`",
        "weld" | "binary" | "bounds" | "stars" => "true or false",
        _ => "a name in quotes",
    }
}

pub(super) fn invalid(option: &str, expected: &str) -> OptionError {
    OptionError::invalid(option, expected)
}

fn unsupported(option: &str, value: &str) -> OptionError {
    OptionError::UnsupportedOption { option: option.to_owned(), value: value.to_owned() }
}

/// The value of an option that takes one of several names; the first is the default.
fn choose<T: Copy>(option: &str, name: Option<&String>, choices: &[(&str, T)]) -> Result<T, OptionError> {
    let wanted = name.map_or(choices[0].0, String::as_str);
    let found = choices.iter().find(|(name, _)| *name == wanted);
    found.map(|&(_, choice)| choice).ok_or_else(|| {
        let names: Vec<&str> = choices.iter().map(|&(name, _)| name).collect();
        invalid(option, &format!("one of \"{}\"", names.join("\", \"")))
    })
}

/// A threshold with what it is measured in.
fn threshold_of(option: &str, scale: Option<&String>, threshold: f64) -> Result<Threshold, OptionError> {
    let relative = choose(option, scale, &[("relative", true), ("absolute", false)])?;
    Ok(if relative { Threshold::Relative(threshold) } else { Threshold::Absolute(threshold) })
}

impl Options {
    pub(super) fn delta(&self) -> Result<DeltaOptions, OptionError> {
        let scales = [("relative", DeltaScale::Relative), ("absolute", DeltaScale::Absolute)];
        let links = [("consecutive", LinkReading::Consecutive), ("skip", LinkReading::Skip)];
        let rules = [("strict", ExtremumRule::Strict), ("literal", ExtremumRule::Literal)];
        Ok(DeltaOptions {
            delta: self.delta.unwrap_or_default(),
            scale: choose("deltaIs", self.delta_is.as_ref(), &scales)?,
            link: choose("link", self.link.as_ref(), &links)?,
            rule: choose("rule", self.rule.as_ref(), &rules)?,
        })
    }

    /// What `simplify` is to leave: `keep`, or what is above the threshold.
    pub(super) fn extrema<'a>(&self, keep: Option<&'a [u32]>) -> Result<Keep<'a>, OptionError> {
        let Some(vertices) = keep else {
            let missing = || invalid("threshold", "a number that is not negative, unless `keep` says what to keep");
            let threshold = self.threshold.ok_or_else(missing)?;
            return Ok(Keep::Above(threshold_of("thresholdIs", self.threshold_is.as_ref(), threshold)?));
        };
        for (option, is_there) in
            [("threshold", self.threshold.is_some()), ("thresholdIs", self.threshold_is.is_some())]
        {
            if is_there {
                return Err(inapplicable(option, "`keep` says what to keep"));
            }
        }
        Ok(Keep::Extrema(vertices))
    }

    /// Up to which persistence pairs are cancelled.
    pub(super) fn persistence(&self) -> Result<Threshold, OptionError> {
        threshold_of("persistenceIs", self.persistence_is.as_ref(), self.persistence.unwrap_or_default())
    }

    pub(super) fn paths(&self) -> Result<PathStyle, OptionError> {
        choose("paths", self.paths.as_ref(), &[("whole", PathStyle::Whole), ("merged", PathStyle::Merged)])
    }

    pub(super) fn weights(&self) -> Result<LaplacianWeights, OptionError> {
        let choices = [
            ("cotangent", LaplacianWeights::Cotangent),
            ("meanValue", LaplacianWeights::MeanValue),
            ("normalizedCotangent", LaplacianWeights::NormalizedCotangent),
            ("uniform", LaplacianWeights::Uniform),
            ("intrinsicDelaunay", LaplacianWeights::IntrinsicDelaunay),
        ];
        choose("weights", self.weights.as_ref(), &choices)
    }

    /// Whether the mass matrix is the lumped one.
    pub(super) fn is_lumped(&self) -> Result<bool, OptionError> {
        choose("kind", self.kind.as_ref(), &[("galerkin", false), ("lumped", true)])
    }

    pub(super) fn mass_scale(&self) -> Result<MassScale, OptionError> {
        let scales = [("meanOne", MassScale::MeanOne), ("raw", MassScale::Raw)];
        choose("massScale", self.mass_scale.as_ref(), &scales)
    }
}

pub(super) fn inapplicable(option: &str, reason: &str) -> OptionError {
    OptionError::InapplicableOption { option: option.to_owned(), reason: reason.to_owned() }
}
