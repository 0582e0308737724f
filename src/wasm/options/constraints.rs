//! Constraints: vertices, or a rule that finds them.

use js_sys::{Reflect, Uint32Array};
use wasm_bindgen::{JsCast, JsValue};

use super::{Options, choose, invalid, read, threshold_of};
use crate::error::{Error, OptionError, Result};
use crate::field::Features;
use crate::smooth::{Constraints, Unconstrained};
use crate::wasm::convert::ids;

/// What they were read to; owns the vertices, which [`Constraints`] borrow.
pub(in crate::wasm) struct ConstraintInput {
    vertices: Vec<u32>,
    /// Nothing for the vertices.
    rule: Option<Features<'static>>,
    stars: bool,
}

impl ConstraintInput {
    /// `src/js` has made arrays of vertices `Uint32Array`s.
    pub(in crate::wasm) fn read(value: &JsValue) -> Result<Self> {
        if let Some(vertices) = value.dyn_ref::<Uint32Array>() {
            return Ok(Self { vertices: ids(vertices)?, rule: None, stars: false });
        }
        if !value.is_object() {
            return Err(invalid("constraints", "vertices, or a rule that finds them").into());
        }
        let options = Self::options(value).map_err(within_constraints)?;
        let rule = options.features().map_err(within_constraints)?;
        let vertices = options.vertices.dyn_ref::<Uint32Array>().map_or_else(|| Ok(Vec::new()), ids)?;
        Ok(Self { vertices, rule, stars: options.stars.unwrap_or(true) })
    }

    fn options(value: &JsValue) -> Result<Options, OptionError> {
        const FROM: [(&str, &[&str]); 4] = [
            ("vertices", &["vertices"]),
            ("criticalPoints", &["delta", "deltaIs", "link"]),
            ("persistence", &["threshold", "thresholdIs"]),
            ("kMeans", &["clusters", "seed"]),
        ];
        let from = Reflect::get(value, &JsValue::from_str("from")).ok().and_then(|from| from.as_string());
        let missing = || invalid("from", "one of \"vertices\", \"criticalPoints\", \"persistence\", \"kMeans\"");
        let names = choose("from", Some(&from.ok_or_else(missing)?), &FROM)?;
        read(value, &[&["from", "stars"], names])
    }

    pub(in crate::wasm) fn constraints(&self, unconstrained: Unconstrained) -> Constraints<'_> {
        let features = self.rule.unwrap_or(Features::Vertices(&self.vertices));
        Constraints { features, stars: self.stars, unconstrained }
    }
}

impl Options {
    /// The rule; nothing for vertices by number.
    fn features(&self) -> Result<Option<Features<'static>>, OptionError> {
        Ok(match self.from.as_deref().unwrap_or_default() {
            "criticalPoints" => Some(Features::CriticalPoints(self.delta()?)),
            "persistence" => {
                let missing = || invalid("threshold", "a number that is not negative, and it has no default");
                let threshold = self.threshold.ok_or_else(missing)?;
                Some(Features::Persistence(threshold_of("thresholdIs", self.threshold_is.as_ref(), threshold)?))
            }
            "kMeans" => {
                let missing = || invalid("clusters", "a positive integer, and it has no default");
                let clusters = self.clusters.ok_or_else(missing)?;
                let seed = u64::from(self.seed.unwrap_or_default());
                Some(Features::KMeans { clusters: clusters as usize, seed })
            }
            _ if self.vertices.is_instance_of::<Uint32Array>() => None,
            _ => return Err(invalid("vertices", "vertices by number")),
        })
    }
}

/// The rule finds its vertices only where they are needed: what is wrong with its numbers is noticed there.
pub(in crate::wasm) fn from_rule(error: Error) -> Error {
    match error {
        Error::Option(OptionError::InvalidOption { option, expected })
            if ["delta", "threshold", "clusters"].contains(&option.as_str()) =>
        {
            within_constraints(OptionError::InvalidOption { option, expected }).into()
        }
        other => other,
    }
}

/// Says where the option stands.
fn within_constraints(error: OptionError) -> OptionError {
    let name = |option: String| format!("constraints.{option}");
    match error {
        OptionError::UnknownOption { option } => OptionError::UnknownOption { option: name(option) },
        OptionError::InvalidOption { option, expected } => {
            OptionError::InvalidOption { option: name(option), expected }
        }
        other => other,
    }
}
