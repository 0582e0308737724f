//! Option objects: read through serde, with unknown and malformed options refused by name.

use js_sys::{Array, Object};
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};
use wasm_bindgen::{JsCast, JsValue};

use super::error::set;
use crate::error::OptionError;
use crate::field::{DeltaOptions, DeltaScale, ExtremumRule, LinkReading};
use crate::operators::{LaplacianWeights, MassScale};
use crate::smooth::{Metric, SmootherOptions, SolverChoice, TikhonovOptions};

/// Reads an options object. `undefined` and `null` give the defaults.
pub(super) fn read<T: DeserializeOwned + Default>(value: &JsValue) -> Result<T, OptionError> {
    if value.is_undefined() || value.is_null() {
        return Ok(T::default());
    }
    if !value.is_object() || Array::is_array(value) || value.is_function() {
        let expected = "an object".to_owned();
        return Err(OptionError::InvalidArgument { argument: "options".to_owned(), expected });
    }
    let object: &Object = value.unchecked_ref();
    let known = field_names::<T>();
    for entry in Object::entries(object).iter() {
        let entry: Array = entry.unchecked_into();
        let option = entry.get(0).as_string().unwrap_or_default();
        if !known.contains(&option.as_str()) {
            return Err(OptionError::UnknownOption { option });
        }
        // One at a time, because the message of the whole object would not say which option is wrong.
        let single = Object::new();
        set(&single, &option, &entry.get(1));
        if let Err(problem) = serde_wasm_bindgen::from_value::<T>(single.into()) {
            return Err(OptionError::InvalidOption { option, expected: expected(&problem.to_string()) });
        }
    }
    serde_wasm_bindgen::from_value(value.clone()).map_err(|problem| OptionError::InvalidArgument {
        argument: "options".to_owned(),
        expected: problem.to_string(),
    })
}

/// From "unknown variant `a`, expected `b` or `c`" and the like the part that helps.
fn expected(message: &str) -> String {
    message.rsplit_once("expected ").map_or(message, |(_, expected)| expected).to_owned()
}

/// The names that a struct deserialises from, as serde knows them: one list for both.
fn field_names<T: DeserializeOwned>() -> &'static [&'static str] {
    struct Names<'a>(&'a mut &'static [&'static str]);
    impl<'de> Deserializer<'de> for Names<'_> {
        type Error = serde::de::value::Error;

        fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Self::Error> {
            Err(Self::Error::custom("only structs have names"))
        }

        fn deserialize_struct<V: Visitor<'de>>(
            self,
            _: &'static str,
            fields: &'static [&'static str],
            _: V,
        ) -> Result<V::Value, Self::Error> {
            *self.0 = fields;
            Err(Self::Error::custom("the names are all that was wanted"))
        }

        serde::forward_to_deserialize_any! {
            bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
            newtype_struct seq tuple tuple_struct map enum identifier ignored_any
        }
    }
    let mut names: &'static [&'static str] = &[];
    let _ = T::deserialize(Names(&mut names));
    names
}

#[derive(Default, serde::Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct MeshInput {
    pub(super) weld: Option<bool>,
}

#[derive(Default, serde::Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct DeltaInput {
    delta: Option<f64>,
    delta_is: Option<DeltaScale>,
    link: Option<LinkReading>,
    rule: Option<ExtremumRule>,
}

impl DeltaInput {
    pub(super) fn options(&self) -> DeltaOptions {
        DeltaOptions {
            delta: self.delta.unwrap_or_default(),
            scale: self.delta_is.unwrap_or_default(),
            link: self.link.unwrap_or_default(),
            rule: self.rule.unwrap_or_default(),
        }
    }
}

/// Weights by the names of the types, those of later versions included, so that they are refused as such.
#[derive(Clone, Copy, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) enum WeightsInput {
    Cotangent,
    MeanValue,
    NormalizedCotangent,
    Uniform,
    IntrinsicDelaunay,
}

impl WeightsInput {
    pub(super) fn weights(this: Option<Self>) -> Result<LaplacianWeights, OptionError> {
        Ok(match this {
            None | Some(Self::Cotangent) => LaplacianWeights::Cotangent,
            Some(Self::MeanValue) => LaplacianWeights::MeanValue,
            Some(Self::NormalizedCotangent) => LaplacianWeights::NormalizedCotangent,
            Some(Self::Uniform) => LaplacianWeights::Uniform,
            Some(Self::IntrinsicDelaunay) => return Err(unsupported("weights: intrinsicDelaunay")),
        })
    }
}

#[derive(Default, serde::Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct WeightsOption {
    pub(super) weights: Option<WeightsInput>,
}

#[derive(Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) enum MassKind {
    Galerkin,
    Lumped,
}

