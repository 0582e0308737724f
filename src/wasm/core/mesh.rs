//! The class behind `TriMesh`.

use js_sys::{Array, Float64Array, Object, Uint32Array};
use wasm_bindgen::prelude::*;

use super::options::{Constraining, from_rule};
use super::reading::Reading;
use super::reports;
use super::watching::Watching;
use crate::error::{FieldError, OutOfMemory};
use crate::mesh::{self, TriMesh};
use crate::operators::{self, LaplacianWeights, MassOptions};
use crate::smooth::{self, Unconstrained};
use crate::support::memory;
use crate::support::watch::{Phase, Watch};
use crate::wasm::shared::answer::{Answer, array};
use crate::wasm::shared::arrays::{floats, ids};
use crate::wasm::shared::error::Thrown;
use crate::wasm::shared::record::{Record, read};
use crate::wasm::shared::warnings::diagnostics;
use crate::wasm::shared::weld::{from_weld, weld};

/// About the work with a triangle when a Laplacian is assembled.
const LAPLACIAN: u64 = 200;

/// A mesh in wasm memory.
#[wasm_bindgen]
pub struct RawTriMesh {
    mesh: TriMesh,
    vertex_map: Option<Vec<u32>>,
}

impl RawTriMesh {
    /// `vertex_map` says what became of vertices that were welded.
    fn wrap(mesh: TriMesh, vertex_map: Option<Vec<u32>>) -> Self {
        Self { mesh, vertex_map }
    }

    pub(super) fn mesh(&self) -> &TriMesh {
        &self.mesh
    }
}

/// The triangles of a soup of so many vertices.
fn soup(vertices: usize) -> Result<Vec<u32>, OutOfMemory> {
    let mut triangles = memory::with_room(vertices)?;
    triangles.extend(0..vertices as u32);
    Ok(triangles)
}

fn weights(record: &Record) -> LaplacianWeights {
    record.choice("weights").unwrap_or_default()
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawTriMesh {
    /// Without triangles the positions are those of a soup, three for each triangle.
    #[wasm_bindgen(constructor)]
    #[allow(clippy::needless_pass_by_value, reason = "wasm-bindgen hands what may be missing over by value")]
    pub fn new(positions: &Float64Array, triangles: Option<Uint32Array>, options: &JsValue) -> Result<Self, Thrown> {
        let options = read("", options, weld)?;
        let positions = floats(positions)?;
        let triangles = triangles.as_ref().map(ids).transpose()?;
        let Some(options) = options else {
            let triangles = triangles.map_or_else(|| soup(positions.len() / 3), Ok)?;
            return Ok(Self::wrap(TriMesh::new(positions, triangles)?, None));
        };
        let welded = mesh::weld(&positions, triangles.as_deref(), &options).map_err(from_weld)?;
        drop((positions, triangles));
        let map = welded.joins_any().then_some(welded.map);
        Ok(Self::wrap(TriMesh::new(welded.positions, welded.triangles)?, map))
    }

    /// For every vertex as given the vertex that it became; null where they are the same.
    #[wasm_bindgen(js_name = vertexMap)]
    pub fn vertex_map(&self) -> Result<JsValue, Thrown> {
        Ok(self.vertex_map.as_deref().map_or(Ok(JsValue::NULL), array)?)
    }

    /// The part of the mesh that has values, and its vertices: `{ mesh, vertices }`.
    #[wasm_bindgen(js_name = withoutMissing)]
    pub fn without_missing(&self, values: &Float64Array) -> Result<Object, Thrown> {
        let values = floats(values)?;
        let (expected, actual) = (self.mesh.vertex_count(), values.len());
        if actual != expected {
            return Err(FieldError::length_mismatch(expected, actual, self.mesh.triangle_count()).into());
        }
        if let Some(vertex) = values.iter().position(|value| value.is_infinite()) {
            return Err(FieldError::NonFiniteValue { vertex: vertex as u32 }.into());
        }
        let part = self.mesh.submesh(&|vertex| !values[vertex as usize].is_nan())?;
        let answer = Answer::new();
        answer.array("vertices", &part.vertices);
        answer.set("mesh", &Self::wrap(part.mesh, None).into());
        Ok(answer.finish()?)
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

    pub fn topology(&self) -> Result<Object, Thrown> {
        Ok(reports::topology(&self.mesh.topology()?))
    }

    pub fn warnings(&self) -> Array {
        diagnostics(self.mesh.warnings())
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
        let (channels, missing, watching) = read("", options, |record| {
            let channels = record.integer("channels").unwrap_or(1) as usize;
            (channels, record.choice("missing").unwrap_or_default(), Watching::read(record))
        })?;
        let constraining = Constraining::read(constraints)?;
        let constraints = constraining.constraints(Unconstrained::Keep);
        let values = floats(values)?;
        let find = |watch: &Watch<'_>| {
            smooth::constrained_vertices(&self.mesh, &values, channels, missing, &constraints, watch).map_err(from_rule)
        };
        let vertices = watching.run(find)?;
        Ok(array(&vertices)?)
    }

    pub fn smoothness(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let (reading, weights) = read("", options, |record| (Reading::read(record), weights(record)))?;
        let energies = reading.of(&self.mesh, values, |field, watch| {
            let mut plan = watch.plan(&[(Phase::Field, 1.0)]);
            plan.begin(LAPLACIAN * field.mesh().triangle_count() as u64)?;
            let laplacian = operators::laplacian(field.mesh(), weights, watch)?;
            let energies = smooth::smoothness(&laplacian, field)?;
            plan.finish()?;
            Ok(energies)
        })?;
        Ok(reports::energies(&energies))
    }

    pub fn laplacian(&self, options: &JsValue) -> Result<Object, Thrown> {
        let weights = read("", options, weights)?;
        Ok(reports::sparse(&operators::laplacian(&self.mesh, weights, &Watch::none())?)?)
    }

    pub fn mass(&self, options: &JsValue) -> Result<Object, Thrown> {
        let options = read("", options, |record| MassOptions {
            kind: record.choice("kind").unwrap_or_default(),
            scale: record.choice("massScale").unwrap_or_default(),
        })?;
        Ok(reports::sparse(&operators::mass(&self.mesh, &options, &Watch::none())?)?)
    }
}
