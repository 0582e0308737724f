//! The bindings: JavaScript values in and out, no mathematics. The entries in `src/js` wrap what is exported here: `wasm` is the
//! module of `morse-smooth`, `wasm-snapshot` that of `morse-smooth/snapshot`.
#![allow(unreachable_pub, reason = "wasm-bindgen exports what is `pub`, however private the module")]

mod convert;
#[cfg(feature = "wasm")]
mod critical;
mod error;
#[cfg(feature = "wasm")]
mod files;
#[cfg(feature = "wasm")]
mod levels;
#[cfg(feature = "wasm")]
mod mesh;
#[cfg(feature = "wasm")]
mod options;
#[cfg(feature = "wasm")]
mod persistence;
#[cfg(feature = "wasm")]
mod smoother;
#[cfg(feature = "wasm-snapshot")]
mod snapshot;

pub use error::Thrown;
#[cfg(feature = "wasm")]
pub use files::{read_field, read_mesh, write_mesh};
#[cfg(feature = "wasm")]
pub use mesh::RawTriMesh;
#[cfg(feature = "wasm")]
pub use smoother::{RawSmoother, smooth};
#[cfg(feature = "wasm-snapshot")]
pub use snapshot::RawScene;
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
