//! Warnings as plain objects.

use js_sys::Array;
use wasm_bindgen::JsValue;

use super::answer::Answer;
use crate::error::Diagnostic;

pub(in crate::wasm) fn diagnostics(warnings: &[Diagnostic]) -> Array {
    let diagnostic = |warning: &Diagnostic| {
        let answer = Answer::new();
        answer.text("code", warning.code);
        answer.text("message", &warning.message);
        answer.count("count", warning.count);
        let examples: Array = warning.examples.iter().map(|&id| JsValue::from_f64(f64::from(id))).collect();
        answer.set("examples", &examples);
        answer.object()
    };
    warnings.iter().map(diagnostic).collect()
}
