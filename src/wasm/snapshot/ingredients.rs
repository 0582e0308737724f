//! Level sets, critical points and lines of the Morse complex: to be found, or as they were found before.

use js_sys::{Float64Array, Int8Array, Uint8Array, Uint32Array};
use wasm_bindgen::{JsCast, JsValue};

use super::record::Record;
use crate::error::{Error, OptionError, Result};
use crate::field::{CriticalKind, CriticalPoint, LevelSets, MorseComplex, Threshold};
use crate::render::{Glyphs, Levels, Separatrices};
use crate::wasm::convert::{bytes, copied, floats, ids};

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
        let record = Record::new("levels", value)?;
        if record.get("points").is_none() || record.get("count").is_some() {
            record.only(&[&["count"]])?;
            let expected = "a list of numbers, { count } or what `TriMesh.levelSets` returns";
            let count = record.integer("count", "an integer from 0 to 10000")?;
            return Ok(Self::Count(count.ok_or_else(|| OptionError::invalid("levels", expected))?));
        }
        let points = floats(array::<Float64Array>(&record, "points")?)?;
        let offsets = ids(array::<Uint32Array>(&record, "offsets")?)?;
        let levels = floats(array::<Float64Array>(&record, "levels")?)?;
        let closed: Vec<bool> =
            bytes(array::<Uint8Array>(&record, "closed")?)?.into_iter().map(|closed| closed != 0).collect();
        Ok(Self::Traced(LevelSets { points, offsets, levels, closed, edges: Vec::new(), parameters: Vec::new() }))
    }

    pub(super) fn levels(&self) -> Levels<'_> {
        match self {
            Self::Count(count) => Levels::Count(*count),
            Self::At(levels) => Levels::At(levels),
            Self::Traced(sets) => Levels::Traced(sets),
        }
    }
}

/// [`Glyphs`], likewise.
pub(super) enum PointInput {
    All(bool),
    These(Vec<CriticalPoint>),
}

impl PointInput {
    pub(super) fn read(value: &JsValue) -> Result<Self> {
        if let Some(all) = value.as_bool() {
            return Ok(Self::All(all));
        }
        let record = Record::new("criticalPoints", value)?;
        let vertices = ids(array::<Uint32Array>(&record, "vertices")?)?;
        let kinds = kinds(&record)?;
        if vertices.len() != kinds.len() {
            return Err(record.invalid("kinds", "one kind for each vertex").into());
        }
        // Pictures show neither multiplicities nor what lies on the boundary.
        let point = |(vertex, kind)| CriticalPoint { vertex, kind, multiplicity: 1, on_boundary: false };
        Ok(Self::These(vertices.into_iter().zip(kinds).map(point).collect()))
    }

    pub(super) fn glyphs(&self) -> Glyphs<'_> {
        match self {
            Self::All(true) => Glyphs::Found,
            Self::All(false) => Glyphs::None,
            Self::These(points) => Glyphs::Points(points),
        }
    }
}

/// [`Separatrices`], likewise.
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
        let record = Record::new("morseComplex", value)?;
        if record.get("vertices").is_none() || record.get("persistence").is_some() {
            record.only(&[&["persistence"]])?;
            let expected = "true, false, { persistence } or what `TriMesh.morseComplex` returns";
            return Ok(Self::Above(
                record.number("persistence")?.ok_or_else(|| OptionError::invalid("morseComplex", expected))?,
            ));
        }
        let vertices = ids(array::<Uint32Array>(&record, "vertices")?)?;
        let offsets = ids(array::<Uint32Array>(&record, "offsets")?)?;
        let kinds = kinds(&record)?;
        Ok(Self::Traced(MorseComplex { vertices, offsets, saddles: Vec::new(), extrema: Vec::new(), kinds }))
    }

    pub(super) fn separatrices(&self) -> Separatrices<'_> {
        match self {
            Self::None => Separatrices::None,
            Self::Above(persistence) => Separatrices::Above(Threshold::Relative(*persistence)),
            Self::Traced(complex) => Separatrices::Traced(complex),
        }
    }
}

/// The typed array of that name.
fn array<'a, T: JsCast>(record: &'a Record, name: &str) -> Result<&'a T> {
    let found = record.get(name).and_then(|value| value.dyn_ref::<T>());
    found.ok_or_else(|| record.invalid(name, "the array of that name which `TriMesh` gives").into())
}

fn kinds(record: &Record) -> Result<Vec<CriticalKind>> {
    let array = array::<Int8Array>(record, "kinds")?;
    let kind = |sign| match sign {
        -1 => Ok(CriticalKind::Minimum),
        0 => Ok(CriticalKind::Saddle),
        1 => Ok(CriticalKind::Maximum),
        _ => Err(Error::from(record.invalid("kinds", "−1 for minima, 0 for saddles, 1 for maxima"))),
    };
    let signs: Vec<i8> = copied(array.length(), |copy| array.copy_to(copy))?;
    signs.into_iter().map(kind).collect()
}
