//! The class behind `TriMesh`.

use js_sys::{Float64Array, Int8Array, Object, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use super::convert::{diagnostics, floats, ids, object, sparse};
use super::error::{Thrown, set};
use super::options::read;
use crate::error::OptionError;
use crate::field::{self, CriticalKind};
use crate::mesh::{self, TriMesh};
use crate::operators;
use crate::smooth;

/// A mesh in wasm memory.
#[wasm_bindgen]
pub struct RawTriMesh {
    mesh: TriMesh,
}

impl RawTriMesh {
    pub(super) fn wrap(mesh: TriMesh) -> Self {
        Self { mesh }
    }

    pub(super) fn mesh(&self) -> &TriMesh {
        &self.mesh
    }
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/morse-smooth.d.ts")]
impl RawTriMesh {
    #[wasm_bindgen(constructor)]
    pub fn new(positions: &Float64Array, triangles: &Uint32Array, options: &JsValue) -> Result<Self, Thrown> {
        let weld = read(options, &[&["weld"]])?.weld.unwrap_or(false);
        let (positions, triangles) = (floats(positions)?, ids(triangles)?);
        let mesh = if weld {
            let welded = mesh::weld(&positions, &triangles)?;
            TriMesh::new(welded.positions, welded.triangles)?
        } else {
            TriMesh::new(positions, triangles)?
        };
        Ok(Self { mesh })
    }

    #[wasm_bindgen(getter, js_name = vertexCount)]
    pub fn vertex_count(&self) -> usize {
        self.mesh.vertex_count()
    }

    #[wasm_bindgen(getter, js_name = edgeCount)]
    pub fn edge_count(&self) -> usize {
        self.mesh.edge_count()
    }

    #[wasm_bindgen(getter, js_name = triangleCount)]
    pub fn triangle_count(&self) -> usize {
        self.mesh.triangle_count()
    }

    #[wasm_bindgen(getter)]
    pub fn area(&self) -> f64 {
        self.mesh.area()
    }

    pub fn topology(&self) -> JsValue {
        object(&self.mesh.topology())
    }

    pub fn warnings(&self) -> JsValue {
        diagnostics(self.mesh.warnings())
    }

    pub fn positions(&self) -> Float64Array {
        Float64Array::from(self.mesh.positions())
    }

    pub fn triangles(&self) -> Uint32Array {
        Uint32Array::from(self.mesh.connectivity().triangles().as_flattened())
    }

    #[wasm_bindgen(js_name = criticalPoints)]
    pub fn critical_points(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let options = read(options, &[&["delta", "deltaIs", "link", "rule"]])?.delta()?;
        let found = field::critical_points(&self.mesh, &floats(values)?, &options)?;
        let points = &found.points;
        let vertices: Vec<u32> = points.iter().map(|p| p.vertex).collect();
        let multiplicities: Vec<u32> = points.iter().map(|p| p.multiplicity).collect();
        let on_boundary: Vec<u8> = points.iter().map(|p| u8::from(p.on_boundary)).collect();
        let kinds: Vec<i8> = points
            .iter()
            .map(|p| match p.kind {
                CriticalKind::Minimum => -1,
                CriticalKind::Saddle => 0,
                CriticalKind::Maximum => 1,
            })
            .collect();
        let result = Object::new();
        set(&result, "vertices", &Uint32Array::from(vertices.as_slice()));
        set(&result, "kinds", &Int8Array::from(kinds.as_slice()));
        set(&result, "multiplicities", &Uint32Array::from(multiplicities.as_slice()));
        set(&result, "onBoundary", &Uint8Array::from(on_boundary.as_slice()));
        set(&result, "counts", &object(&found.counts));
        Ok(result)
    }

    /// `levels` is a `Float64Array` or `{ count }`.
    #[wasm_bindgen(js_name = levelSets)]
    pub fn level_sets(&self, values: &Float64Array, levels: &JsValue) -> Result<Object, Thrown> {
        let values = floats(values)?;
        let levels = match levels.dyn_ref::<Float64Array>() {
            Some(levels) => floats(levels)?,
            None => {
                let count = read(levels, &[&["count"]])?.count.ok_or_else(|| OptionError::InvalidArgument {
                    argument: "levels".to_owned(),
                    expected: "a list of numbers or { count }".to_owned(),
                })?;
                field::evenly_spaced_levels(&self.mesh, &values, count as usize)?
            }
        };
        let sets = field::level_sets(&self.mesh, &values, &levels)?;
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

    pub fn smoothness(&self, values: &Float64Array, options: &JsValue) -> Result<JsValue, Thrown> {
        let weights = read(options, &[&["weights"]])?.weights()?;
        let laplacian = operators::laplacian(&self.mesh, weights)?;
        Ok(object(&smooth::smoothness(&laplacian, &floats(values)?)?))
    }

    pub fn laplacian(&self, options: &JsValue) -> Result<JsValue, Thrown> {
        let weights = read(options, &[&["weights"]])?.weights()?;
        Ok(sparse(&operators::laplacian(&self.mesh, weights)?))
    }

    pub fn mass(&self, options: &JsValue) -> Result<JsValue, Thrown> {
        let options = read(options, &[&["kind", "massScale"]])?;
        let scale = options.mass_scale()?;
        Ok(sparse(&if options.is_lumped()? {
            operators::lumped_mass(&self.mesh, scale)?
        } else {
            operators::galerkin_mass(&self.mesh, scale)?
        }))
    }
}
