//! The exported classes and functions, called with JavaScript values: `wasm-pack test --node -- --features wasm,wasm-files`.
#![cfg(all(target_arch = "wasm32", feature = "wasm", feature = "wasm-files"))]
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test fails by panicking")]

mod field;
mod files;
mod refusals;
mod smoothing;
mod support;
