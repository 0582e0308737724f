//! Constraints: vertices, or a rule that finds them.

use js_sys::{Array, Uint32Array};
use wasm_bindgen::{JsCast, JsValue};

use super::{delta_of_constraints, threshold};
use crate::error::{Error, OptionError, Result};
use crate::field::Features;
use crate::smooth::{Constraints, Unconstrained};
use crate::support::named::named;
use crate::wasm::shared::arrays::ids;
use crate::wasm::shared::record::{Record, read};

/// What constraints were read to; owns the vertices, which [`Constraints`] borrow.
#[derive(Default)]
pub(in crate::wasm::core) struct Constraining {
    vertices: Vec<u32>,
    /// Nothing for the vertices.
    rule: Option<Features<'static>>,
    stars: bool,
}

/// Where constraints come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum From {
    Vertices,
    CriticalPoints,
    Persistence,
    KMeans,
}

named! { From {
    Vertices = "vertices", CriticalPoints = "criticalPoints", Persistence = "persistence", KMeans = "kMeans",
} }

impl Constraining {
    /// What the option takes.
    pub(super) const EXPECTED: &str = "vertices, or a rule that finds them";

    /// `src/js` has made arrays of vertices `Uint32Array`s.
    pub(in crate::wasm::core) fn read(value: &JsValue) -> Result<Self> {
        if let Some(vertices) = value.dyn_ref::<Uint32Array>() {
            return Ok(Self { vertices: ids(vertices)?, rule: None, stars: false });
        }
        if !value.is_object() || Array::is_array(value) {
            return Err(OptionError::invalid("constraints", Self::EXPECTED).into());
        }
        let (rule, stars, vertices) = read("constraints", value, |record| {
            let Some(from) = record.chosen("from") else {
                record.decisive();
                return (None, true, None);
            };
            let vertices = if from == From::Vertices { vertices_of(record) } else { None };
            (rule(record, from), record.boolean("stars").unwrap_or(true), vertices)
        })?;
        let vertices = vertices.as_ref().map_or(Ok(Vec::new()), ids)?;
        Ok(Self { vertices, rule, stars })
    }

    pub(in crate::wasm::core) fn constraints(&self, unconstrained: Unconstrained) -> Constraints<'_> {
        let features = self.rule.unwrap_or(Features::Vertices(&self.vertices));
        Constraints { features, stars: self.stars, unconstrained }
    }
}

fn vertices_of(record: &Record) -> Option<Uint32Array> {
    let expected = "vertices by number";
    if !record.has("vertices") {
        record.invalid("vertices", expected);
    }
    record.object("vertices", expected)
}

/// The rule; nothing for vertices by number.
fn rule(record: &Record, from: From) -> Option<Features<'static>> {
    match from {
        From::Vertices => None,
        From::CriticalPoints => Some(Features::CriticalPoints(delta_of_constraints(record))),
        From::Persistence => {
            let value = record.given("threshold", "a number that is not negative, and it has no default");
            Some(Features::Persistence(threshold(record, "thresholdIs", value)))
        }
        From::KMeans => {
            let clusters = record.given_integer("clusters", "a positive integer, and it has no default");
            let seed = u64::from(record.integer("seed").unwrap_or_default());
            Some(Features::KMeans { clusters, seed })
        }
    }
}

/// The rule finds its vertices only where they are needed: what is wrong with its numbers is noticed there.
pub(in crate::wasm::core) fn from_rule(error: Error) -> Error {
    match error {
        Error::Option(OptionError::InvalidOption { option, expected })
            if ["delta", "threshold", "clusters"].contains(&option.as_str()) =>
        {
            OptionError::InvalidOption { option: format!("constraints.{option}"), expected }.into()
        }
        other => other,
    }
}
