//! The integration tests, in one binary.
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test fails by panicking")]

mod critical;
mod io_malformed;
mod io_read;
mod io_write;
mod level_sets;
mod mesh;
mod operators;
mod solve;
mod support;
