//! The options of prescribed extrema.

use js_sys::{Array, Uint32Array};
use wasm_bindgen::{JsCast, JsValue};

use super::threshold;
use crate::error::{OptionError, Result};
use crate::field::Threshold;
use crate::smooth::{Extrema, Functional, Method, PersistenceOf, PrescribeOptions};
use crate::support::named::named;
use crate::wasm::shared::arrays::ids;
use crate::wasm::shared::record::{Record, read};

/// What a field with prescribed extrema is asked for with, but for its functional; owns what its options borrow.
pub(in crate::wasm::core) struct Prescribing {
    extrema: Choice,
    options: PrescribeOptions<'static>,
}

/// The chosen extrema; owns the vertices, which [`Extrema`] borrow.
enum Choice {
    OfInput(Vec<u32>),
    Named([Vec<u32>; 2]),
    Rule(Extrema<'static>),
}

/// Where extrema come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum From {
    Persistence,
}

named! { From { Persistence = "persistence" } }

const EXPECTED: &str = "vertices, `{ minima, maxima }`, or a rule that finds them";
const GIVEN_COUNT: &str = "an integer that is not negative, and it has no default";

impl Prescribing {
    pub(super) fn read(record: &Record) -> Self {
        let defaults = PrescribeOptions::default();
        let extrema = record.part("extrema", Choice::read).unwrap_or(Choice::Rule(defaults.extrema));
        let options = PrescribeOptions {
            complete: record.boolean("complete").unwrap_or(defaults.complete),
            values: record.choice("values").unwrap_or(defaults.values),
            margin: record.number("margin").unwrap_or(defaults.margin),
            prominence: record.number("prominence"),
            range: record.choice("range").unwrap_or(defaults.range),
            representatives: record.integer("representatives").map_or(1, |count| count as usize),
            again: record.boolean("again").unwrap_or(defaults.again),
            preview: record.boolean("preview").unwrap_or(defaults.preview),
            ..defaults
        };
        if options.preview && record.has("margin") {
            record.inapplicable("margin", "a preview has no margin");
        }
        Self { extrema, options }
    }

    pub(super) fn method<'a>(&'a self, functional: Functional<'a>) -> Method<'a> {
        let extrema = match &self.extrema {
            Choice::OfInput(vertices) => Extrema::OfInput(vertices),
            Choice::Named([minima, maxima]) => Extrema::Named { minima, maxima },
            Choice::Rule(rule) => *rule,
        };
        Method::Prescribe(PrescribeOptions { functional, extrema, ..self.options })
    }
}

impl Choice {
    /// `src/js` has made arrays of vertices `Uint32Array`s.
    fn read(value: &JsValue) -> Result<Self> {
        if let Some(vertices) = value.dyn_ref::<Uint32Array>() {
            return Ok(Self::OfInput(ids(vertices)?));
        }
        if !value.is_object() || Array::is_array(value) {
            return Err(OptionError::invalid("extrema", EXPECTED).into());
        }
        let chosen = read("extrema", value, |record| {
            if !record.has("from") {
                let vertices = ["minima", "maxima"].map(|name| {
                    let expected = "a list of vertices, and it has no default";
                    if !record.has(name) {
                        record.invalid(name, expected);
                    }
                    record.object::<Uint32Array>(name, expected)
                });
                return Err(vertices);
            }
            if record.choice::<From>("from").is_none() {
                record.decisive();
            }
            Ok(rule(record))
        })?;
        Ok(match chosen {
            Ok(rule) => Self::Rule(rule),
            Err([minima, maxima]) => {
                let copied = |list: Option<Uint32Array>| list.as_ref().map_or(Ok(Vec::new()), ids);
                Self::Named([copied(minima)?, copied(maxima)?])
            }
        })
    }
}

/// Those above a threshold, or so many.
fn rule(record: &Record) -> Extrema<'static> {
    let of: PersistenceOf = record.choice("of").unwrap_or_default();
    let above = |record: &Record, value: f64| -> Threshold { threshold(record, "thresholdIs", value) };
    if record.has("minima") || record.has("maxima") {
        record.foreign("`minima` and `maxima` say how many", &|record| {
            above(record, record.number("threshold").unwrap_or_default());
        });
        let [minima, maxima] = ["minima", "maxima"].map(|name| record.given_integer(name, GIVEN_COUNT));
        return Extrema::Most { minima, maxima, of };
    }
    let expected = "a number that is not negative, unless `minima` and `maxima` say how many";
    Extrema::Above { threshold: above(record, record.given("threshold", expected)), of }
}
