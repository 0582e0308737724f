//! The options of the core: each kind is read here, in one place.

mod constraints;
mod epsilon;
mod family;
mod prescribe;
mod record;
mod smoothing;

pub(super) use constraints::{Constraining, from_rule};
pub(super) use epsilon::epsilon_rule;
pub(super) use family::FamilyChoice;
pub(super) use smoothing::{ShortMethod, Smoothing, smoother};

use js_sys::Uint32Array;

use crate::error::OutOfMemory;
use crate::field::{DeltaOptions, DeltaScale, Keep, Threshold};
use crate::wasm::shared::arrays::ids;
use crate::wasm::shared::record::Record;

/// How critical points are told.
pub(super) fn delta(record: &Record) -> DeltaOptions {
    DeltaOptions { rule: record.choice("rule").unwrap_or_default(), ..delta_of_constraints(record) }
}

/// The same for constraints, whose rule for extrema is fixed.
fn delta_of_constraints(record: &Record) -> DeltaOptions {
    let defaults = DeltaOptions::default();
    DeltaOptions {
        delta: record.number("delta").unwrap_or(defaults.delta),
        scale: record.choice("deltaIs").unwrap_or(defaults.scale),
        link: record.choice("link").unwrap_or(defaults.link),
        rule: defaults.rule,
    }
}

/// A threshold, with the option that says what it is measured in.
fn threshold(record: &Record, scale: &str, threshold: f64) -> Threshold {
    match record.choice(scale).unwrap_or_default() {
        DeltaScale::Relative => Threshold::Relative(threshold),
        DeltaScale::Absolute => Threshold::Absolute(threshold),
    }
}

/// Up to which persistence pairs are cancelled.
pub(super) fn cancelled_up_to(record: &Record) -> Threshold {
    threshold(record, "persistenceIs", record.number("persistence").unwrap_or_default())
}

/// What `simplify` is to leave.
pub(super) enum Kept<V> {
    Above(Threshold),
    Extrema(V),
}

/// `keep`, or what is above the threshold.
pub(super) fn kept(record: &Record) -> Kept<Option<Uint32Array>> {
    let above = |record: &Record, value: f64| Kept::Above(threshold(record, "thresholdIs", value));
    if record.has("keep") {
        record.foreign("`keep` says what to keep", &|record| {
            above(record, record.number("threshold").unwrap_or_default());
        });
        return Kept::Extrema(record.object("keep", "a list of vertices"));
    }
    above(record, record.given("threshold", "a number that is not negative, unless `keep` says what to keep"))
}

impl Kept<Option<Uint32Array>> {
    pub(super) fn copied(self) -> Result<Kept<Vec<u32>>, OutOfMemory> {
        Ok(match self {
            Self::Above(threshold) => Kept::Above(threshold),
            Self::Extrema(vertices) => Kept::Extrema(vertices.as_ref().map_or(Ok(Vec::new()), ids)?),
        })
    }
}

impl Kept<Vec<u32>> {
    pub(super) fn keep(&self) -> Keep<'_> {
        match self {
            Self::Above(threshold) => Keep::Above(*threshold),
            Self::Extrema(vertices) => Keep::Extrema(vertices),
        }
    }
}
