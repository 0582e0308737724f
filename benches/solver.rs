//! Times of the sparse solver beside faer's and nalgebra-sparse's, natively: `cargo bench --bench solver -- --size 100k`.
#![allow(clippy::expect_used, clippy::print_stdout, reason = "a bench fails by panicking and prints what it measured")]

mod common;

fn main() {}
