//! Values of JavaScript, and the meshes and fields of the tests.

use js_sys::{Float64Array, Function, Int8Array, Reflect, Uint8Array, Uint32Array};
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::wasm::{RawTriMesh, Thrown};
use wasm_bindgen::prelude::*;

pub(crate) const NONE: JsValue = JsValue::UNDEFINED;

/// An object from a piece of JavaScript.
pub(crate) fn js(text: &str) -> JsValue {
    Function::new_no_args(&format!("return ({text})")).call0(&JsValue::NULL).expect("an expression")
}

pub(crate) fn get(object: &JsValue, name: &str) -> JsValue {
    let value = Reflect::get(object, &JsValue::from_str(name)).expect("an object");
    assert!(!value.is_undefined(), "`{name}` is missing");
    value
}

pub(crate) fn floats(object: &JsValue, name: &str) -> Vec<f64> {
    get(object, name).dyn_into::<Float64Array>().expect("a Float64Array").to_vec()
}

pub(crate) fn ids(object: &JsValue, name: &str) -> Vec<u32> {
    get(object, name).dyn_into::<Uint32Array>().expect("a Uint32Array").to_vec()
}

pub(crate) fn int8s(object: &JsValue, name: &str) -> Vec<i8> {
    get(object, name).dyn_into::<Int8Array>().expect("an Int8Array").to_vec()
}

pub(crate) fn bytes(object: &JsValue, name: &str) -> Vec<u8> {
    get(object, name).dyn_into::<Uint8Array>().expect("a Uint8Array").to_vec()
}

pub(crate) fn number(object: &JsValue, name: &str) -> f64 {
    get(object, name).as_f64().unwrap_or_else(|| panic!("`{name}` is no number"))
}

/// What was thrown: `{ code, message, detail }`.
pub(crate) fn thrown<T>(result: Result<T, Thrown>) -> (String, String, JsValue) {
    let error: JsValue = match result {
        Ok(_) => panic!("accepted"),
        Err(error) => error.into(),
    };
    let text = |name| get(&error, name).as_string().expect("a text");
    assert!(!text("message").is_empty());
    assert!(get(&error, "detail").is_object());
    (text("code"), text("message"), get(&error, "detail"))
}

pub(crate) fn torus() -> TriMesh {
    shapes::torus(12, 9, 0.3).expect("a torus")
}

pub(crate) fn raw(mesh: &TriMesh) -> RawTriMesh {
    let positions = Float64Array::from(mesh.positions());
    let triangles = Uint32Array::from(mesh.connectivity().triangles().as_flattened());
    RawTriMesh::new(&positions, Some(triangles.clone()), &NONE).ok().expect("a mesh")
}

pub(crate) fn noise(n: usize) -> Vec<f64> {
    let mut random = Random::new(5);
    (0..n).map(|_| random.signed()).collect()
}

pub(crate) fn array(values: &[f64]) -> Float64Array {
    Float64Array::from(values)
}
