//! The class behind `Scene` of `morse-smooth/snapshot`.

mod ingredients;
mod lists;
mod options;
mod record;

use js_sys::{Float64Array, Object, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use self::options::{DRAW, Input, PICTURE, SHEET, placed};
use super::convert::{floats, ids};
use super::error::Thrown;
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

    pub fn snapshot(&self, values: &Float64Array, options: &JsValue) -> Result<Uint8Array, Thrown> {
        let input = Input::read(options, &[DRAW, PICTURE])?;
        let png = self.scene.snapshot(&floats(values)?, &input.snapshot()).map_err(placed)?;
        Ok(Uint8Array::from(png.as_slice()))
    }

    pub fn sheet(&self, before: &Float64Array, after: &Float64Array, options: &JsValue) -> Result<Uint8Array, Thrown> {
        let input = Input::read(options, &[DRAW, PICTURE, SHEET])?;
        let png = self.scene.sheet(&floats(before)?, &floats(after)?, &input.sheet()).map_err(placed)?;
        Ok(Uint8Array::from(png.as_slice()))
    }

    pub fn surface(&self) -> Object {
        lists::surface(self.scene.surface())
    }

    #[wasm_bindgen(js_name = drawList)]
    pub fn draw_list(&self, values: &Float64Array, options: &JsValue) -> Result<Object, Thrown> {
        let input = Input::read(options, &[DRAW])?;
        Ok(lists::draw_list(&self.scene.draw_list(&floats(values)?, &input.draw()).map_err(placed)?))
    }
}
