//! `TriMesh.levelSets` and `TriMesh.bands`.

use js_sys::{Float64Array, Object, Uint32Array};
use wasm_bindgen::prelude::*;

use super::mesh::RawTriMesh;
use super::reading::Reading;
use crate::error::{OptionError, Result as Outcome};
use crate::field::{self, ScalarField};
use crate::support::watch::Watch;
use crate::wasm::shared::answer::Answer;
use crate::wasm::shared::arrays::{floats, ids};
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::{Record, read};

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    /// `levels` is a `Float64Array`, `{ count }` or `{ saddles, offset }`.
    #[wasm_bindgen(js_name = levelSets)]
    pub fn level_sets(&self, values: &Float64Array, levels: &JsValue, options: &JsValue) -> Result<Object, Thrown> {
        let reading = read("", options, Reading::read)?;
        let levels = Levels::read(levels, true)?;
        let sets = reading
            .of(self.mesh(), values, |field, watch| field::level_sets(field, &levels.values(field, watch)?, watch))?;
        let answer = Answer::new();
        answer.array("points", &sets.points);
        answer.array("offsets", &sets.offsets);
        answer.array("levels", &sets.levels);
        answer.column("closed", sets.closed.len(), &|k| u8::from(sets.closed[k]));
        answer.array("edges", sets.edges.as_flattened());
        answer.array("parameters", &sets.parameters);
        Ok(answer.finish()?)
    }

    /// `levels` is a `Float64Array` or `{ count }`.
    pub fn bands(&self, values: &Float64Array, levels: &JsValue, options: &JsValue) -> Result<Object, Thrown> {
        let reading = read("", options, Reading::read)?;
        let levels = Levels::read(levels, false)?;
        let bands = reading
            .of(self.mesh(), values, |field, watch| field::bands(field, &levels.values(field, watch)?, watch))?;
        let answer = Answer::new();
        answer.array("levels", &bands.levels);
        answer.array("points", &bands.points);
        answer.array("triangles", bands.triangles.as_flattened());
        answer.array("bands", &bands.bands);
        answer.array("parents", &bands.parents);
        answer.array("edges", bands.edges.as_flattened());
        answer.array("parameters", &bands.parameters);
        Ok(answer.finish()?)
    }
}

/// At which values.
enum Levels {
    At(Vec<f64>),
    /// So many, evenly spaced.
    Count(u32),
    /// Those of saddles, of all where none are named, a little off by the offset.
    Saddles(Option<Vec<u32>>, f64),
}

impl Levels {
    fn read(levels: &JsValue, can_be_at_saddles: bool) -> Outcome<Self> {
        if let Some(levels) = levels.dyn_ref::<Float64Array>() {
            return Ok(Self::At(floats(levels)?));
        }
        read("", levels, |record| if can_be_at_saddles { Self::at_saddles(record) } else { Self::count(record) })?
            .ok_or_else(|| {
                let expected = if can_be_at_saddles {
                    "a list of numbers, { count } or { saddles }"
                } else {
                    "a list of numbers or { count }"
                };
                OptionError::InvalidArgument { argument: "levels".to_owned(), expected: expected.to_owned() }.into()
            })
    }

    fn count(record: &Record) -> Option<Self> {
        record.integer("count").map(Self::Count)
    }

    fn at_saddles(record: &Record) -> Option<Self> {
        let (count, offset) = (Self::count(record), record.number("offset"));
        if count.is_some() {
            for (option, is_there) in [("saddles", record.has("saddles")), ("offset", offset.is_some())] {
                if is_there {
                    record.inapplicable(option, "`count` says which levels");
                }
            }
            return count;
        }
        let offset = offset.unwrap_or_default();
        let saddles = record.part("saddles", |saddles| match saddles.dyn_ref::<Uint32Array>() {
            Some(vertices) => Ok(Some(ids(vertices)?)),
            None if *saddles == JsValue::TRUE => Ok(None),
            None => Err(OptionError::invalid("saddles", "true or a list of vertices").into()),
        });
        saddles.map(|vertices| Self::Saddles(vertices, offset))
    }

    fn values(&self, field: &ScalarField<'_>, watch: &Watch<'_>) -> Outcome<Vec<f64>> {
        match self {
            Self::At(levels) => Ok(levels.clone()),
            Self::Count(count) => field::evenly_spaced_levels(field, *count as usize),
            Self::Saddles(vertices, offset) => field::saddle_levels(field, vertices.as_deref(), *offset, watch),
        }
    }
}
