//! The bindings of persistence, simplification and the Morse complex.

use js_sys::{Float64Array, Int8Array, Object, Uint32Array};
use wasm_bindgen::prelude::*;

use super::convert::{floats, ids};
use super::critical::sign;
use super::error::{Thrown, set};
use super::mesh::RawTriMesh;
use super::options::{invalid, is_absent, read};
use crate::error::FieldError;
use crate::field::{self, CriticalKind, ScalarField};
use crate::support::watch::Watch;

fn numbers(result: &Object, name: &str, values: impl Iterator<Item = f64>) {
    let values: Vec<f64> = values.collect();
    set(result, name, &Float64Array::from(values.as_slice()));
}

fn indices(result: &Object, name: &str, values: impl Iterator<Item = u32>) {
    let values: Vec<u32> = values.collect();
    set(result, name, &Uint32Array::from(values.as_slice()));
}

fn kinds(result: &Object, values: impl Iterator<Item = CriticalKind>) {
    let values: Vec<i8> = values.map(sign).collect();
    set(result, "kinds", &Int8Array::from(values.as_slice()));
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    pub fn persistence(&self, values: &Float64Array) -> Result<Object, Thrown> {
        let values = floats(values)?;
        let diagram = field::persistence(&ScalarField::new(self.mesh(), &values)?, &Watch::none())?;
        let pairs = &diagram.pairs;
        let result = Object::new();
        indices(&result, "extrema", pairs.iter().map(|p| p.extremum));
        indices(&result, "saddles", pairs.iter().map(|p| p.saddle));
        kinds(&result, pairs.iter().map(|p| p.kind));
        numbers(&result, "birth", pairs.iter().map(|p| p.birth));
        numbers(&result, "death", pairs.iter().map(|p| p.death));
        numbers(&result, "persistence", pairs.iter().map(|p| p.persistence));
        indices(&result, "essentialMinima", diagram.essential_minima.into_iter());
        indices(&result, "essentialMaxima", diagram.essential_maxima.into_iter());
        indices(&result, "essentialSaddles", diagram.essential_saddles.into_iter());
        Ok(result)
    }

    #[wasm_bindgen(js_name = persistenceCurve)]
    pub fn persistence_curve(&self, values: &Float64Array) -> Result<Object, Thrown> {
        let values = floats(values)?;
        let curve = field::persistence(&ScalarField::new(self.mesh(), &values)?, &Watch::none())?.curve();
        let result = Object::new();
        numbers(&result, "threshold", curve.threshold.into_iter());
        indices(&result, "minima", curve.minima.into_iter());
        indices(&result, "maxima", curve.maxima.into_iter());
        Ok(result)
    }

    pub fn simplify(&self, values: &Float64Array, options: &JsValue) -> Result<Float64Array, Thrown> {
        let options = read(options, &[&["threshold", "thresholdIs", "keep"]])?;
        let values = floats(values)?;
        let kept = match options.keep.dyn_ref::<Uint32Array>() {
            Some(kept) => Some(ids(kept)?),
            None if is_absent(&options.keep) => None,
            None => return Err(invalid("keep", "a list of vertices").into()),
        };
        let field = ScalarField::new(self.mesh(), &values)?;
        let simple = field::simplify(&field, options.extrema(kept.as_deref())?, &Watch::none())?;
        Ok(Float64Array::from(simple.values.as_slice()))
    }

    #[wasm_bindgen(js_name = morseComplex)]
    pub fn morse_complex(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let options = read(options, &[&["persistence", "persistenceIs", "paths"]])?;
        let style = options.paths()?;
        let persistence = options.persistence()?;
        let values = floats(values)?;
        let field = ScalarField::new(self.mesh(), &values)?;
        let complex = field::morse_complex(&field, persistence, style, &Watch::none())?;
        let length = 3 * complex.vertices.len();
        let mut points = Vec::new();
        if points.try_reserve_exact(length).is_err() {
            return Err(FieldError::OutOfMemory { bytes: 8 * length as u64 }.into());
        }
        for &v in &complex.vertices {
            points.extend_from_slice(&self.mesh().position(v));
        }
        let result = Object::new();
        set(&result, "points", &Float64Array::from(points.as_slice()));
        set(&result, "offsets", &Uint32Array::from(complex.offsets.as_slice()));
        set(&result, "saddles", &Uint32Array::from(complex.saddles.as_slice()));
        set(&result, "extrema", &Uint32Array::from(complex.extrema.as_slice()));
        kinds(&result, complex.kinds.into_iter());
        set(&result, "vertices", &Uint32Array::from(complex.vertices.as_slice()));
        Ok(result)
    }

    #[wasm_bindgen(js_name = morseHierarchy)]
    pub fn morse_hierarchy(&self, values: &Float64Array) -> Result<Object, Thrown> {
        let values = floats(values)?;
        let hierarchy = field::morse_hierarchy(&ScalarField::new(self.mesh(), &values)?, &Watch::none())?;
        let nodes = &hierarchy.nodes;
        let result = Object::new();
        indices(&result, "vertices", nodes.iter().map(|node| node.vertex));
        kinds(&result, nodes.iter().map(|node| node.kind));
        numbers(&result, "cancelledAt", nodes.iter().map(|node| node.cancelled_at));
        indices(&result, "partners", nodes.iter().map(|node| node.partner));
        indices(&result, "into", nodes.iter().map(|node| node.into));
        set(&result, "arcs", &Uint32Array::from(hierarchy.arcs.as_flattened()));
        Ok(result)
    }

    pub fn basins(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let persistence = read(options, &[&["persistence", "persistenceIs"]])?.persistence()?;
        let values = floats(values)?;
        let basins = field::basins(&ScalarField::new(self.mesh(), &values)?, persistence, &Watch::none())?;
        let result = Object::new();
        set(&result, "descending", &Uint32Array::from(basins.descending.as_slice()));
        set(&result, "ascending", &Uint32Array::from(basins.ascending.as_slice()));
        Ok(result)
    }
}
