//! ε, as a number or by a rule, and the options of families.

use js_sys::Array;
use wasm_bindgen::JsValue;

use super::Smoothing;
use crate::error::{OptionError, Result};
use crate::smooth::{
    EpsilonRule, FamilyMethod, FamilyOptions, LeastSquaresOptions, Method, MethodName, Operator, RuleName,
};
use crate::support::named::named;
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

/// The methods that have families.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum WithFamily {
    Tikhonov,
    LeastSquares,
}

named! { WithFamily { Tikhonov = "tikhonov", LeastSquares = "leastSquares" } }

/// What a family is made with; owns what its options borrow.
pub(in crate::wasm::core) struct FamilyChoice {
    smoothing: Smoothing,
    range: Option<(f64, f64)>,
    tolerance: Option<f64>,
    factorizations: Option<usize>,
}

impl FamilyChoice {
    pub(in crate::wasm::core) fn read(record: &Record, operator: Operator) -> Self {
        let default = if record.holds("constraints") { WithFamily::LeastSquares } else { WithFamily::Tikhonov };
        let method = match record.choice("method").unwrap_or(default) {
            WithFamily::Tikhonov => MethodName::Tikhonov,
            WithFamily::LeastSquares => MethodName::LeastSquares,
        };
        let smoothing = Smoothing::read_with_default(record, method, operator).with_weights(record);
        record.foreign("the method does not have it", &|record| {
            for other in WithFamily::ALL {
                let other =
                    if *other == WithFamily::Tikhonov { MethodName::Tikhonov } else { MethodName::LeastSquares };
                Smoothing::read_with_default(record, other, operator).with_weights(record);
            }
        });
        if smoothing.rule().is_some() && record.holds("epsilon") {
            record.invalid("epsilon", "a positive finite number: where the family begins");
        }
        Self {
            smoothing,
            range: range(record),
            tolerance: record.number("tolerance"),
            factorizations: record.integer("factorizations").map(|count| count as usize),
        }
    }

    pub(in crate::wasm::core) fn options(&self) -> FamilyOptions<'_> {
        let defaults = FamilyOptions::default();
        let method = match self.smoothing.method() {
            Method::LeastSquares(options) => FamilyMethod::LeastSquares(LeastSquaresOptions { ..options }),
            Method::Tikhonov(options) => FamilyMethod::Tikhonov(options),
            _ => defaults.method,
        };
        FamilyOptions {
            method,
            range: self.range.unwrap_or(defaults.range),
            tolerance: self.tolerance.unwrap_or(defaults.tolerance),
            factorizations: self.factorizations,
        }
    }
}

fn range(record: &Record) -> Option<(f64, f64)> {
    record.read("epsilonRange", "two numbers, the smaller one first", |value| {
        let pair: &Array = Array::is_array(value).then(|| wasm_bindgen::JsCast::unchecked_ref(value))?;
        (pair.length() == 2).then(|| Some((pair.get(0).as_f64()?, pair.get(1).as_f64()?)))?
    })
}