#[derive(Default, serde::Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct MassInput {
    pub(super) kind: Option<MassKind>,
    pub(super) mass_scale: Option<MassScale>,
}

#[derive(Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
enum Operator {
    Paper,
    Fem,
}

#[derive(Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
enum Precision {
    Double,
    Single,
}

#[derive(Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
enum Method {
    Tikhonov,
    Interpolate,
    LeastSquares,
}

/// Declares an options struct with the smoother's options and others, because serde's `flatten` would hide the names.
macro_rules! with_smoother_options {
    ($name:ident { $($(#[$meta:meta])* $field:ident: $ty:ty),* $(,)? }) => {
        #[derive(Default, serde::Deserialize)]
        #[serde(default, rename_all = "camelCase")]
        pub(super) struct $name {
            weights: Option<WeightsInput>,
            operator: Option<Operator>,
            solver: Option<SolverChoice>,
            precision: Option<Precision>,
            bounds: Option<bool>,
            #[serde(with = "serde_wasm_bindgen::preserve")]
            on_progress: JsValue,
            $($(#[$meta])* $field: $ty,)*
        }

        impl $name {
            pub(super) fn smoother(&self) -> Result<SmootherOptions, OptionError> {
                if self.operator == Some(Operator::Fem) {
                    return Err(unsupported("operator: fem"));
                }
                if self.precision == Some(Precision::Single) {
                    return Err(unsupported("precision: single"));
                }
                if self.bounds == Some(true) {
                    return Err(unsupported("bounds: true"));
                }
                Ok(SmootherOptions {
                    weights: WeightsInput::weights(self.weights)?,
                    solver: self.solver.unwrap_or_default(),
                })
            }

            /// The callback, if there is one.
            pub(super) fn progress(&self) -> Result<Option<js_sys::Function>, OptionError> {
                if self.on_progress.is_undefined() || self.on_progress.is_null() {
                    return Ok(None);
                }
                self.on_progress.dyn_ref::<js_sys::Function>().cloned().map(Some).ok_or_else(|| {
                    OptionError::InvalidOption { option: "onProgress".to_owned(), expected: "a function".to_owned() }
                })
            }
        }
    };
}

with_smoother_options!(SmootherInput {});
with_smoother_options!(SmoothInput {
    method: Option<Method>,
    metric: Option<Metric>,
    mass_scale: Option<MassScale>,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    epsilon: JsValue,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    constraints: JsValue,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    energy: JsValue,
});

impl SmoothInput {
    pub(super) fn tikhonov(&self) -> Result<TikhonovOptions, OptionError> {
        if matches!(self.method, Some(Method::Interpolate | Method::LeastSquares)) {
            return Err(unsupported("method: interpolate | leastSquares"));
        }
        for (name, value) in [("constraints", &self.constraints), ("energy", &self.energy)] {
            if !(value.is_undefined() || value.is_null()) {
                return Err(unsupported(name));
            }
        }
        let epsilon = match self.epsilon.as_f64() {
            None if self.epsilon.as_string().as_deref() == Some("auto") => return Err(unsupported("epsilon: auto")),
            epsilon => epsilon,
        };
        tikhonov(epsilon, self.metric, self.mass_scale, None)
    }
}

#[derive(Default, serde::Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct TikhonovInput {
    epsilon: Option<f64>,
    cutoff_wavelength: Option<f64>,
    metric: Option<Metric>,
    mass_scale: Option<MassScale>,
    channels: Option<u32>,
}

impl TikhonovInput {
    pub(super) fn options(&self) -> Result<TikhonovOptions, OptionError> {
        if self.cutoff_wavelength.is_some() {
            return Err(unsupported("cutoffWavelength"));
        }
        tikhonov(self.epsilon, self.metric, self.mass_scale, self.channels)
    }
}

fn tikhonov(
    epsilon: Option<f64>,
    metric: Option<Metric>,
    mass_scale: Option<MassScale>,
    channels: Option<u32>,
) -> Result<TikhonovOptions, OptionError> {
    let Some(epsilon) = epsilon else {
        let expected = "a positive finite number, and it has no default".to_owned();
        return Err(OptionError::InvalidOption { option: "epsilon".to_owned(), expected });
    };
    if metric == Some(Metric::Identity) && mass_scale.is_some() {
        let reason = "the metric `identity` has no mass matrix".to_owned();
        return Err(OptionError::InapplicableOption { option: "massScale".to_owned(), reason });
    }
    Ok(TikhonovOptions {
        epsilon,
        metric: metric.unwrap_or_default(),
        mass_scale: mass_scale.unwrap_or_default(),
        channels: channels.map_or(1, |channels| channels as usize),
    })
}

fn unsupported(option: &str) -> OptionError {
    OptionError::UnsupportedOption { option: option.to_owned() }
}
