//! ε, as a number or by a rule.

use js_sys::Array;
use wasm_bindgen::JsValue;

use crate::error::{OptionError, Result};
use crate::smooth::{EpsilonRule, RuleName};
use crate::wasm::shared::record::{Record, read};

/// What `auto` stands for: the rule that came nearest to the best ε in most cases (benches/README.md).
const AUTO: &str = "auto";
const EXPECTED: &str = "a positive finite number, \"auto\", or an object with a `rule`";

/// ε, or the rule that is to choose it; by the rule for `auto` where there is a default.
pub(super) fn epsilon(record: &Record, has_default: bool) -> (f64, Option<EpsilonRule>) {
    let Some(value) = record.get("epsilon") else {
        if !has_default {
            record.invalid("epsilon", &format!("{EXPECTED}, and it has no default"));
        }
        return (1.0, Some(EpsilonRule::default()));
    };
    match value.as_f64() {
        Some(epsilon) => (epsilon, None),
        None => (1.0, record.taken(epsilon_rule("epsilon", value))),
    }
}

/// What is expected where a rule may stand: for `epsilon` a number, too.
fn expected(place: &str) -> &'static str {
    if place == "epsilon" { EXPECTED } else { "\"auto\", or an object with a `rule`" }
}

/// A rule by its name, with what it needs.
///
/// # Errors
/// Those of options.
pub(in crate::wasm::core) fn epsilon_rule(place: &'static str, value: &JsValue) -> Result<EpsilonRule> {
    if let Some(name) = value.as_string() {
        return match name.as_str() {
            AUTO => Ok(EpsilonRule::default()),
            _ => Err(OptionError::invalid(place, expected(place)).into()),
        };
    }
    if !value.is_object() || Array::is_array(value) {
        return Err(OptionError::invalid(place, expected(place)).into());
    }
    read(place, value, |record| match record.chosen("rule") {
        None => {
            record.decisive();
            EpsilonRule::default()
        }
        Some(RuleName::Gcv) => EpsilonRule::Gcv,
        Some(RuleName::LCurve) => EpsilonRule::LCurve,
        Some(RuleName::Discrepancy) => EpsilonRule::Discrepancy { noise: record.number("noise") },
        Some(RuleName::AtMostCriticalPoints) => {
            let expected = "an integer that is not negative, and it has no default";
            EpsilonRule::AtMostCriticalPoints { count: record.given_integer("count", expected) }
        }
    })
}
