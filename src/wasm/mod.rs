//! The bindings: JavaScript values in and out, no mathematics. The files in `src/js/api` wrap what is exported here: `core` is the
//! module of `morse-smooth` (feature `wasm`), `files` that of `morse-smooth/files` (feature `wasm-files`), `snapshot` that of
//! `morse-smooth/snapshot` (feature `wasm-snapshot`).
#![allow(unreachable_pub, reason = "wasm-bindgen exports what is `pub`, however private the module")]

#[cfg(feature = "wasm")]
mod core;
#[cfg(feature = "wasm-files")]
mod files;
#[allow(dead_code, reason = "not every module of the package needs all of it")]
mod shared;
#[cfg(feature = "wasm-snapshot")]
mod snapshot;

#[cfg(feature = "wasm")]
pub use self::core::{RawSmoother, RawTriMesh, smooth};
#[cfg(feature = "wasm-files")]
pub use files::{formats, read_field, read_mesh, read_table, write_mesh};
pub use shared::error::Thrown;
pub use shared::reserve::set_aside;
#[cfg(feature = "wasm-snapshot")]
pub use snapshot::RawScene;
use wasm_bindgen::prelude::*;

/// A panic is a defect of ours and ends in a trap without words: write them to the console first, for the bug report.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| {
        web_sys::console::error_1(&JsValue::from_str(&format!("morse-smooth: {info}")));
    }));
}
