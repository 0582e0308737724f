//! The options of families.

use js_sys::Array;

use super::Smoothing;
use crate::smooth::{FamilyOptions, MethodName, Operator};
use crate::support::named::named;
use crate::wasm::shared::record::Record;

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

    /// The number of channels.
    pub(in crate::wasm::core) fn channels(&self) -> usize {
        self.options().method.channels()
    }

    pub(in crate::wasm::core) fn options(&self) -> FamilyOptions<'_> {
        let defaults = FamilyOptions::default();
        let method = self.smoothing.method().functional().unwrap_or(defaults.method);
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
