//! Errors as plain objects `{ code, message, detail }`; `src/js` turns them into `MorseSmoothError`.

use js_sys::{Object, Reflect};
use wasm_bindgen::JsValue;

use crate::error::{Detail, Error};

/// What every exported function throws.
pub struct Thrown(Error);

impl<E: Into<Error>> From<E> for Thrown {
    fn from(error: E) -> Self {
        Self(error.into())
    }
}

impl From<Thrown> for JsValue {
    fn from(thrown: Thrown) -> Self {
        let detail = Object::new();
        for (name, value) in thrown.0.detail() {
            let value = match value {
                Detail::Integer(value) => Self::from_f64(value as f64),
                Detail::Signed(value) => Self::from_f64(value as f64),
                Detail::Real(value) => Self::from_f64(value),
                Detail::Text(value) => Self::from_str(&value),
            };
            set(&detail, name, &value);
        }
        let object = Object::new();
        set(&object, "code", &Self::from_str(thrown.0.code()));
        set(&object, "message", &Self::from_str(&thrown.0.to_string()));
        set(&object, "detail", &detail);
        object.into()
    }
}

/// Sets a property of an object made here, which cannot fail.
#[inline(never)]
pub(super) fn set(object: &Object, name: &str, value: &JsValue) {
    let set = Reflect::set(object, &JsValue::from_str(name), value);
    debug_assert!(set.is_ok(), "a new object takes properties");
}
