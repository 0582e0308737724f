//! `TriMesh.criticalPoints` and `TriMesh.deltaHierarchy`.

use js_sys::{Float64Array, Object};
use wasm_bindgen::prelude::*;

use super::mesh::RawTriMesh;
use super::options::delta;
use super::reading::Reading;
use super::reports;
use crate::field::{self, CriticalKind};
use crate::wasm::shared::answer::Answer;
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::read;

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    #[wasm_bindgen(js_name = criticalPoints)]
    pub fn critical_points(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let (reading, options) = read("", options, |record| (Reading::read(record), delta(record)))?;
        let found = reading.of(self.mesh(), values, |field, watch| field::critical_points(field, &options, watch))?;
        let points = &found.points;
        let answer = Answer::new();
        answer.column("vertices", points.len(), &|k| points[k].vertex);
        answer.column("kinds", points.len(), &|k| sign(points[k].kind));
        answer.column("multiplicities", points.len(), &|k| points[k].multiplicity);
        answer.column("onBoundary", points.len(), &|k| u8::from(points[k].on_boundary));
        answer.part("counts", reports::counts(&found.counts));
        Ok(answer.finish()?)
    }

    #[wasm_bindgen(js_name = deltaHierarchy)]
    pub fn delta_hierarchy(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let (reading, link) =
            read("", options, |record| (Reading::read(record), record.choice("link").unwrap_or_default()))?;
        let found = reading.of(self.mesh(), values, |field, watch| field::delta_hierarchy(field, link, watch))?;
        let (points, curve) = (&found.points, &found.curve);
        let answer = Answer::new();
        answer.column("vertices", points.len(), &|k| points[k].vertex);
        answer.column("kinds", points.len(), &|k| sign(points[k].kind));
        answer.column("vanishesAt", points.len(), &|k| points[k].vanishes_at);
        answer.column("vanishesAtAbsolute", points.len(), &|k| points[k].vanishes_at_absolute);
        answer.array("delta", &curve.delta);
        answer.array("minima", &curve.minima);
        answer.array("maxima", &curve.maxima);
        answer.array("saddles", &curve.saddles);
        Ok(answer.finish()?)
    }
}

/// −1, 0 or 1.
pub(super) fn sign(kind: CriticalKind) -> i8 {
    match kind {
        CriticalKind::Minimum => -1,
        CriticalKind::Saddle => 0,
        CriticalKind::Maximum => 1,
    }
}
