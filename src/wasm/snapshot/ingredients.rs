//! Level sets, critical points and lines of the Morse complex: to be found, or as they were found before.

use js_sys::{Float64Array, Int8Array};
use wasm_bindgen::{JsCast, JsValue};

use crate::error::{OptionError, OutOfMemory, Result};
use crate::field::{CriticalKind, CriticalPoint, LevelSets, MorseComplex, Threshold};
use crate::render::{Glyphs, Levels, Separatrices};
use crate::wasm::shared::arrays::{bytes, copied, floats, ids};
use crate::wasm::shared::record::{Record, read};

/// [`Levels`] that own what they hold.
pub(super) enum LevelInput {
    Count(u32),
    At(Vec<f64>),
    Traced(LevelSets),
}

impl LevelInput {
    /// `src/js` has made lists of numbers `Float64Array`s.
    pub(super) fn read(value: &JsValue) -> Result<Self> {
        if let Some(levels) = value.dyn_ref::<Float64Array>() {
            return Ok(Self::At(floats(levels)?));
        }
        read("levels", value, |record| {
            if !record.holds("points") || record.holds("count") {
                let expected = "a list of numbers, { count } or what `TriMesh.levelSets` returns";
                if !record.has("count") {
                    record.refuse(OptionError::invalid("levels", expected));
                }
                return Self::Count(record.integer_of("count", "an integer from 0 to 10000").unwrap_or_default());
            }
            record.ignore_others();
            Self::Traced(LevelSets {
                points: copy(record, "points", floats),
                offsets: copy(record, "offsets", ids),
                levels: copy(record, "levels", floats),
                closed: copy(record, "closed", bytes).into_iter().map(|closed| closed != 0).collect(),
                edges: Vec::new(),
                parameters: Vec::new(),
            })
        })
    }

    pub(super) fn levels(&self) -> Levels<'_> {
        match self {
            Self::Count(count) => Levels::Count(*count),
            Self::At(levels) => Levels::At(levels),
            Self::Traced(sets) => Levels::Traced(sets),
        }
    }
}

/// [`Glyphs`] that own what they hold.
pub(super) enum PointInput {
    All(bool),
    These(Vec<CriticalPoint>),
}

impl PointInput {
    pub(super) fn read(value: &JsValue) -> Result<Self> {
        if let Some(all) = value.as_bool() {
            return Ok(Self::All(all));
        }
        read("criticalPoints", value, |record| {
            record.ignore_others();
            let (vertices, kinds) = (copy(record, "vertices", ids), kinds(record));
            if vertices.len() != kinds.len() {
                record.invalid("kinds", "one kind for each vertex");
            }
            // Pictures show neither multiplicities nor what lies on the boundary.
            let point = |(vertex, kind)| CriticalPoint { vertex, kind, multiplicity: 1, on_boundary: false };
            Self::These(vertices.into_iter().zip(kinds).map(point).collect())
        })
    }

    pub(super) fn glyphs(&self) -> Glyphs<'_> {
        match self {
            Self::All(true) => Glyphs::Found,
            Self::All(false) => Glyphs::None,
            Self::These(points) => Glyphs::Points(points),
        }
    }
}

/// [`Separatrices`] that own what they hold.
pub(super) enum ComplexInput {
    None,
    Above(f64),
    Traced(MorseComplex),
}

impl ComplexInput {
    pub(super) fn read(value: &JsValue) -> Result<Self> {
        if let Some(wanted) = value.as_bool() {
            return Ok(if wanted { Self::Above(0.0) } else { Self::None });
        }
        read("morseComplex", value, |record| {
            if !record.holds("vertices") || record.holds("persistence") {
                let expected = "true, false, { persistence } or what `TriMesh.morseComplex` returns";
                if !record.has("persistence") {
                    record.refuse(OptionError::invalid("morseComplex", expected));
                }
                return Self::Above(record.number("persistence").unwrap_or_default());
            }
            record.ignore_others();
            Self::Traced(MorseComplex {
                vertices: copy(record, "vertices", ids),
                offsets: copy(record, "offsets", ids),
                saddles: Vec::new(),
                extrema: Vec::new(),
                kinds: kinds(record),
            })
        })
    }

    pub(super) fn separatrices(&self) -> Separatrices<'_> {
        match self {
            Self::None => Separatrices::None,
            Self::Above(persistence) => Separatrices::Above(Threshold::Relative(*persistence)),
            Self::Traced(complex) => Separatrices::Traced(complex),
        }
    }
}

/// A copy of the typed array of that name.
fn copy<A: JsCast + Clone, T>(record: &Record, name: &str, copy: fn(&A) -> Result<Vec<T>, OutOfMemory>) -> Vec<T> {
    let expected = "the array of that name which `TriMesh` gives";
    if !record.has(name) {
        record.invalid(name, expected);
    }
    let array = record.object::<A>(name, expected);
    array.and_then(|array| record.taken(copy(&array))).unwrap_or_default()
}

fn kinds(record: &Record) -> Vec<CriticalKind> {
    let kind = |sign| match sign {
        -1 => CriticalKind::Minimum,
        0 => CriticalKind::Saddle,
        1 => CriticalKind::Maximum,
        _ => {
            record.invalid("kinds", "−1 for minima, 0 for saddles, 1 for maxima");
            CriticalKind::Saddle
        }
    };
    let signs = copy(record, "kinds", |array: &Int8Array| copied(array.length(), |copy| array.copy_to(copy)));
    signs.into_iter().map(kind).collect()
}
