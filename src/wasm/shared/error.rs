//! Errors as plain objects `{ code, message, detail }`; `src/js` turns them into `MorseSmoothError`.

use wasm_bindgen::JsValue;

use super::answer::Answer;
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
        let object = Answer::new();
        let detail = Answer::new();
        for (name, value) in thrown.0.detail() {
            match value {
                Detail::Integer(value) => detail.number(name, value as f64),
                Detail::Signed(value) => detail.number(name, value as f64),
                Detail::Real(value) => detail.number(name, value),
                Detail::Text(value) => detail.text(name, &value),
                #[cfg(feature = "files")]
                Detail::Texts(values) => {
                    let list: js_sys::Array = values.iter().map(|value| JsValue::from_str(value)).collect();
                    detail.set(name, &list);
                }
            }
        }
        object.text("code", thrown.0.code());
        object.text("message", &thrown.0.to_string());
        object.part("detail", detail);
        object.object().into()
    }
}
