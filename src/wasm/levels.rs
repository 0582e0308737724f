//! `TriMesh.levelSets` and `TriMesh.bands`.

use js_sys::{Float64Array, Object, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use super::convert::{floats, ids};
use super::error::{Thrown, set};
use super::mesh::RawTriMesh;
use super::options::{inapplicable, invalid, is_absent, read};
use crate::error::{Error, OptionError};
use crate::field::{self, ScalarField};
use crate::support::watch::Watch;

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    /// `levels` is a `Float64Array`, `{ count }` or `{ saddles, offset }`.
    #[wasm_bindgen(js_name = levelSets)]
    pub fn level_sets(&self, values: &Float64Array, levels: &JsValue) -> Result<Object, Thrown> {
        let values = floats(values)?;
        let field = ScalarField::new(self.mesh(), &values)?;
        let levels = read_levels(&field, levels, &["count", "saddles", "offset"])?;
        let sets = field::level_sets(&field, &levels, &Watch::none())?;
        let closed: Vec<u8> = sets.closed.iter().map(|&closed| u8::from(closed)).collect();
        let result = Object::new();
        set(&result, "points", &Float64Array::from(sets.points.as_slice()));
        set(&result, "offsets", &Uint32Array::from(sets.offsets.as_slice()));
        set(&result, "levels", &Float64Array::from(sets.levels.as_slice()));
        set(&result, "closed", &Uint8Array::from(closed.as_slice()));
        set(&result, "edges", &Uint32Array::from(sets.edges.as_flattened()));
        set(&result, "parameters", &Float64Array::from(sets.parameters.as_slice()));
        Ok(result)
    }

    /// `levels` is a `Float64Array` or `{ count }`.
    pub fn bands(&self, values: &Float64Array, levels: &JsValue) -> Result<Object, Thrown> {
        let values = floats(values)?;
        let field = ScalarField::new(self.mesh(), &values)?;
        let levels = read_levels(&field, levels, &["count"])?;
        let bands = field::bands(&field, &levels, &Watch::none())?;
        let result = Object::new();
        set(&result, "levels", &Float64Array::from(bands.levels.as_slice()));
        set(&result, "points", &Float64Array::from(bands.points.as_slice()));
        set(&result, "triangles", &Uint32Array::from(bands.triangles.as_flattened()));
        set(&result, "bands", &Uint32Array::from(bands.bands.as_slice()));
        set(&result, "parents", &Uint32Array::from(bands.parents.as_slice()));
        set(&result, "edges", &Uint32Array::from(bands.edges.as_flattened()));
        set(&result, "parameters", &Float64Array::from(bands.parameters.as_slice()));
        Ok(result)
    }
}

/// `known` are the options that the function takes.
fn read_levels(field: &ScalarField<'_>, levels: &JsValue, known: &[&str]) -> Result<Vec<f64>, Error> {
    if let Some(levels) = levels.dyn_ref::<Float64Array>() {
        return Ok(floats(levels)?);
    }
    let options = read(levels, &[known])?;
    if let Some(count) = options.count {
        let other = [("saddles", !is_absent(&options.saddles)), ("offset", options.offset.is_some())];
        if let Some((option, _)) = other.iter().find(|(_, is_there)| *is_there) {
            return Err(inapplicable(option, "`count` says which levels").into());
        }
        return field::evenly_spaced_levels(field, count as usize);
    }
    if is_absent(&options.saddles) {
        let expected = match known {
            ["count"] => "a list of numbers or { count }",
            _ => "a list of numbers, { count } or { saddles }",
        };
        return Err(
            OptionError::InvalidArgument { argument: "levels".to_owned(), expected: expected.to_owned() }.into()
        );
    }
    let vertices = match options.saddles.dyn_ref::<Uint32Array>() {
        Some(vertices) => Some(ids(vertices)?),
        None if options.saddles == JsValue::TRUE => None,
        None => return Err(invalid("saddles", "true or a list of vertices").into()),
    };
    field::saddle_levels(field, vertices.as_deref(), options.offset.unwrap_or_default(), &Watch::none())
}
