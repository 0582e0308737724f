//! `TriMesh.criticalPoints` and `TriMesh.deltaHierarchy`.

use js_sys::{Float64Array, Int8Array, Object, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use super::convert::{floats, object};
use super::error::{Thrown, set};
use super::mesh::RawTriMesh;
use super::options::read;
use crate::field::{self, CriticalKind, ScalarField};
use crate::support::watch::Watch;

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    #[wasm_bindgen(js_name = criticalPoints)]
    pub fn critical_points(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let options = read(options, &[&["delta", "deltaIs", "link", "rule"]])?.delta()?;
        let values = floats(values)?;
        let field = ScalarField::new(self.mesh(), &values)?;
        let found = field::critical_points(&field, &options, &Watch::none())?;
        let points = &found.points;
        let mut columns = Columns::with_room(points.len());
        let mut multiplicities: Vec<u32> = Vec::with_capacity(points.len());
        let mut on_boundary: Vec<u8> = Vec::with_capacity(points.len());
        for p in points {
            columns.push(p.vertex, p.kind);
            multiplicities.push(p.multiplicity);
            on_boundary.push(u8::from(p.on_boundary));
        }
        let result = columns.object();
        set(&result, "multiplicities", &Uint32Array::from(multiplicities.as_slice()));
        set(&result, "onBoundary", &Uint8Array::from(on_boundary.as_slice()));
        set(&result, "counts", &object(&found.counts));
        Ok(result)
    }

    #[wasm_bindgen(js_name = deltaHierarchy)]
    pub fn delta_hierarchy(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let link = read(options, &[&["link"]])?.delta()?.link;
        let values = floats(values)?;
        let field = ScalarField::new(self.mesh(), &values)?;
        let found = field::delta_hierarchy(&field, link, &Watch::none())?;
        let (points, curve) = (&found.points, &found.curve);
        let mut columns = Columns::with_room(points.len());
        let mut vanishes_at: Vec<f64> = Vec::with_capacity(points.len());
        let mut vanishes_at_absolute: Vec<f64> = Vec::with_capacity(points.len());
        for p in points {
            columns.push(p.vertex, p.kind);
            vanishes_at.push(p.vanishes_at);
            vanishes_at_absolute.push(p.vanishes_at_absolute);
        }
        let result = columns.object();
        set(&result, "vanishesAt", &Float64Array::from(vanishes_at.as_slice()));
        set(&result, "vanishesAtAbsolute", &Float64Array::from(vanishes_at_absolute.as_slice()));
        set(&result, "delta", &Float64Array::from(curve.delta.as_slice()));
        set(&result, "minima", &Uint32Array::from(curve.minima.as_slice()));
        set(&result, "maxima", &Uint32Array::from(curve.maxima.as_slice()));
        set(&result, "saddles", &Uint32Array::from(curve.saddles.as_slice()));
        Ok(result)
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

/// What both results begin with.
struct Columns {
    vertices: Vec<u32>,
    kinds: Vec<i8>,
}

impl Columns {
    fn with_room(points: usize) -> Self {
        Self { vertices: Vec::with_capacity(points), kinds: Vec::with_capacity(points) }
    }

    fn push(&mut self, vertex: u32, kind: CriticalKind) {
        self.vertices.push(vertex);
        self.kinds.push(sign(kind));
    }

    #[inline(never)]
    fn object(&self) -> Object {
        let result = Object::new();
        set(&result, "vertices", &Uint32Array::from(self.vertices.as_slice()));
        set(&result, "kinds", &Int8Array::from(self.kinds.as_slice()));
        result
    }
}
