//! The integration tests, in one binary.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test fails by panicking")]

mod io_malformed;
mod io_read;
mod io_write;
