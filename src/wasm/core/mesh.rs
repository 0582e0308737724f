//! The class behind `TriMesh`.

use js_sys::{Array, Float64Array, Object, Uint32Array};
use wasm_bindgen::prelude::*;

use super::options::{Constraining, from_rule};
use super::reports;
use crate::mesh::{self, TriMesh};
use crate::operators::{self, LaplacianWeights};
use crate::smooth::{self, Unconstrained};
use crate::support::named::named;
use crate::wasm::shared::answer::array;
use crate::wasm::shared::arrays::{floats, ids};
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::{Record, read};

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

/// The kinds of mass matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum MassKind {
    #[default]
    Galerkin,
    Lumped,
}

named! { MassKind { Galerkin = "galerkin", Lumped = "lumped" } }

fn weights(record: &Record) -> LaplacianWeights {
    record.choice("weights").unwrap_or_default()
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    #[wasm_bindgen(constructor)]
    pub fn new(positions: &Float64Array, triangles: &Uint32Array, options: &JsValue) -> Result<Self, Thrown> {
        let weld = read("", options, |record| record.boolean("weld").unwrap_or_default())?;
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

    pub fn topology(&self) -> Object {
        reports::topology(&self.mesh.topology())
    }

    pub fn warnings(&self) -> Array {
        reports::diagnostics(self.mesh.warnings())
    }

    pub fn positions(&self) -> Result<JsValue, Thrown> {
        Ok(array(self.mesh.positions())?)
    }

    pub fn triangles(&self) -> Result<JsValue, Thrown> {
        Ok(array(self.mesh.connectivity().triangles().as_flattened())?)
    }

    #[wasm_bindgen(js_name = constrainedVertices)]
    pub fn constrained_vertices(
        &self,
        values: &Float64Array,
        constraints: &JsValue,
        options: &JsValue,
    ) -> Result<JsValue, Thrown> {
        let channels = read("", options, |record| record.integer("channels").unwrap_or(1) as usize)?;
        let constraining = Constraining::read(constraints)?;
        let constraints = constraining.constraints(Unconstrained::Keep);
        let values = floats(values)?;
        let vertices = smooth::constrained_vertices(&self.mesh, &values, channels, &constraints).map_err(from_rule)?;
        Ok(array(&vertices)?)
    }

    pub fn smoothness(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let weights = read("", options, weights)?;
        let laplacian = operators::laplacian(&self.mesh, weights)?;
        Ok(reports::energies(&smooth::smoothness(&laplacian, &floats(values)?)?))
    }

    pub fn laplacian(&self, options: &JsValue) -> Result<Object, Thrown> {
        let weights = read("", options, weights)?;
        Ok(reports::sparse(&operators::laplacian(&self.mesh, weights)?)?)
    }

    pub fn mass(&self, options: &JsValue) -> Result<Object, Thrown> {
        let (kind, scale) = read("", options, |record| {
            (record.choice("kind").unwrap_or_default(), record.choice("massScale").unwrap_or_default())
        })?;
        Ok(reports::sparse(&match kind {
            MassKind::Galerkin => operators::galerkin_mass(&self.mesh, scale)?,
            MassKind::Lumped => operators::lumped_mass(&self.mesh, scale)?,
        })?)
    }
}
