//! The bindings: JavaScript values in and out, no mathematics. The entries in `src/js` wrap what is exported here.
#![allow(unreachable_pub, reason = "wasm-bindgen exports what is `pub`, however private the module")]

mod convert;
mod critical;
mod error;
mod files;
mod levels;
mod mesh;
mod options;
mod persistence;
mod smoother;

pub use error::Thrown;
pub use files::{read_field, read_mesh, write_mesh};
pub use mesh::RawTriMesh;
pub use smoother::{RawSmoother, smooth};
use wasm_bindgen::prelude::*;

/// Version of the package.
#[must_use]
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// A panic is a defect of ours and ends in a trap without words: write them to the console first, for the bug report.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| {
        web_sys::console::error_1(&JsValue::from_str(&format!("morse-smooth: {info}")));
    }));
}
