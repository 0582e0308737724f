//! The bindings of persistence, simplification and the Morse complex.

use js_sys::{Float64Array, Object};
use wasm_bindgen::prelude::*;

use super::critical::sign;
use super::mesh::RawTriMesh;
use super::options::{cancelled_up_to, kept};
use super::reading::Reading;
use crate::field;
use crate::support::memory;
use crate::wasm::shared::answer::Answer;
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::read;

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    pub fn persistence(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let reading = read("", options, Reading::read)?;
        let diagram = reading.of(self.mesh(), values, field::persistence)?;
        let pairs = &diagram.pairs;
        let answer = Answer::new();
        answer.column("extrema", pairs.len(), &|k| pairs[k].extremum);
        answer.column("saddles", pairs.len(), &|k| pairs[k].saddle);
        answer.column("kinds", pairs.len(), &|k| sign(pairs[k].kind));
        answer.column("birth", pairs.len(), &|k| pairs[k].birth);
        answer.column("death", pairs.len(), &|k| pairs[k].death);
        answer.column("persistence", pairs.len(), &|k| pairs[k].persistence);
        answer.array("essentialMinima", &diagram.essential_minima);
        answer.array("essentialMaxima", &diagram.essential_maxima);
        answer.array("essentialSaddles", &diagram.essential_saddles);
        Ok(answer.finish()?)
    }

    #[wasm_bindgen(js_name = persistenceCurve)]
    pub fn persistence_curve(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let reading = read("", options, Reading::read)?;
        let curve = reading.of(self.mesh(), values, |field, watch| Ok(field::persistence(field, watch)?.curve()))?;
        let answer = Answer::new();
        answer.array("threshold", &curve.threshold);
        answer.array("minima", &curve.minima);
        answer.array("maxima", &curve.maxima);
        Ok(answer.finish()?)
    }

    pub fn simplify(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let (reading, kept) = read("", options, |record| (Reading::read(record), kept(record)))?;
        let kept = kept.copied()?;
        let simple = reading.of(self.mesh(), values, |field, watch| field::simplify(field, kept.keep(), watch))?;
        let answer = Answer::new();
        answer.array("values", &simple.values);
        answer.array("unavoidable", &simple.unavoidable);
        Ok(answer.finish()?)
    }

    #[wasm_bindgen(js_name = morseComplex)]
    pub fn morse_complex(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let (reading, persistence, style) = read("", options, |record| {
            (Reading::read(record), cancelled_up_to(record), record.choice("paths").unwrap_or_default())
        })?;
        let complex =
            reading.of(self.mesh(), values, |field, watch| field::morse_complex(field, persistence, style, watch))?;
        let mut points: Vec<f64> = memory::with_room(3 * complex.vertices.len())?;
        for &v in &complex.vertices {
            points.extend_from_slice(&self.mesh().position(v));
        }
        let answer = Answer::new();
        answer.array("points", &points);
        answer.array("offsets", &complex.offsets);
        answer.array("saddles", &complex.saddles);
        answer.array("extrema", &complex.extrema);
        answer.column("kinds", complex.kinds.len(), &|k| sign(complex.kinds[k]));
        answer.array("vertices", &complex.vertices);
        Ok(answer.finish()?)
    }

    #[wasm_bindgen(js_name = morseHierarchy)]
    pub fn morse_hierarchy(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let reading = read("", options, Reading::read)?;
        let hierarchy = reading.of(self.mesh(), values, field::morse_hierarchy)?;
        let nodes = &hierarchy.nodes;
        let answer = Answer::new();
        answer.column("vertices", nodes.len(), &|k| nodes[k].vertex);
        answer.column("kinds", nodes.len(), &|k| sign(nodes[k].kind));
        answer.column("cancelledAt", nodes.len(), &|k| nodes[k].cancelled_at);
        answer.column("partners", nodes.len(), &|k| nodes[k].partner);
        answer.column("into", nodes.len(), &|k| nodes[k].into);
        answer.array("arcs", hierarchy.arcs.as_flattened());
        Ok(answer.finish()?)
    }

    pub fn basins(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let (reading, persistence) = read("", options, |record| (Reading::read(record), cancelled_up_to(record)))?;
        let basins = reading.of(self.mesh(), values, |field, watch| field::basins(field, persistence, watch))?;
        let answer = Answer::new();
        answer.array("descending", &basins.descending);
        answer.array("ascending", &basins.ascending);
        Ok(answer.finish()?)
    }
}
