//! The class behind `Scene` of `morse-smooth/snapshot`.

mod ingredients;
mod lists;
mod options;
mod record;

use js_sys::{Float64Array, Object, Uint32Array};
use wasm_bindgen::prelude::*;

use self::options::{Input, Kind, placed};
use super::shared::answer::array;
use super::shared::arrays::{floats, ids};
use super::shared::error::Thrown;
use crate::mesh::TriMesh;
use crate::render::Scene;

/// A mesh in wasm memory, to be drawn.
#[wasm_bindgen]
pub struct RawScene {
    scene: Scene,
}

#[wasm_bindgen]
#[allow(missing_docs, reason = "the public documentation is in src/js/types/")]
impl RawScene {
    #[wasm_bindgen(constructor)]
    pub fn new(positions: &Float64Array, triangles: &Uint32Array) -> Result<Self, Thrown> {
        let mesh = TriMesh::new(floats(positions)?, ids(triangles)?)?;
        Ok(Self { scene: Scene::new(&mesh) })
    }

    pub fn snapshot(&self, values: &Float64Array, options: &JsValue) -> Result<JsValue, Thrown> {
        let input = Input::read(options, Kind::Picture)?;
        let png = self.scene.snapshot(&floats(values)?, &input.snapshot()).map_err(placed)?;
        Ok(array(&png)?)
    }

    pub fn sheet(&self, before: &Float64Array, after: &Float64Array, options: &JsValue) -> Result<JsValue, Thrown> {
        let input = Input::read(options, Kind::Sheet)?;
        let png = self.scene.sheet(&floats(before)?, &floats(after)?, &input.sheet()).map_err(placed)?;
        Ok(array(&png)?)
    }

    pub fn surface(&self) -> Result<Object, Thrown> {
        Ok(lists::surface(self.scene.surface())?)
    }

    #[wasm_bindgen(js_name = drawList)]
    pub fn draw_list(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let input = Input::read(options, Kind::DrawList)?;
        Ok(lists::draw_list(&self.scene.draw_list(&floats(values)?, &input.draw()).map_err(placed)?)?)
    }
}
