//! The bindings: JavaScript values in and out, no mathematics. The entries in `src/js` wrap what is exported here.

mod convert;
mod error;
mod files;
mod mesh;
mod options;
mod smoother;

use wasm_bindgen::prelude::*;

/// Version of the package.
#[must_use]
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}
