//! The class behind `TriMesh`.

use js_sys::{Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use super::convert::{diagnostics, floats, ids, object, sparse};
use super::error::Thrown;
use super::options::{ConstraintInput, from_rule, read};
use crate::mesh::{self, TriMesh, WeldOptions};
use crate::operators;
use crate::smooth::{self, Unconstrained};

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
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    #[wasm_bindgen(constructor)]
    pub fn new(positions: &Float64Array, triangles: &Uint32Array, options: &JsValue) -> Result<Self, Thrown> {
        let weld = read(options, &[&["weld"]])?.weld.unwrap_or(false);
        let (positions, triangles) = (floats(positions)?, ids(triangles)?);
        let mesh = if weld {
            let welded = mesh::weld(&positions, Some(&triangles), &WeldOptions::default())?;
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

    pub fn topology(&self) -> Result<JsValue, Thrown> {
        Ok(object(&self.mesh.topology()?))
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

    #[wasm_bindgen(js_name = constrainedVertices)]
    pub fn constrained_vertices(
        &self,
        values: &Float64Array,
        constraints: &JsValue,
        options: &JsValue,
    ) -> Result<Uint32Array, Thrown> {
        let channels = read(options, &[&["channels"]])?.channels();
        let input = ConstraintInput::read(constraints)?;
        let constraints = input.constraints(Unconstrained::Keep);
        let values = floats(values)?;
        let vertices = smooth::constrained_vertices(&self.mesh, &values, channels, &constraints).map_err(from_rule)?;
        Ok(Uint32Array::from(vertices.as_slice()))
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
